#include "physics/step.h"

#include "physics/aba.h"
#include "physics/integration.h"

namespace mimicx::physics {
namespace {

template <class T>
void zero_self_contact(Data<T>& d) {
  for (auto& wrench : d.self_wrench) wrench = {zero3<T>(), zero3<T>()};
}

}  // namespace

template <class T>
void update_kinematics(const Model<RealOf<T>>& model, const State<T>& state, Data<T>& d) {
  compute_kinematics(model, state, d);
}

template <class T>
void forward_dynamics(const Model<RealOf<T>>& model, const State<T>& state, const PerBody<Vec3<T>>& tau,
                      Data<T>& d) {
  compute_kinematics(model, state, d);
  compute_rigid_bodies(model, d);
  d.ground_count = 0;
  for (int i = 1; i < kBodies; ++i) {
    d.tau[i] = d.R_WB[i] * tau[i];
    d.tau_range[i] = zero3<T>();
    d.delta[i] = T(model.armature[i]);
  }
  articulated_body_algorithm(model, d);
}

template <class T>
void solve_accelerations(const Model<RealOf<T>>& model, const Target<T>& target, const State<T>& state,
                         Data<T>& d, const Wrench<T>* assistance) {
  compute_kinematics(model, state, d);
  compute_rigid_bodies(model, d);
  if (assistance != nullptr) {
    d.bias[kPelvis].n -= assistance->n;
    d.bias[kPelvis].f -= assistance->f;
  }
  zero_self_contact(d);
  if (model.config.self_contact) add_self_contact(model, d);
  detect_ground(model, d);
  compute_joint_torques(model, state, target, d);
  use_pd_law(model, d);
  d.outdated.fill(true);
  solve(model, d);
  const MaskOf<T> all = T(1.0) > T(0.0);
  for (int pass = 1; pass < model.config.passes; ++pass) {
    relinearise_ground(model, all, d);
    apply_torque_bounds(model, d);
    solve(model, d);
  }
  for (MaskOf<T> again = correct_torque_bounds(model, d); any(again);
       again = correct_torque_bounds(model, d)) {
    relinearise_ground(model, again, d);
    solve(model, d);
  }
  find_applied_ground(model, d);
}

template <class T>
MaskOf<T> step(const Model<RealOf<T>>& model, const Target<T>& target, State<T>& state, Data<T>& d,
               Applied<T>* applied, const Wrench<T>* assistance) {
  solve_accelerations(model, target, state, d, assistance);
  if (applied != nullptr) record_applied(model, d, *applied);
  integrate(model, d, state);
  return gone_wrong(model, state);
}

template <class T>
void record_applied(const Model<RealOf<T>>& model, const Data<T>& d, Applied<T>& applied) {
  for (int i = 1; i < kBodies; ++i) {
    const Vec3<T> range = applied_range_torque(d, i);
    applied.joint_torque[i] += transpose_times(d.R_WB[i], applied_pd_torque(d, i) + range);
    applied.range_torque[i] += transpose_times(d.R_WB[i], range);
  }
  for (int k = 0; k < d.ground_count; ++k) {
    const GroundContact<T>& c = d.ground[k];
    Wrench<T>& wrench = applied.ground[model.contacts[c.index].body];
    wrench.f += c.applied;
    wrench.n += cross(c.arm, c.applied);
  }
  for (int i = 0; i < kBodies; ++i) {
    applied.self[i].f += d.self_wrench[i].f;
    applied.self[i].n += d.self_wrench[i].n;
  }
  ++applied.steps;
}

template <class T>
void clear(Applied<T>& applied) {
  const Wrench<T> zero = {zero3<T>(), zero3<T>()};
  applied.joint_torque.fill(zero3<T>());
  applied.range_torque.fill(zero3<T>());
  applied.ground.fill(zero);
  applied.self.fill(zero);
  applied.steps = 0;
}

#define MIMICX_INSTANTIATE(T)                                                                                \
  template void forward_dynamics<T>(const Model<RealOf<T>>&, const State<T>&, const PerBody<Vec3<T>>&,       \
                                    Data<T>&);                                                               \
  template MaskOf<T> step<T>(const Model<RealOf<T>>&, const Target<T>&, State<T>&, Data<T>&, Applied<T>*,    \
                             const Wrench<T>*);                                                              \
  template void solve_accelerations<T>(const Model<RealOf<T>>&, const Target<T>&, const State<T>&, Data<T>&, \
                                       const Wrench<T>*);                                                    \
  template void record_applied<T>(const Model<RealOf<T>>&, const Data<T>&, Applied<T>&);                     \
  template void clear<T>(Applied<T>&);                                                                       \
  template void update_kinematics<T>(const Model<RealOf<T>>&, const State<T>&, Data<T>&);

MIMICX_FOR_ALL_SCALARS(MIMICX_INSTANTIATE)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::physics
