#include "control/analytic.h"

#include <algorithm>
#include <stdexcept>

#include "control/analytic_math.h"

namespace mimicx::control {
namespace {

/// Degree of freedom 0 … 54 as body and axis in the child's frame.
struct Dof {
  std::size_t body;
  Vector3d axis;
};
std::array<Dof, kDofs> make_dofs() {
  std::array<Dof, kDofs> dofs;
  for (int body = 1; body < kBodies; ++body) {
    const auto first = static_cast<std::size_t>(first_dof(body)), i = static_cast<std::size_t>(body);
    if (is_hinge(body))
      dofs[first] = {i, hinge_axis(body)};
    else
      for (int k = 0; k < 3; ++k) dofs[first + static_cast<std::size_t>(k)] = {i, Vector3d::Unit(k)};
  }
  return dofs;
}

/// The targets at the ends of a frame, and how they turn with their residuals.
struct Ends {
  Target<double> from, to;
  TargetDerivative turns;  ///< right Jacobians of the two residuals
};

Vector3d residual_of(const std::array<double, kDofs>& residual, int body) {
  const auto dof = static_cast<std::size_t>(first_dof(body));
  if (is_hinge(body)) return residual[dof] * hinge_axis(body);
  return {residual[dof], residual[dof + 1], residual[dof + 2]};
}

Ends ends_of(const ControlFrame& frame) {
  Ends ends{frame.from, frame.to, {}};
  for (std::size_t i = 1; i < kBodies; ++i) {
    const Vector3d w = residual_of(frame.from_residual, static_cast<int>(i)),
                   u = residual_of(frame.to_residual, static_cast<int>(i));
    ends.from.q[i] = quat(eigen(frame.from.q[i]) * exp_map(w));
    ends.to.q[i] = quat(eigen(frame.to.q[i]) * exp_map(u));
    ends.turns.from[i] = right_jacobian(w);
    ends.turns.to[i] = right_jacobian(u);
  }
  return ends;
}

/// The target at the share s of the way from one end to the other: normalised linear interpolation the
/// shorter way, q* = (α q_from + β q_to) / ‖·‖; and how it turns: with q*⁻¹ q_from = (c, n) a turn ε of
/// q_from gives α/‖·‖ (c ε + n × ε).
Target<double> target_at(const Ends& ends, double s, TargetDerivative& turns) {
  Target<double> target = ends.to;
  for (std::size_t i = 1; i < kBodies; ++i) {
    const Quaterniond a = eigen(ends.from.q[i]), b = eigen(ends.to.q[i]);
    const double share_a = 1.0 - s, share_b = a.dot(b) < 0.0 ? -s : s;
    Quaterniond q;
    q.coeffs() = share_a * a.coeffs() + share_b * b.coeffs();
    const double norm = q.norm();
    q.coeffs() /= norm;
    const auto turn = [&](const Quaterniond& end, double share) -> Matrix3d {
      const Quaterniond x = q.conjugate() * end;
      return (share / norm) * (x.w() * Matrix3d::Identity() + skew(x.vec()));
    };
    turns.from[i] = turn(a, share_a) * ends.turns.from[i];
    turns.to[i] = turn(b, share_b) * ends.turns.to[i];
    target.q[i] = quat(q);
    target.omega[i] = add_scaled(ends.from.omega[i], s, ends.to.omega[i] - ends.from.omega[i]);
  }
  return target;
}

/// Column c of F as a direction: what it changes at the start of the frame. Residuals act in every step and
/// are left to `drive`.
template <class T>
void seed(int c, int lane, const std::array<Dof, kDofs>& dofs, TangentData<T>& d) {
  using Traits = ScalarTraits<T>;
  const auto unit = [&](Vec3<T>& v, int k) { Traits::set(k == 0 ? v.x : k == 1 ? v.y : v.z, lane, 1.0); };
  const auto along = [&](std::array<Vec3<T>, kBodies>& v, int dof) {
    const Dof& joint = dofs[static_cast<std::size_t>(dof)];
    Traits::set(v[joint.body].x, lane, joint.axis.x());
    Traits::set(v[joint.body].y, lane, joint.axis.y());
    Traits::set(v[joint.body].z, lane, joint.axis.z());
  };
  StateTangent<T>& x = d.state;
  constexpr int kHalf = kFrameStates / 2;
  if (c < 3) return unit(x.p, c);
  if (c < 6) return unit(x.turn[0], c - 3);
  if (c < kHalf) return along(x.turn, c - 6);
  if (c < kHalf + 3) return unit(x.v, c - kHalf);
  if (c < kHalf + 6) return unit(x.spin[0], c - kHalf - 3);
  if (c < kFrameStates) return along(x.spin, c - kHalf - 6);
  if (c < kFrameColumns) return;
  if (c < kFrameColumns + 3) return unit(d.push.n, c - kFrameColumns);
  if (c < kFrameColumnsWithPush) return unit(d.push.f, c - kFrameColumns - 3);
}

/// The joint torque that a residual gives in one step.
template <class T>
void drive(const SubstepTable<RealOf<T>>& table, int c, int lane, const std::array<Dof, kDofs>& dofs,
           TangentData<T>& d) {
  if (c < kFrameStates || c >= kFrameColumns) return;
  const auto column = static_cast<std::size_t>(c - kFrameStates);
  const Vec3<RealOf<T>>& torque = column < kDofs ? table.drive_from[column] : table.drive_to[column - kDofs];
  Vec3<T>& out = d.drive[dofs[column % kDofs].body];
  ScalarTraits<T>::set(out.x, lane, static_cast<double>(torque.x));
  ScalarTraits<T>::set(out.y, lane, static_cast<double>(torque.y));
  ScalarTraits<T>::set(out.z, lane, static_cast<double>(torque.z));
}

template <class T>
void clear(TangentData<T>& d) {
  const Vec3<T> zero = zero3<T>();
  d.state.p = d.state.v = d.push.n = d.push.f = zero;
  d.state.turn.fill(zero);
  d.state.spin.fill(zero);
  d.drive.fill(zero);
}

/// Writes the lanes of a state's change into columns first … first + count - 1.
template <class T>
void write(const StateTangent<T>& x, const std::array<Dof, kDofs>& dofs, int first, int count,
           FrameDerivative<T>& out) {
  const auto row = [&](int r, const T& value) {
    for (int lane = 0; lane < count; ++lane) out.F(r, first + lane) = ScalarTraits<T>::get(value, lane);
  };
  const auto rows = [&](int r, const Vec3<T>& v) {
    row(r, v.x);
    row(r + 1, v.y);
    row(r + 2, v.z);
  };
  const auto half = [&](int r, const Vec3<T>& root, const std::array<Vec3<T>, kBodies>& v) {
    rows(r, root);
    rows(r + 3, v[0]);
    for (int dof = 0; dof < kDofs; ++dof) {
      const Dof& joint = dofs[static_cast<std::size_t>(dof)];
      const Vec3<T> axis = {T(joint.axis.x()), T(joint.axis.y()), T(joint.axis.z())};
      row(r + 6 + dof, dot(axis, v[joint.body]));
    }
  };
  half(0, x.p, x.turn);
  half(kFrameStates / 2, x.v, x.spin);
}

/// The steps of a frame; f(target, turns, k) does step k.
template <class F>
void for_each_step(const ControlFrame& frame, F&& f) {
  if (frame.substeps < 1) throw std::invalid_argument("a control frame needs at least one physics step");
  const Ends ends = ends_of(frame);
  TargetDerivative turns;
  for (int k = 1; k <= frame.substeps; ++k) {
    const Target<double> target =
        target_at(ends, static_cast<double>(k) / static_cast<double>(frame.substeps), turns);
    f(target, turns, static_cast<std::size_t>(k - 1));
  }
}

}  // namespace

template <class T>
void differentiate_frame(const Model<double>& model, const ControlFrame& frame, bool with_push,
                         FrameScratch<T>& scratch, FrameDerivative<T>& out) {
  out.end = frame.start;
  out.wrong = false;
  scratch.substeps.resize(static_cast<std::size_t>(std::max(frame.substeps, 0)));
  for_each_step(frame, [&](const Target<double>& target, const TargetDerivative& turns, std::size_t k) {
    if (tabulate_step(model, target, turns, frame.push, out.end, scratch.data, scratch.substeps[k]))
      out.wrong = true;
  });
  static const std::array<Dof, kDofs> dofs = make_dofs();
  constexpr int kSize = ScalarTraits<T>::kSize;
  const int columns = with_push ? kFrameColumnsWithPush : kFrameColumns;
  out.F.resize(kFrameStates, columns);
  TangentData<T>& d = scratch.tangent;
  for (int first = 0; first < columns; first += kSize) {
    const int count = std::min(kSize, columns - first);
    clear(d);
    for (int lane = 0; lane < count; ++lane) seed(first + lane, lane, dofs, d);
    for (const SubstepTable<RealOf<T>>& table : scratch.substeps) {
      for (int lane = 0; lane < count; ++lane) drive(table, first + lane, lane, dofs, d);
      advance_tangent(table, d);
    }
    write(d.state, dofs, first, count, out);
  }
}

State<double> roll_out_frame(const Model<double>& model, const ControlFrame& frame, Data<double>& data,
                             bool* wrong) {
  State<double> state = frame.start;
  bool ran_away = false;
  SubstepTable<double> table;
  for_each_step(frame, [&](const Target<double>& target, const TargetDerivative& turns, std::size_t) {
    if (tabulate_step(model, target, turns, frame.push, state, data, table)) ran_away = true;
  });
  if (wrong != nullptr) *wrong = ran_away;
  return state;
}

#define MIMICX_INSTANTIATE(T)                                                                             \
  template void differentiate_frame<T>(const Model<double>&, const ControlFrame&, bool, FrameScratch<T>&, \
                                       FrameDerivative<T>&);

MIMICX_INSTANTIATE(double)
MIMICX_INSTANTIATE(Pack<8>)
MIMICX_INSTANTIATE(Pack<16>)
#if !defined(__AVX2__)
MIMICX_INSTANTIATE(Pack<4>)
#endif

}  // namespace mimicx::control
