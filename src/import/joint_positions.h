/// Motions that hold joint positions only, as motion generators write them; rotations are computed for them.
///
///     (frames, 22, 3): positions of the 22 joints of SMPL, in the order of `Body`; unit and up axis are
///     detected
///
///     (frames, 263): HumanML3D's features. Per frame: the root's turn about y to the next frame (half the
///     angle, rad), its step in x and z in its own heading (m), its height (m), the other 21 joints relative
///     to the root in its heading (63), and numbers that follow from these: rotations (126), velocities (66),
///     contacts (4)
///
/// Source of the features: Guo et al., "Generating Diverse and Natural 3D Human Motions from Text" (CVPR
/// 2022), its code's recover_from_ric; y up, metres. Both formats are taken to be at 20 fps, which of joint
/// positions is an assumption.
///
/// Positions do not determine how a bone turns about its own axis. Pelvis and chest turn with hips, shoulders
/// and trunk. A thigh or upper arm turns so that its hinge is perpendicular to the plane in which knee or
/// elbow bends; the straighter the limb, the more it turns with its parent instead. Feet point to their toes;
/// hands and head turn with their parents.
///
/// What it does not do: no retargeting (retarget.h does it with this skeleton), no hands.
#pragma once

#include <string>
#include <string_view>

#include "core/npz/npy_array.h"
#include "import/retarget/skeleton.h"

namespace mimicx::import {

inline constexpr double kPositionsFps = 20.0;
/// The decision of files that tell no frame rate.
inline constexpr const char* kAssumedRate =
    "frame rate: 20 fps, assumed: the file tells none, motion generators use it; --fps overrides";
/// The end of the decision about frames that are left out because they are empty.
inline constexpr std::string_view kPaddingLeftOut = " are empty (padding) and are left out";
inline constexpr std::size_t kHumanMl3dFeatures = 263;

/// Whether an array of this shape is in one of the two formats.
bool is_positions(const std::vector<std::size_t>& shape);

/// @param path  for messages
/// @throws DataError for features that are normalised, numbers that are not finite, and bones of length 0
SkeletonMotion skeleton_of_positions(const NpyArray& array, const std::string& name, const std::string& path);

}  // namespace mimicx::import
