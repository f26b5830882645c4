/// Chooses the moments of a motion that a picture shows.
#pragma once

#include "core/containers.h"
#include "picture/posed_motion.h"

namespace mimicx::picture {

/// A range of time, s.
struct TimeSpan {
  double first = 0, last = 0;
};

/// Evenly spaced moments including both ends; the middle for a count of 1.
List<double> even_moments(const TimeSpan& stretch, int count);

/// The most characteristic moment of a motion: its pose has the largest mean square distance from the
/// motion's mean pose, with joints relative to the pelvis and its heading.
double telling_moment(const PosedMotion& motion, const TimeSpan& stretch);

}  // namespace mimicx::picture
