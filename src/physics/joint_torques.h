/// Joint torques inside the implicit scheme: PD control, anatomical ranges and torque bounds.
///
/// A spring–damper evaluated at the end of the step is, to first order in dt,
///     τ = kp·φ − (kd + dt·kp)·ω + kd·ω*  −  δ·q̈,      δ = dt·kd + dt²·kp,      φ = log(q⁻¹ q*),
/// so its explicit part goes into τ and δ onto the diagonal of D.             docs/physics.md §3, (5)
/// The torque of an anatomical range has the same implicit terms: a spring along the gradient of the range
/// ellipsoid and a damper on the whole joint velocity; its deflection is docs/physics.md §3, (6). The torque
/// of the PD controller never exceeds its bound: joints that exceed it after the last pass are saturated,
/// too, and the step is solved again. The torque of the range comes from bones and ligaments and has no
/// bound.
#pragma once

#include "physics/data.h"

namespace mimicx::physics {

/// Torque and implicit diagonal of the anatomical range of joint i; zero inside it.
template <class T>
void compute_range(const Model<RealOf<T>>& model, const State<T>& state, int i, Data<T>& d) {
  const Quat<T> x = conjugate(spread<T>(model.range_centre[i])) * state.q[i];
  const T two = select(x.w < T(0.0), T(-2.0), T(2.0));
  const Vec3<T> inverse = spread<T>(model.range_inverse[i]);
  const Vec3<T> s = {two * x.x * inverse.x, two * x.y * inverse.y, two * x.z * inverse.z};
  const T g = norm(s);
  const auto outside = g > T(1.0);
  d.tau_range[i] = zero3<T>();
  d.delta_range[i] = T(0.0);
  if (!any(outside)) return;
  const Vec3<T> gradient = {s.x * inverse.x, s.y * inverse.y, s.z * inverse.z};  // g·∇g
  const T slope = max(norm(gradient), T(1e-6));
  const T excess = (g - T(1.0)) * g / slope;  // distance to the ellipsoid along ∇g, rad
  const T k(model.config.limit_stiffness), c(model.config.limit_damping), dt(model.dt);
  const T gain = fma(dt, k, c);
  const Vec3<T> push = d.R_WB[i] * ((-k * excess / slope) * gradient);
  const Vec3<T> w_J = d.R_WB[i] * state.omega[i];
  d.tau_range[i] = select<T>(outside, add_scaled(push, -gain, w_J), zero3<T>());
  d.delta_range[i] = select(outside, dt * gain, T(0.0));
}

/// PD and range torques of every joint at the start of the step.
template <class T>
[[gnu::flatten]] void compute_joint_torques(const Model<RealOf<T>>& model, const State<T>& state,
                                            const Target<T>& target, Data<T>& d) {
  const T dt(model.dt);
  for (int i = 1; i < kBodies; ++i) {
    const T kp(model.kp[i]), kd(model.kd[i]);
    const Vec3<T> phi = log_map(conjugate(state.q[i]) * target.q[i]);
    const Vec3<T> damping = (-fma(dt, kp, kd)) * state.omega[i];
    const Vec3<T> tau = add_scaled(add_scaled(damping, kp, phi), kd, target.omega[i]);
    d.tau_pd[i] = d.R_WB[i] * tau;
    d.delta_pd[i] = dt * fma(dt, kp, kd);
    compute_range(model, state, i, d);
  }
}

/// Torque of the PD controller in the last solve, world axes, N·m.
template <class T>
Vec3<T> applied_pd_torque(const Data<T>& d, int i) {
  return add_scaled(d.tau[i], select(d.saturated[i], T(0.0), -d.delta_pd[i]), d.qdd[i]);
}
template <class T>
Vec3<T> applied_range_torque(const Data<T>& d, int i) {
  return add_scaled(d.tau_range[i], -d.delta_range[i], d.qdd[i]);
}

/// The first pass uses the implicit law in every joint.
template <class T>
void use_pd_law(const Model<RealOf<T>>& model, Data<T>& d) {
  for (int i = 1; i < kBodies; ++i) {
    d.saturated[i] = d.returned[i] = T(0.0) > T(1.0);
    d.tau[i] = d.tau_pd[i];
    d.delta[i] = T(model.armature[i]) + d.delta_pd[i] + d.delta_range[i];
  }
}

/// Before a later pass: if the law, with the accelerations of the previous pass, exceeds the bound, the
/// torque becomes a constant of the bound's size along the law; otherwise it is the implicit law. This is the
/// active-set form of Newton's method for τ = clamp(law − δ·q̈).
template <class T>
[[gnu::flatten]] void apply_torque_bounds(const Model<RealOf<T>>& model, Data<T>& d) {
  for (int i = 1; i < kBodies; ++i) {
    const T limit(model.torque_limit[i]), armature(model.armature[i]);
    const Vec3<T> law = add_scaled(d.tau_pd[i], -d.delta_pd[i], d.qdd[i]);
    const T size = norm(law);  // of a hinge both vectors lie along its axis
    const MaskOf<T> over = size > limit;
    const MaskOf<T> constant = over | d.saturated[i];  // now or before: IA of its parent changes
    if (any(constant)) d.outdated[kParents[i]] = true;
    d.saturated[i] = over;
    const T scale = limit / max(size, limit);
    d.tau[i] = select<T>(d.saturated[i], scale * law, d.tau_pd[i]);
    d.delta[i] = armature + select(d.saturated[i], T(0.0), d.delta_pd[i]) + d.delta_range[i];
  }
}

/// After the last pass: corrects the saturated set where the last solve contradicts it. A joint that exceeds
/// its bound is saturated; a saturated joint whose law has turned against its torque returns to the law, once
/// in a step. No other joint or lane changes, so that solving again gives the same bits in an unaffected
/// lane.
/// @return mask of the lanes that must be solved again, at most 63 times: a joint changes three times at most
template <class T>
[[gnu::flatten]] MaskOf<T> correct_torque_bounds(const Model<RealOf<T>>& model, Data<T>& d) {
  MaskOf<T> again = T(0.0) > T(1.0);
  for (int i = 1; i < kBodies; ++i) {
    const T limit(model.torque_limit[i]), armature(model.armature[i]);
    const Vec3<T> law = add_scaled(d.tau_pd[i], -d.delta_pd[i], d.qdd[i]);
    const T size_2 = dot(law, law);
    const MaskOf<T> over = (size_2 > limit * limit) & !d.saturated[i];
    const MaskOf<T> opposes = dot(law, d.tau[i]) < T(0.0), saturated = d.saturated[i];
    const MaskOf<T> against = opposes & saturated & !d.returned[i];
    const MaskOf<T> changes = over | against;
    if (!any(changes)) continue;
    again = again | changes;
    d.outdated[kParents[i]] = true;
    d.saturated[i] = (d.saturated[i] | over) & !against;
    d.returned[i] = d.returned[i] | against;
    const T scale = limit / sqrt(max(size_2, limit * limit));
    d.tau[i] = select<T>(over, scale * law, select<T>(against, d.tau_pd[i], d.tau[i]));
    d.delta[i] = armature + select(d.saturated[i], T(0.0), d.delta_pd[i]) + d.delta_range[i];
  }
  return again;
}

}  // namespace mimicx::physics
