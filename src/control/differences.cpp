#include "control/differences.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "core/random.h"

namespace mimicx::control {
namespace {

/// A pack of characters around one point: state, targets and assistive wrench of every lane, and the change
/// of the state that is still to be applied.
struct Bundle {
  State<P> x;
  Target<P> from, to;
  Wrench<P> assistance;
  Tangent<P> delta;

  Bundle(const System& system, const FramePoint& point)
      : x(in_all_lanes<P>(point.x)),
        from(target_of(system, point.frame, point.before)),
        to(target_of(system, point.frame + 1, point.u)),
        assistance(assistance_of(system, point.u)) {
    delta.fill(P(0.0));
  }
};

/// The target at a frame with every residual moved in every lane, in the packs' arithmetic, which differs
/// from `set_target` by rounding.
void move_target(const System& system, int frame, const Control& u, const P* moves, Target<P>& out) {
  const auto entry = [&](int dof) { return P(u[dof]) + moves[dof]; };
  for (int body = 1; body < kBodies; ++body) {
    const int dof = first_dof(body);
    Vec3<P> rotation;
    if (is_hinge(body)) {
      const Vector3d axis = hinge_axis(body);
      rotation = entry(dof) * Vec3<P>{P(axis.x()), P(axis.y()), P(axis.z())};
    } else {
      rotation = {entry(dof), entry(dof + 1), entry(dof + 2)};
    }
    Quat<P> reference;
    set_all_lanes(reference, system.at(frame).q[body]);
    out.q[body] = reference * exp_map(rotation);
  }
}
void move_assistance(const System& system, const Control& u, const P* moves, Wrench<P>& out) {
  for (int lane = 0; lane < kLanes; ++lane)
    set_assistance(
        system, [&](int e) { return u[kDofs + e] + moves[e][lane]; }, lane, out);
}

/// Half the difference of two packs, lanes as columns; non-finite entries become zero.
void half_difference(const State<P>& plus, const State<P>& minus, int lanes, int column,
                     Eigen::Ref<Eigen::Matrix<float, kTangent, Eigen::Dynamic, Eigen::RowMajor>> out) {
  const Tangent<P> d = difference(plus, minus);
  for (int row = 0; row < kTangent; ++row)
    for (int lane = 0; lane < lanes; ++lane) {
      const float value = d[row][lane];
      out(row, column + lane) = std::isfinite(value) ? 0.5f * value : 0.0f;
    }
}

constexpr int kRows = 256;  ///< of the Hadamard matrix: the power of two above the number of columns
static_assert(kRows > kMemory + kMaxControls);

/// Entry of Sylvester's Hadamard matrix; column 0 is constant and left out.
float hadamard(int row, int column) {
  const auto common = static_cast<unsigned>(row & (column + 1));
  return (std::popcount(common) & 1) != 0 ? -1.0f : 1.0f;
}

}  // namespace

double DifferenceSteps::of(int k) const {
  if (k < kRootRotation) return position;
  if (k < kRootVelocity) return rotation;
  if (k < kRootSpin) return velocity;
  if (k < kTangent) return spin;
  if (k < kMemory + kDofs) return residual;
  return k < kMemory + kDofs + 3 ? assistance : assistance_spin;
}

DifferenceSteps DifferenceSteps::scaled(double f) const {
  return {f * position, f * rotation,   f * velocity,       f * spin,
          f * residual, f * assistance, f * assistance_spin};
}

FrameMatrix linearise_smoothed(const System& system, const FramePoint& point, const DifferenceSteps& steps) {
  const int columns = kMemory + system.controls();
  Random random(0x736d6f6f7468, {static_cast<std::uint64_t>(point.frame)});
  Eigen::Matrix<float, kRows, Eigen::Dynamic> signs(kRows, columns);
  for (int k = 0; k < columns; ++k) {
    const float sign = (random.bits() & 1u) != 0 ? -1.0f : 1.0f;
    for (int row = 0; row < kRows; ++row) signs(row, k) = sign * hadamard(row, k);
  }
  Eigen::Matrix<float, kTangent, Eigen::Dynamic, Eigen::RowMajor> ends(kTangent, kRows);
  const auto scratch = std::make_unique<Data<P>>();
  const auto base = std::make_unique<Bundle>(system, point);
  State<P> sides[2];
  for (int first = 0; first < kRows; first += kLanes) {
    for (int side = 0; side < 2; ++side) {
      List<P> move(columns);
      for (int k = 0; k < columns; ++k) {
        const double step = side == 0 ? steps.of(k) : -steps.of(k);
        for (int lane = 0; lane < kLanes; ++lane)
          move[k].set(lane, static_cast<float>(step) * signs(first + lane, k));
      }
      Bundle bundle = *base;
      std::copy_n(move.begin(), kTangent, bundle.delta.begin());
      move_target(system, point.frame, point.before, move.data() + kTangent, bundle.from);
      move_target(system, point.frame + 1, point.u, move.data() + kMemory, bundle.to);
      if (system.assisted) move_assistance(system, point.u, move.data() + kMemory + kDofs, bundle.assistance);
      retract(bundle.x, bundle.delta);
      advance(system, bundle.from, bundle.to, bundle.assistance, bundle.x, *scratch);
      sides[side] = bundle.x;
    }
    half_difference(sides[0], sides[1], kLanes, first, ends);
  }
  FrameMatrix F(kTangent, columns);
  F.noalias() = ends * signs;
  for (int k = 0; k < columns; ++k) F.col(k) /= static_cast<float>(kRows * steps.of(k));
  return F;
}

}  // namespace mimicx::control
