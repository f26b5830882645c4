/// The travel of the body against that of its feet: a translation that does not belong to the poses.
///
/// A foot that stands moves, relative to the pelvis, against the pelvis' own velocity. Where the feet walk
/// and the translation is another one, the foot slides over the floor. The ratio of both ways says what is
/// wrong: 0 for a missing translation or a treadmill, a negative one for a mirrored translation, 0.01 or 2.54
/// for another unit.
///
/// What it does not do: it looks along the floor, at clips that walk; feet that slide by less than 0.3 of the
/// way, as those of estimators do, are no contradiction.
#pragma once

#include <optional>

#include "motion/reference.h"

namespace mimicx::motion {

struct TravelContradiction {
  double slide_mm = 0;  ///< of the lowest point of a foot on the floor, a frame, in the median
  double ratio = 0;     ///< way of the pelvis along the way that the feet walk, over the latter
};

/// None unless the feet walk at least 0.4 m, in stretches of 0.2 s on one foot and at 0.3 m/s or more, the
/// pelvis' way differs from theirs by at least 0.8 of it (root of the sums of squares), and the feet on the
/// floor slide by at least 0.3 of it.
std::optional<TravelContradiction> travel_contradiction(const Character& character,
                                                        const PerFrame<BodyPoses>& poses, double fps);

}  // namespace mimicx::motion
