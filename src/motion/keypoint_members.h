/// Keypoints and their camera as members of an archive (docs/formats.md).
#pragma once

#include <functional>

#include "core/npz/npz_archive.h"
#include "motion/clip.h"

namespace mimicx::motion {

/// Names of the members.
extern const std::vector<std::string> kKeypointMembers;

/// Reads and checks the keypoints, or warns where the archive has some without a camera.
/// @param clip  with its rotations; gets keypoints, decisions and warnings
/// @return whether there were keypoints with a camera
/// @throws DataError naming file and member
bool read_keypoints(const Npz& npz, Clip& clip);

void add_keypoints(Npz& npz, const Keypoints& keypoints);

/// Changes every camera of a clip: those of its keypoints, and those of an archive without usable keypoints,
/// which pass through. A camera that passes through and is no matrix world → camera is left out, with a
/// warning.
/// @param change  of one matrix, world → camera
void change_cameras(const std::function<void(Eigen::Matrix4d&)>& change, Clip& clip);

}  // namespace mimicx::motion
