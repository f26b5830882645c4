/// Why a plan was lost, in words that a person can act on.
#pragma once

#include <string>

#include "control/plan.h"
#include "motion/reference.h"

namespace mimicx::pipeline {

/// "the plan is lost at frame 132 (4.40 s): left_foot is 0.41 m from its reference; …", and what would have
/// to push or turn the reference's body from outside in the frames that lead there, whatever the floor gives
/// it (pipeline/audit/audit.h, poses alone). Where that is next to nothing a body could follow, and the
/// search failed.
std::string loss_in_words(const motion::Reference& reference, const control::Loss& loss);

}  // namespace mimicx::pipeline
