/// Motions as the page's base64 digits (base64_digits.h), frame by frame.
///
/// World z up. Lengths are whole millimetres: 3 digits for world positions (±131 m), 2 digits for positions
/// within 2 m of the pelvis, to which the page adds the pelvis.
#pragma once

#include <string>
#include <vector>

#include "character/character.h"
#include "files/floor_forces.h"
#include "report/support_polygon.h"

namespace mimicx::report {

/// [frame]: position of the pelvis (3 of 3 digits), then the rotation vectors of all bodies in the world,
/// [body][3] numbers of 2 digits, π/2048 rad. The page computes joints from these and the bones. The rounding
/// of a bone's direction moves its end by 0.3 mm for a bone of 0.4 m.
std::string encode_poses(const std::vector<BodyPoses>& poses);

/// [frame][3] of 3 digits.
std::string encode_centers(const Character& character, const std::vector<BodyPoses>& poses);

/// [frame]: how many corners (a count of 1 digit), then x and y of each from the pelvis, 2 digits.
/// @param support  as many frames as poses, or none
std::string encode_support(const std::vector<Polygon>& support, const std::vector<BodyPoses>& poses);

/// Arrows of every frame, [frame][3][5] numbers of 3 digits: x and y of the point in mm, force in N.
std::string encode_ground(const std::vector<files::FloorArrows>& ground);

/// [frame][body] of 2 digits: torque of the body's joint in thousandths of its bound.
std::string encode_torques(const std::vector<PerBody<double>>& shares);

}  // namespace mimicx::report
