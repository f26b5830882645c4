/// Whether the rotations of a BVH file are radians. The format has degrees; scripts forget to convert.
///
/// A file of radians has no number over three turns. Read as degrees its body hardly leaves the rest pose,
/// and slides; read as radians it moves like a person: knees bend forward, the trunk stays over the legs,
/// nothing whirls.
#pragma once

#include "import/landmarks.h"

namespace mimicx::import {

/// Whether a file may have radians, by the largest number in its rotation channels.
bool may_be_radians(double largest);

enum class AngleUnit { kDegrees, kRadians, kUnsure };
/// @param as_degrees, as_radians  the poses of the file, read in both ways
AngleUnit decide_angle_unit(const PerFrame<Landmarks>& as_degrees, const PerFrame<Landmarks>& as_radians,
                            double largest);

}  // namespace mimicx::import
