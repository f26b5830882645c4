/// A step put together from the public parts of the physics headers, in the order of step.cpp, for tests that
/// look at it between two parts, or run it in a scalar of their own. It gives the bits of `step`
/// (step_in_parts_test.cpp).
#pragma once

#include "physics/aba.h"
#include "physics/integration.h"

namespace mimicx::physics {

/// Where tests may step in: a struct derived from this one hides the functions that it has itself.
struct StepParts {
  /// The forces on the bodies that do not come from contacts and joints are summed in d.bias.
  template <class T>
  void after_rigid_bodies(Data<T>&) {}
  /// d.outdated has the bodies whose IA and pA the next solve computes again.
  template <class T>
  void before_solve(Data<T>&) {}
};

/// `solve` of aba.h.
template <class T, class Parts>
void solve_once_in_parts(const Model<RealOf<T>>& model, Data<T>& d, Parts& parts) {
  carry_outdated_to_root(d);
  parts.before_solve(d);
  if (d.outdated[kPelvis]) {
    initialise_outdated(model, d);
    outdated_inertia_pass(model, d);
    aba_acceleration_pass(model, d);
    d.outdated.fill(false);
  }
}

/// `solve_accelerations` of step.h.
template <class T, class Parts>
void solve_in_parts(const Model<RealOf<T>>& model, const Target<T>& target, const State<T>& state, Data<T>& d,
                    Parts& parts) {
  compute_kinematics(model, state, d);
  compute_rigid_bodies(model, d);
  parts.after_rigid_bodies(d);
  d.self_wrench.fill({zero3<T>(), zero3<T>()});
  if (model.config.self_contact) add_self_contact(model, d);
  detect_ground(model, d);
  compute_joint_torques(model, state, target, d);
  use_pd_law(model, d);
  d.outdated.fill(true);
  solve_once_in_parts(model, d, parts);
  const MaskOf<T> all = T(1.0) > T(0.0);
  for (int pass = 1; pass < model.config.passes; ++pass) {
    relinearise_ground(model, all, d);
    apply_torque_bounds(model, d);
    solve_once_in_parts(model, d, parts);
  }
  for (MaskOf<T> again = correct_torque_bounds(model, d); any(again);
       again = correct_torque_bounds(model, d)) {
    relinearise_ground(model, again, d);
    solve_once_in_parts(model, d, parts);
  }
  find_applied_ground(model, d);
}

/// `step` of step.h, without its mask (`gone_wrong` of integration.h).
template <class T, class Parts>
void step_in_parts(const Model<RealOf<T>>& model, const Target<T>& target, State<T>& state, Data<T>& d,
                   Parts& parts) {
  solve_in_parts(model, target, state, d, parts);
  integrate(model, d, state);
}

}  // namespace mimicx::physics
