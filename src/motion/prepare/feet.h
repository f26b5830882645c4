/// Feet: the step of preparation (prepare.h) that levels soles and bends toes.
///
/// Estimated and converted motions often have a constant error in the pitch of the feet: a person who stands
/// flat stands on the toes or the heels. A simulated character would have its support in the wrong place.
/// The sole of a standing foot is level. Therefore the median direction of "up" in the foot's frame over its
/// standing frames shows the constant error, and one constant rotation removes it. A foot that stands level
/// in a quarter of these frames has none: its heel may be up in the others. But nobody stands on the edge of
/// a foot, so what is left from side to side is removed where it is.
///
/// What it does not do: it keeps the foot's pitch relative to that constant, so heel strikes and push-offs
/// remain. It does not change feet that hardly ever stand or whose tilt is too large for an error.
#pragma once

#include "motion/reference.h"
#include "motion/surface_points.h"

namespace mimicx::motion {

/// Frames in which a foot stands: ankle and ball are slower than 0.4 m/s, and the ankle is within 6 cm of its
/// lowest height (10th percentile) over the ground. @param ankle  kLeftAnkle or kRightAnkle
PerFrame<bool> standing_frames(const PerFrame<BodyPoses>& poses, int ankle, double fps,
                               const Scene& scene = {});

/// Levels both soles and both toes: by a constant rotation of at most 30°, then from side to side by the
/// median tilt of the standing frames within 0.3 s, smoothly. `poses` must be those of `frames` and are not
/// updated. Feet with fewer than 10 standing frames, a constant error under 10° or a tilt under 5° stay
/// unchanged: a policy corrects small errors, and the feet of such clips drift by about as much.
/// @return largest rotation applied, degrees
double level_feet(Reference& reference);

/// As `lowest_resting_heights`, but points of a foot that swings through the side of a box count as on it:
/// what is wrong there is the place of the foot, not the height of the body.
/// @param swinging_toes  false: toes of feet that do not stand are left out
PerFrame<double> standing_heights(const std::vector<SurfacePoint>& points, const PerFrame<BodyPoses>& poses,
                                  double fps, const Scene& scene, bool swinging_toes = true);

/// Height of the lowest surface point per frame, m. The toes of feet that do not stand are left out:
/// converted motions seldom bend their toes, and stiff toes that dip at push-off do not show the floor.
PerFrame<double> support_heights(const Reference& reference);

/// The angle, rad, by which toes that reach below the ground must extend to lie on it: at most 60°; 0 where
/// they do not. @param ball  kLeftFoot or kRightFoot
double toe_extension(const Character& character, const BodyPoses& pose, int ball, const Scene& scene = {});

/// Extends toes that reach below the ground until they lie on it, by at most 60°. `poses` must be
/// those of `frames` and are not updated.
void bend_toes(Reference& reference);

}  // namespace mimicx::motion
