#include "control/analytic/analytic_joints.h"

#include "control/analytic/analytic_math.h"

namespace mimicx::control {
namespace {

/// Torque of an anatomical range by the joint's rotation, child's frame: `compute_range` differentiated.
/// Zero inside the range.
Matrix3d range_stiffness(const Model<double>& model, const Quat<double>& q, int i) {
  const Quaterniond x = to_eigen(conjugate(model.range_centre[i]) * q);
  const double two = x.w() < 0.0 ? -2.0 : 2.0;
  const Vector3d inverse = to_eigen(model.range_inverse[i]);
  const Vector3d s = two * x.vec().cwiseProduct(inverse);
  const double g = s.norm();
  if (!(g > 1.0)) return Matrix3d::Zero();
  // q·exp(δ): the vector part of x changes by ½ (w δ + vec × δ).
  const Matrix3d ds =
      inverse.asDiagonal() * Matrix3d(0.5 * two * (x.w() * Matrix3d::Identity() + skew(x.vec())));
  const Vector3d gradient = s.cwiseProduct(inverse);
  const Matrix3d dgradient = inverse.asDiagonal() * ds;
  const double slope = gradient.norm(), excess = (g - 1.0) * g / slope;
  const Eigen::RowVector3d dg = s.transpose() * ds / g, dslope = gradient.transpose() * dgradient / slope;
  const Eigen::RowVector3d dexcess = ((2.0 * g - 1.0) * dg - excess * dslope) / slope;
  // push = −k (excess/slope) gradient
  const Eigen::RowVector3d dratio = (dexcess - (excess / slope) * dslope) / slope;
  return -model.config.limit_stiffness * (gradient * dratio + (excess / slope) * dgradient);
}

}  // namespace

template <class Real>
void tabulate_joints(const Model<double>& model, const State<double>& state, const StepTarget& target,
                     const Data<double>& d, SubstepTable<Real>& out) {
  PerBody<bool> bounded{};
  for (int k = 0; k < out.solve_count; ++k)
    for (const SaturatedTable<Real>& joint : out.solve(k).saturated) bounded[joint.body] = true;
  out.law.clear();
  const double dt = model.dt, range_damping = dt * model.config.limit_stiffness + model.config.limit_damping;
  for (int i = 1; i < kBodies; ++i) {
    const Matrix3d R = to_eigen(d.R_WB[i]);
    const Vector3d phi = log_map(to_eigen(conjugate(state.q[i]) * target.target.q[i]));
    // docs/control_derivatives.md §3, (6)
    const Matrix3d to_phi = model.kp[i] * R * inverse_right_jacobian(phi);  // torque by a turn of the target
    const Matrix3d law = -model.kp[i] * R * inverse_right_jacobian(phi).transpose();
    const double damping = model.kd[i] + dt * model.kp[i];
    const bool outside = d.delta_range[i] > 0.0;
    const Matrix3d range = outside ? Matrix3d(R * range_stiffness(model, state.q[i], i)) : Matrix3d::Zero();
    const double range_gain = outside ? range_damping : 0.0;
    put(out.body[i].stiffness, Matrix3d(law + range));
    out.body[i].damping = static_cast<Real>(damping + range_gain);
    const Matrix3d from = to_phi * target.from[i], to = to_phi * target.to[i];
    const int dof = first_dof(i);
    if (is_hinge(i)) {
      put(out.drive_from[dof], Vector3d(from * to_eigen(model.axis[i])));
      put(out.drive_to[dof], Vector3d(to * to_eigen(model.axis[i])));
    } else {
      for (int k = 0; k < 3; ++k) {
        put(out.drive_from[dof + k], Vector3d(from.col(k)));
        put(out.drive_to[dof + k], Vector3d(to.col(k)));
      }
    }
    if (!bounded[i]) continue;
    LawTable<Real>& table = out.law.emplace_back();
    table.body = i;
    put(table.range_stiffness, range);
    table.range_damping = static_cast<Real>(range_gain);
    table.delta = static_cast<Real>(d.delta_pd[i]);
  }
}

template <class Real>
void tabulate_saturated(const Model<double>& model, const Data<double>& d, const PerBody<bool>& kept,
                        List<SaturatedTable<Real>>& out) {
  out.clear();
  for (int i = 1; i < kBodies; ++i) {
    if (!d.saturated[i]) continue;
    SaturatedTable<Real>& table = out.emplace_back();
    table.body = i;
    table.set = !kept[i];
    // Of a hinge the law lies along the axis and so does its change: nothing is left across it.
    const Vector3d law = to_eigen(add_scaled(d.tau_pd[i], -d.delta_pd[i], d.qdd[i]));
    const Vector3d along = law.normalized();
    const double gain = is_hinge(i) ? 0.0 : model.torque_limit[i] / law.norm();
    put(table.projection, Matrix3d(gain * (Matrix3d::Identity() - along * along.transpose())));
  }
}

template <class Real>
void tabulate_integration(const Model<double>& model, const State<double>& state, SubstepTable<Real>& out) {
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d turn = model.dt * to_eigen(state.omega[i]);
    const ExpAndJacobian exp = exp_and_jacobian(turn);
    put(out.body[i].turn, Matrix3d(exp.rotation.transpose()));
    put(out.body[i].turn_by_omega, Matrix3d(model.dt * exp.jacobian));
  }
}

#define MIMICX_INSTANTIATE(Real)                                                                    \
  template void tabulate_joints(const Model<double>&, const State<double>&, const StepTarget&,      \
                                const Data<double>&, SubstepTable<Real>&);                          \
  template void tabulate_saturated(const Model<double>&, const Data<double>&, const PerBody<bool>&, \
                                   List<SaturatedTable<Real>>&);                                    \
  template void tabulate_integration(const Model<double>&, const State<double>&, SubstepTable<Real>&);

MIMICX_INSTANTIATE(float)
MIMICX_INSTANTIATE(double)

#undef MIMICX_INSTANTIATE

}  // namespace mimicx::control
