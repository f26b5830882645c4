/// Gravity that does not point down: the world of a camera whose pitch was not removed.
///
/// A person who stands puts three directions along gravity: the normal of the plane through the places of the
/// soles, the normal of the soles, and the line from the feet to the centre of mass, each in the mean over
/// the clip. One that is not vertical has other causes: stairs, an estimator's error in the pitch of the
/// feet, a seat. All three lean the same way only where the world is tilted.
///
/// What it does not do: it does not turn the motion, and does not see less than 10° or more than 60°.
#pragma once

#include <optional>

#include "motion/reference.h"

namespace mimicx::motion {

struct GroundSlope {
  double degrees = 0;  ///< the middle one of the three
  Vector3d up =
      Vector3d::UnitZ();  ///< unit vector against gravity as the three have it, in the motion's world
};

/// The slope on which the feet stand; none where the three directions do not agree, or fewer than 10 frames
/// have a foot with no point of the sole faster than 0.3 m/s.
std::optional<GroundSlope> ground_slope(const Character& character, const PerFrame<BodyPoses>& poses,
                                        double fps);

}  // namespace mimicx::motion
