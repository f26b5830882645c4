/// DeepMimic motion clips: JSON with a row of 44 numbers per frame, for the humanoid of Peng et al.,
/// "DeepMimic: Example-Guided Deep Reinforcement Learning of Physics-Based Character Skills" (SIGGRAPH 2018).
///
///     {"Loop": "wrap", "Frames": [[duration, root position 3, root rotation 4, chest 4, neck 4,
///                                  right hip 4, knee 1, ankle 4, shoulder 4, elbow 1, left …the same], …]}
///
/// Rotations are quaternions w x y z relative to the parent; knees and elbows turn about z by an angle in
/// radians. Metres, y up; at rest the humanoid looks along x with its arms hanging. The files hold no bone
/// lengths: those of the published humanoid are used. Keys other than "Frames" must be valid JSON and are
/// ignored.
///
/// What it does not do: no other characters of that project (their rows have other lengths).
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// @param path  for messages; its stem is the motion's name
/// @param fps  the frame rate, whatever the durations say; none: that of the file
/// @throws DataError naming file and line
SkeletonMotion parse_deepmimic(std::string_view text, const std::filesystem::path& path,
                               const std::optional<double>& fps = {});

}  // namespace mimicx::import
