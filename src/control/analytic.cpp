#include "control/analytic.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "control/analytic_math.h"
#include "control/analytic_step.h"
#include "physics/pd_target.h"

namespace mimicx::control {
namespace {

/// The PD target at one end of a frame, and how it turns with its residuals: the right Jacobians of exp.
struct End {
  Target<double> target;
  PerBody<Matrix3d> turns;
};

End end_of(const Target<double>& reference, const Array<double, kDofs>& residual) {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  End end{reference, {}};
  for (int i = 1; i < kBodies; ++i) {
    const Vector3d r = action_rotation(i, kNoLimit, [&](int dof) { return residual[dof]; });
    end.target.q[i] = from_eigen(residual_target(to_eigen(reference.q[i]), r));
    end.turns[i] = right_jacobian(r);
  }
  return end;
}

/// The target at the share s of the way, and how it turns with the residuals of the two ends. Interpolated
/// linearly and normalised, q* = (α q_a + β q_b) / l; a turn ε of q_a, seen from q*, gives q* the turn
/// (α/l) (c ε + n × ε), where (c, n) = q*⁻¹ q_a.
Target<double> target_at(const End& from, const End& to, double s, TargetDerivative& turns) {
  Target<double> target;
  for (int i = 1; i < kBodies; ++i) {
    const Quaterniond a = to_eigen(from.target.q[i]), b = to_eigen(to.target.q[i]);
    const double share_a = 1.0 - s, share_b = a.dot(b) < 0.0 ? -s : s;
    Quaterniond q;
    q.coeffs() = share_a * a.coeffs() + share_b * b.coeffs();
    const double length = q.norm();
    q.coeffs() /= length;
    const auto turn = [&](const Quaterniond& end, double share) -> Matrix3d {
      const Quaterniond x = q.conjugate() * end;
      return (share / length) * (x.w() * Matrix3d::Identity() + skew(x.vec()));
    };
    turns.from[i] = turn(a, share_a) * from.turns[i];
    turns.to[i] = turn(b, share_b) * to.turns[i];
    target.q[i] = from_eigen(q);
    target.omega[i] = add_scaled(from.target.omega[i], s, to.target.omega[i] - from.target.omega[i]);
  }
  return target;
}

/// The nominal motion, and the tables of its steps.
template <class Real>
void roll_out(const Model<double>& model, const ControlFrame& frame, Data<double>& data,
              std::vector<SubstepTable<Real>>& tables, State<double>& state, bool& wrong) {
  const End from = end_of(frame.from, frame.from_residual), to = end_of(frame.to, frame.to_residual);
  TargetDerivative turns;
  state = frame.start;
  wrong = false;
  tables.resize(static_cast<std::size_t>(frame.substeps));
  for (int k = 1; k <= frame.substeps; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(frame.substeps);
    const Target<double> target = target_at(from, to, share, turns);
    if (tabulate_step(model, target, turns, frame.help, state, data, tables[static_cast<std::size_t>(k - 1)]))
      wrong = true;
  }
}

/// What column c of the derivative changes at the start of the frame, in one lane. Residuals change nothing
/// there: they act in every step (`drive`).
template <class T>
void seed(int c, int lane, TangentData<T>& d) {
  const auto along = [&](PerBody<Vec3<T>>& joints, int dof) {
    const Dof& joint = dofs()[static_cast<std::size_t>(dof)];
    set_lane(joints[joint.body], lane, joint.axis);
  };
  StateTangent<T>& x = d.state;
  if (c < kRootRotation) {
    set_lane(x.p, lane, Vector3d::Unit(c));
  } else if (c < kJointRotation) {
    set_lane(x.turn[0], lane, Vector3d::Unit(c - kRootRotation));
  } else if (c < kRootVelocity) {
    along(x.turn, c - kJointRotation);
  } else if (c < kRootSpin) {
    set_lane(x.v, lane, Vector3d::Unit(c - kRootVelocity));
  } else if (c < kJointVelocity) {
    set_lane(x.spin[0], lane, Vector3d::Unit(c - kRootSpin));
  } else if (c < kTangent) {
    along(x.spin, c - kJointVelocity);
  } else if (c >= kFrameColumns) {
    const int k = c - kFrameColumns;
    set_lane(k < 3 ? d.help.n : d.help.f, lane, Vector3d::Unit(k % 3));
  }
}

/// The joint torque that the residual of column c gives in one step, in one lane.
template <class T>
void drive(const SubstepTable<RealOf<T>>& table, int c, int lane, TangentData<T>& d) {
  if (c < kTangent || c >= kFrameColumns) return;
  const int dof = (c - kTangent) % kDofs;
  const Vec3<RealOf<T>>& torque = (c < kTangent + kDofs ? table.drive_from : table.drive_to)[dof];
  Vec3<T>& out = d.drive[dofs()[static_cast<std::size_t>(dof)].body];
  ScalarTraits<T>::set(out.x, lane, torque.x);
  ScalarTraits<T>::set(out.y, lane, torque.y);
  ScalarTraits<T>::set(out.z, lane, torque.z);
}

template <class T>
void clear(TangentData<T>& d) {
  const Vec3<T> zero = zero3<T>();
  d.state.p = d.state.v = d.help.n = d.help.f = zero;
  d.state.turn.fill(zero);
  d.state.spin.fill(zero);
  d.drive.fill(zero);
}

/// Writes the lanes of a state's change into the columns from `first` on.
template <class T>
void write(const StateTangent<T>& x, int first, int lanes, FrameDerivative<T>& out) {
  const auto row = [&](int r, const T& value) {
    std::memcpy(&out.F(r, first), &value, static_cast<std::size_t>(lanes) * sizeof(RealOf<T>));
  };
  const auto half = [&](int r, const Vec3<T>& root, const PerBody<Vec3<T>>& joints) {
    const T six[] = {root.x, root.y, root.z, joints[0].x, joints[0].y, joints[0].z};
    for (int k = 0; k < 6; ++k) row(r + k, six[k]);
    for (int i = 1; i < kBodies; ++i) {
      const Vec3<T>& v = joints[i];
      const int at = r + 6 + first_dof(i);
      if (is_hinge(i)) {
        const Vector3d axis = hinge_axis(i);
        row(at, dot(Vec3<T>{T(axis.x()), T(axis.y()), T(axis.z())}, v));
      } else {
        row(at, v.x);
        row(at + 1, v.y);
        row(at + 2, v.z);
      }
    }
  };
  half(0, x.p, x.turn);
  half(kPositions, x.v, x.spin);
}

}  // namespace

template <class T>
void differentiate_frame(const Model<double>& model, const ControlFrame& frame, bool with_help,
                         FrameScratch<T>& scratch, FrameDerivative<T>& out) {
  if (frame.substeps < 1) throw std::invalid_argument("a control frame needs at least one physics step");
  roll_out(model, frame, scratch.data, scratch.substeps, out.end, out.wrong);
  const int columns = with_help ? kFrameColumnsWithHelp : kFrameColumns;
  out.F.resize(kTangent, columns);
  TangentData<T>& d = scratch.tangent;
  for (int first = 0; first < columns; first += ScalarTraits<T>::kSize) {
    const int lanes = std::min(ScalarTraits<T>::kSize, columns - first);
    clear(d);
    for (int lane = 0; lane < lanes; ++lane) seed(first + lane, lane, d);
    for (const SubstepTable<RealOf<T>>& table : scratch.substeps) {
      for (int lane = 0; lane < lanes; ++lane) drive(table, first + lane, lane, d);
      advance_tangent(table, d);
    }
    write(d.state, first, lanes, out);
  }
}

#define MIMICX_INSTANTIATE(T)                                                                             \
  template void differentiate_frame<T>(const Model<double>&, const ControlFrame&, bool, FrameScratch<T>&, \
                                       FrameDerivative<T>&);

MIMICX_INSTANTIATE(double)
MIMICX_INSTANTIATE(Pack<kLanes>)

}  // namespace mimicx::control
