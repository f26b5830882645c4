/// The external force that a reference would need: for the manifest, for feasibility/NAME.npz, and in words.
///
/// The poses alone give an external force (audit/pose_needs.h). If a plan failed, its assisted stage gives
/// another one, with simulated contacts: the assistive force on the pelvis that remained although it has a
/// cost.
#pragma once

#include <string>

#include "audit/pose_needs.h"
#include "core/named_values.h"
#include "motion/reference.h"
#include "physics/model.h"
#include "record/feasibility_file.h"

namespace mimicx::judge {

/// In the world of a simulation. Without frames if the reference has fewer than 3.
audit::PoseNeeds needs_of(const motion::Reference& reference,
                          const physics::SimulationConfig& simulation = {});

/// Frames that the assisted stage reached, mean and largest force, acceleration and moment of its assistance,
/// and the frame of the largest force. Empty without assistance. @param assistance  moment and force, N·m, N
NamedValues assistance_values(const PerFrame<Vector6d>& assistance, double mass);

/// "with assistive forces the body passes frames 0-21: at most 310 N (4.4 m/s2) at frame 5 and 90 N (1.3
/// m/s2) on average push the pelvis, at most 120 N m turn it". Empty if there was no assistance in these
/// frames.
std::string assistance_in_words(const PerFrame<Vector6d>& assistance, double mass, int first, int last);

record::FrameFeasibility frame_feasibility(const audit::PoseNeeds& needs,
                                           const PerFrame<Vector6d>& assistance);

}  // namespace mimicx::judge
