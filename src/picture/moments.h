/// Which moments of a motion are shown.
#pragma once

#include "core/containers.h"
#include "picture/posed_motion.h"

namespace mimicx::picture {

/// A stretch of time, s.
struct Stretch {
  double first = 0, last = 0;
};

/// Moments at equal distances, both ends among them; of one moment the middle.
List<double> even_moments(const Stretch& stretch, int count);

/// The moment that says most about a motion: whose pose is farthest from the motion's mean one, in the mean
/// square of the joints' places relative to the pelvis, seen from where the body looks.
double telling_moment(const PosedMotion& motion, const Stretch& stretch);

}  // namespace mimicx::picture
