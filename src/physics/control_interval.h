/// One control interval: a policy or a plan sets the PD target at the frame rate, the physics runs at a
/// higher rate, and between two frames the target moves from the old one to the new one.
///
/// The target is that of an action a ∈ R⁵⁵: a rotation per joint, as a rotation vector for ball joints and an
/// angle about the axis for hinges (docs/method.md §4). Policies and plans share these functions, so that a
/// plan replayed as actions gives the same bytes.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "physics/step.h"

namespace mimicx::physics {

/// The joint's rotation in an action. Entries beyond ± `limit` (rad) are clamped; non-finite entries count as
/// 0.
/// @param entry  maps a degree of freedom 0 … 54 to its entry
template <class Entry>
Vector3d action_rotation(int body, double limit, const Entry& entry) {
  const auto bounded = [&](int dof) {
    const double a = static_cast<double>(entry(dof));
    return std::isfinite(a) ? std::clamp(a, -limit, limit) : 0.0;
  };
  const int dof = first_dof(body);
  if (is_hinge(body)) return bounded(dof) * hinge_axis(body);
  return {bounded(dof), bounded(dof + 1), bounded(dof + 2)};
}

/// The target of a residual action: the reference's joint rotation, turned further in the child's frame.
inline Quaterniond residual_target(const Quaterniond& reference, const Vector3d& rotation) {
  return reference * exp_map(rotation);
}

/// Called after every physics step with the states before and after it, its target and the solver's data.
template <class T>
using SubstepWatcher = std::function<void(const State<T>& before, const Target<T>& target,
                                          const Data<T>& solved, const State<T>& after)>;

/// What drives the character during one interval. Refers to its parts.
template <class T>
struct IntervalInput {
  const Target<T>& from;                  ///< at the start
  const Target<T>& to;                    ///< at the end
  int substeps;                           ///< physics steps, ≥ 1
  const Wrench<T>* assistance = nullptr;  ///< if not null, `assistance` of `step`, constant
};

/// Does the physics steps of an interval. Step k = 1 … substeps aims at the share k / substeps of the way
/// between the targets: rotations by normalised linear interpolation the shorter way (for the few degrees
/// between two frames within rounding of a slerp), feed-forward velocities linearly.
/// @param applied  if not null, the torques and forces that acted are added to it
/// @param watch  sees every physics step and changes none; may be empty
/// @return mask of the lanes that went wrong in any of the steps
template <class T>
MaskOf<T> advance_interval(const Model<RealOf<T>>& model, const IntervalInput<T>& input, State<T>& state,
                           Data<T>& d, Applied<T>* applied = nullptr, const SubstepWatcher<T>& watch = {});

}  // namespace mimicx::physics
