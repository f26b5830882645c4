/// Motions of joint positions alone, as motion generators write them, and the rotations that go with them.
///
///     (frames, 22, 3): positions of the 22 joints of SMPL, in the order of `Body`; unit and up axis are
///     found
///
///     (frames, 263): HumanML3D's features. Of a frame the turn of the root about y to the next frame (half
///     the angle, rad), its step in x and z in its own heading (m), its height (m), then the other 21 joints
///     from the root in its heading (63), and what follows from these: rotations (126), velocities (66),
///     contacts (4)
///
/// Source of the features: Guo et al., "Generating Diverse and Natural 3D Human Motions from Text" (CVPR
/// 2022), its code's recover_from_ric; y up, metres, 20 fps. Both are taken to be at 20 fps.
///
/// Positions do not say how a bone turns about itself. Pelvis and chest turn as hips, shoulders and trunk
/// show; a thigh or upper arm turns so that its hinge is across the plane in which knee or elbow bends, the
/// less the straighter they are, and as its parent then; feet point where their toes are; hands and head
/// follow.
///
/// What it does not do: no retargeting (retarget.h takes the skeleton from here), no hands.
#pragma once

#include <string>

#include "core/npz/npy_array.h"
#include "import/retarget/skeleton.h"

namespace mimicx::import {

inline constexpr double kPositionsFps = 20.0;
inline constexpr std::size_t kHumanMl3dFeatures = 263;

/// Whether an array of this shape is one of the two.
bool is_positions(const std::vector<std::size_t>& shape);

/// @param path  for messages
/// @throws DataError for features that are normalised, numbers that are not finite, and bones of no length
SkeletonMotion skeleton_of_positions(const NpyArray& array, const std::string& name, const std::string& path);

}  // namespace mimicx::import
