/// Why a plan was lost, in words that a person can act on.
#pragma once

#include <string>

#include "control/plan.h"
#include "judge/reference_needs.h"

namespace mimicx::plan {

/// "the plan is lost at frame 132 (4.40 s): the left foot is 0.41 m from its reference; …", then what the
/// reference asks for within a second before that no body can do (audit/pose_verdict.h), and how
/// much help it took to pass (reference_needs.h). Where the poses ask for next to nothing, a body could
/// follow, and it is the search that failed: the sentence says so.
std::string loss_in_words(const control::Loss& loss, const audit::PoseNeeds& needs,
                          const PerFrame<Vector6d>& help);

}  // namespace mimicx::plan
