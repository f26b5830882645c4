/// Changes a clip's world: its axes, its unit of length, the height of its floor.
///
/// SMPL's trans is not the pelvis' position: pelvis = trans + J0, and the model rotates about its pelvis. A
/// rotation R of the world therefore gives trans' = R (trans + J0) − J0 (docs/method.md §2). Cameras move
/// with the world, so keypoints in pixels stay valid; so does a camera of a file without usable keypoints.
#pragma once

#include <string>

#include "motion/clip.h"

namespace mimicx::import {

/// p → R p for every point of the world.
void rotate_world(const Quaterniond& R, motion::Clip& clip);

/// Converts trans and the cameras' positions to metres; the body is in metres already.
/// @param scale  m per unit
void scale_world(double scale, motion::Clip& clip);

/// p → p + shift (m). Plates stand on the floor z = 0 as before.
void shift_world(const Vector3d& shift, motion::Clip& clip);

/// The rotation that takes an axis to z: 'x', 'y', 'z', or 'X', 'Y', 'Z' for the negative ones.
/// @throws std::invalid_argument for another letter
Quaterniond rotation_to_z_up(char axis);
/// The letter of the axis nearest to a direction, as for `rotation_to_z_up`.
char axis_letter(const Vector3d& direction);
/// "y", "-y", …
std::string axis_name(char axis);

}  // namespace mimicx::import
