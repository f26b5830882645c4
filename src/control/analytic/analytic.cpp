#include "control/analytic/analytic.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "control/analytic/analytic_math.h"
#include "control/analytic/analytic_step.h"
#include "core/error.h"
#include "physics/control_interval.h"

namespace mimicx::control {
namespace {

/// The PD target at one end of a frame, and its derivative by its residuals: the right Jacobians of exp.
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

/// The target at the share s of the interval, and its derivative by the residuals of both ends. Linear
/// interpolation, normalised: q* = (α q_a + β q_b) / l. A turn ε of q_a turns q* by (α/l) (c ε + n × ε),
/// where (c, n) = q*⁻¹ q_a.
StepTarget target_at(const End& from, const End& to, double s) {
  StepTarget out;
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
    out.from[i] = turn(a, share_a) * from.turns[i];
    out.to[i] = turn(b, share_b) * to.turns[i];
    out.target.q[i] = from_eigen(q);
    out.target.omega[i] = add_scaled(from.target.omega[i], s, to.target.omega[i] - from.target.omega[i]);
  }
  return out;
}

/// The nominal motion, and the tables of its steps.
template <class Real>
void roll_out_substeps(const Model<double>& model, const ControlFrame& frame, Data<double>& data,
                       List<SubstepTable<Real>>& tables, State<double>& state, bool& wrong) {
  const End from = end_of(frame.from, frame.from_residual), to = end_of(frame.to, frame.to_residual);
  state = frame.start;
  wrong = false;
  tables.resize(frame.substeps);
  for (int k = 1; k <= frame.substeps; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(frame.substeps);
    if (tabulate_step(model, target_at(from, to, share), frame.assistance, state, data, tables[k - 1]))
      wrong = true;
  }
}

template <class T>
void clear(AdjointData<T>& d) {
  const Vec3<T> zero = zero3<T>();
  d.state.p = d.state.v = d.assistance.n = d.assistance.f = zero;
  d.state.turn.fill(zero);
  d.state.spin.fill(zero);
  d.from.fill(T(0.0));
  d.to.fill(T(0.0));
}

/// Starts row `row` of the derivative, that of one coordinate of the end, in one lane.
template <class T>
void seed(int row, int lane, StateAdjoint<T>& x) {
  const auto half = [&](int k, Vec3<T>& root, PerBody<Vec3<T>>& joints) {
    if (k < 3) return set_lane(root, lane, Vector3d::Unit(k));
    if (k < 6) return set_lane(joints[0], lane, Vector3d::Unit(k - 3));
    const Dof& joint = dofs()[k - 6];
    set_lane(joints[joint.body], lane, joint.axis);
  };
  if (row < kPositions)
    half(row, x.p, x.turn);
  else
    half(row - kPositions, x.v, x.spin);
}

/// Writes the lanes into the rows from `first` on.
template <class T>
void write_block(const AdjointData<T>& d, int first, int lanes, FrameDerivative<T>& out) {
  const auto put_column = [&](int column, const T& value) {
    for (int lane = 0; lane < lanes; ++lane) out.F(first + lane, column) = ScalarTraits<T>::get(value, lane);
  };
  const auto three = [&](int column, const Vec3<T>& v) {
    put_column(column, v.x);
    put_column(column + 1, v.y);
    put_column(column + 2, v.z);
  };
  const auto half = [&](int column, const Vec3<T>& root, const PerBody<Vec3<T>>& joints) {
    three(column, root);
    three(column + 3, joints[0]);
    for (int i = 1; i < kBodies; ++i) {
      const int at = column + 6 + first_dof(i);
      if (is_hinge(i)) {
        const Vector3d axis = hinge_axis(i);
        put_column(at, dot(Vec3<T>{T(axis.x()), T(axis.y()), T(axis.z())}, joints[i]));
      } else {
        three(at, joints[i]);
      }
    }
  };
  half(0, d.state.p, d.state.turn);
  half(kPositions, d.state.v, d.state.spin);
  for (int dof = 0; dof < kDofs; ++dof) {
    put_column(kTangent + dof, d.from[dof]);
    put_column(kTangent + kDofs + dof, d.to[dof]);
  }
  if (out.F.cols() == kFrameColumns) return;
  three(kFrameColumns, d.assistance.n);
  three(kFrameColumns + 3, d.assistance.f);
}

}  // namespace

template <class T>
void differentiate_frame(const Model<double>& model, const ControlFrame& frame, bool with_assistance,
                         FrameScratch<T>& scratch, FrameDerivative<T>& out) {
  if (frame.substeps < 1) raise(std::invalid_argument("a control frame needs at least one physics step"));
  roll_out_substeps(model, frame, scratch.data, scratch.substeps, out.end, out.wrong);
  const int columns = with_assistance ? kFrameColumnsWithAssistance : kFrameColumns;
  out.F.resize(kTangent, columns);
  AdjointData<T>& d = scratch.adjoint;
  for (int first = 0; first < kTangent; first += ScalarTraits<T>::kSize) {
    const int lanes = std::min(ScalarTraits<T>::kSize, kTangent - first);
    clear(d);
    for (int lane = 0; lane < lanes; ++lane) seed(first + lane, lane, d.state);
    for (auto table = scratch.substeps.rbegin(); table != scratch.substeps.rend(); ++table)
      step_adjoint(*table, d);
    write_block(d, first, lanes, out);
  }
}

#define MIMICX_INSTANTIATE(T)                                                                             \
  template void differentiate_frame<T>(const Model<double>&, const ControlFrame&, bool, FrameScratch<T>&, \
                                       FrameDerivative<T>&);

MIMICX_INSTANTIATE(double)
MIMICX_INSTANTIATE(Pack<kLanes>)

#undef MIMICX_INSTANTIATE

}  // namespace mimicx::control
