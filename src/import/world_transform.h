/// Changes of the world a clip stands in: its axes, its unit of length, the height of its floor.
///
/// SMPL's trans is not the pelvis: pelvis = trans + J0, and a rotation of the model turns about its pelvis. A
/// change of the world moves the pelvis, and what is stored follows: trans' = R (trans + J0) − J0
/// (docs/method.md §2).
/// Cameras move along, so that pixels stay what they are.
#pragma once

#include <string>

#include "motion/clip.h"

namespace mimicx::import {

/// p → R p for every point of the world.
void rotate_world(const Quaterniond& R, motion::Clip& clip);

/// trans and the cameras' places in another unit; the body is in metres already. @param scale  m per unit
void scale_world(double scale, motion::Clip& clip);

/// p → p + shift (m).
void shift_world(const Vector3d& shift, motion::Clip& clip);

/// The rotation that takes an axis to z: 'x', 'y', 'z', or 'X', 'Y', 'Z' for the negative ones.
/// @throws std::invalid_argument for another letter
Quaterniond rotation_to_z_up(char axis);
/// The letter of the axis that a direction lies along most, as `rotation_to_z_up` takes it.
char axis_letter(const Vector3d& direction);
/// "y", "-y", …
std::string axis_name(char axis);

}  // namespace mimicx::import
