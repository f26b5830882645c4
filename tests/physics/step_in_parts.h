/// A step put together from the public parts of the physics headers, in the order of step.cpp, for those who
/// watch it between two parts or put another one in a part's place. With `StepParts` itself it gives the bits
/// of `step` (step_in_parts_test.cpp).
#pragma once

#include "physics/aba.h"
#include "physics/integration.h"

namespace mimicx::physics {

/// What a step spends its time on.
enum Stage {
  kKinematics,
  kSelfContact,
  kFloor,
  kJointTorques,
  kInertia,
  kAcceleration,
  kIntegration,
  kStages
};

/// What can be watched or replaced: a struct derived from this one hides the functions that it has itself.
struct StepParts {
  /// At the end of every stretch of a stage.
  void finished(Stage) {}
  /// Before the first pass; `detect_ground` has linearised the contacts at the start of the step.
  template <class T>
  void linearise_first(const Model<RealOf<T>>&, Data<T>&) {}
  /// Before every later solve, in the lanes that are to be solved again.
  template <class T>
  void linearise_again(const Model<RealOf<T>>& model, const MaskOf<T>& lanes, Data<T>& d) {
    relinearise_ground(model, lanes, d);
  }
  /// d.changed has the bodies that the next solve forms anew.
  template <class T>
  void before_solve(Data<T>&) {}
};

/// `solve` of aba.h.
template <class T, class Parts>
void solve_once_in_parts(const Model<RealOf<T>>& model, Data<T>& d, Parts& parts) {
  carry_changes_to_root(d);
  parts.before_solve(d);
  if (d.changed[kPelvis]) {
    aba_initialise(model, d);
    aba_inertia_pass(model, d);
    parts.finished(kInertia);
    aba_acceleration_pass(model, d);
    d.changed.fill(false);
  }
  parts.finished(kAcceleration);
}

/// `solve_accelerations` of step.h.
template <class T, class Parts>
void solve_in_parts(const Model<RealOf<T>>& model, const Target<T>& target, const State<T>& state, Data<T>& d,
                    Parts& parts) {
  compute_kinematics(model, state, d);
  compute_rigid_bodies(model, d);
  parts.finished(kKinematics);
  d.self_wrench.fill({zero3<T>(), zero3<T>()});
  if (model.config.self_contact) add_self_contact(model, d);
  parts.finished(kSelfContact);
  detect_ground(model, d);
  parts.linearise_first(model, d);
  parts.finished(kFloor);
  compute_joint_torques(model, state, target, d);
  use_pd_law(model, d);
  parts.finished(kJointTorques);
  d.changed.fill(true);
  solve_once_in_parts(model, d, parts);
  const MaskOf<T> all = T(1.0) > T(0.0);
  for (int pass = 1; pass < model.config.passes; ++pass) {
    parts.linearise_again(model, all, d);
    parts.finished(kFloor);
    apply_torque_bounds(model, d);
    parts.finished(kJointTorques);
    solve_once_in_parts(model, d, parts);
  }
  for (MaskOf<T> again = saturate_exceeding(model, d); any(again); again = saturate_exceeding(model, d)) {
    parts.finished(kJointTorques);
    parts.linearise_again(model, again, d);
    parts.finished(kFloor);
    solve_once_in_parts(model, d, parts);
  }
  parts.finished(kJointTorques);
  find_applied_ground(model, d);
  parts.finished(kFloor);
}

/// `step` of step.h, without its mask (`gone_wrong` of integration.h).
template <class T, class Parts>
void step_in_parts(const Model<RealOf<T>>& model, const Target<T>& target, State<T>& state, Data<T>& d,
                   Parts& parts) {
  solve_in_parts(model, target, state, d, parts);
  integrate(model, d, state);
  parts.finished(kIntegration);
}

}  // namespace mimicx::physics
