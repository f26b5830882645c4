/// Simulated and prepared motions as files in our own layout (docs/formats.md).
#pragma once

#include <filesystem>

#include "files/archive_members.h"
#include "motion/clip.h"
#include "motion/reference.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::files {

/// The simulated motion: poses, joints, velocities, joint torques, ground and self-contact wrenches, rewards
/// and their factors; members of the input that the program does not use are copied, resampled to its frames
/// (motion/passthrough.h).
/// @param more  further members, such as how the feet may share their load
void write_simulated(const std::filesystem::path& path, const motion::Clip& input,
                     const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout,
                     const Members& more = {});

/// The poses of an input as they were read, in our world, at its own frame rate, for the report. Without
/// passed-through members.
void write_input(const std::filesystem::path& path, const motion::Clip& input);

/// The prepared reference of an input.
void write_reference(const std::filesystem::path& path, const motion::Clip& input,
                     const motion::Reference& reference);

}  // namespace mimicx::files
