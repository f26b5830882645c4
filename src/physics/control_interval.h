/// One control interval: a policy or a plan sets the PD target at the frame rate, the physics runs faster,
/// and between two frames the target moves from the old one to the new one.
#pragma once

#include <functional>

#include "physics/step.h"

namespace mimicx::physics {

/// Called after every physics step with the states around it, what it aimed at and how it was solved.
template <class T>
using SubstepWatcher = std::function<void(const State<T>& before, const Target<T>& target,
                                          const Data<T>& solved, const State<T>& after)>;

/// `substeps` physics steps; step k = 1 … substeps aims at the share k / substeps of the way between the
/// targets: rotations by normalised linear interpolation the shorter way (for the few degrees between two
/// frames within rounding of a slerp), feed-forward velocities linearly.
/// @param substeps  ≥ 1
/// @param applied  where not null, what acted is added to it
/// @param watch  sees every physics step and changes none; may be empty
/// @param help  where not null, the constant wrench on the pelvis that `step` knows
/// @return mask of the lanes that went wrong in any of the steps
template <class T>
MaskOf<T> advance_interval(const Model<RealOf<T>>& model, const Target<T>& from, const Target<T>& to,
                           int substeps, State<T>& state, Data<T>& d, Applied<T>* applied = nullptr,
                           const SubstepWatcher<T>& watch = {}, const Wrench<T>* help = nullptr);

}  // namespace mimicx::physics
