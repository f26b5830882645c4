/// Feet: the step of preparation (prepare.h) that levels soles and bends toes.
///
/// Estimators and converted skeletons often carry a constant error in the pitch of the feet: a person who
/// stands flat comes out on tip-toe or on the heels, and a simulated character that is asked to stand there
/// has its support in the wrong place. While a foot stands, its sole is level; so the median direction of
/// "up" in the foot's own frame over its standing frames gives the constant error, and one constant rotation
/// removes it.
///
/// What it does not do: it never changes how a foot moves relative to that constant, so a heel strike or a
/// push-off stays one, and it leaves feet alone that hardly ever stand or that tilt beyond what an error can
/// be.
#pragma once

#include "motion/reference.h"

namespace mimicx::motion {

/// Frames in which a foot stands: ankle and ball slower than 0.4 m/s and the ankle within 6 cm of where it is
/// lowest (10th percentile). @param ankle  kLeftAnkle or kRightAnkle
PerFrame<bool> standing_frames(const PerFrame<BodyPoses>& poses, int ankle, double fps);

/// Levels both soles and both toes by constant rotations of at most 30°; `poses` must be those of `frames`
/// and are stale afterwards. Feet with fewer than 10 standing frames, or less than 10° off,
/// stay as they are: a policy corrects small errors itself, and the feet of such clips drift about as much.
/// @return largest rotation applied, degrees
double level_feet(Reference& reference);

/// Height of the lowest surface point per frame, m, without the toes of feet that do not stand: converted
/// motions seldom bend their toes, and stiff toes that dip at push-off say nothing about the floor.
PerFrame<double> support_heights(const Reference& reference);

/// Extends toes that reach below the floor (z = 0) until they lie on it, by at most 60°. `poses` must be
/// those of `frames` and are stale afterwards.
void bend_toes(Reference& reference);

}  // namespace mimicx::motion
