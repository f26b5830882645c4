/// Joint centres of a person from markers, for the reader of joint positions (joint_positions.h).
///
///     hip       regression on the distances between both ASIS and from ASIS to PSIS (or the sacrum):
///               M. E. Harrington et al., J. Biomech. 40 (2007): in the frame of the pelvis, from the middle
///               of the ASIS, mm: forward −0.24 PD − 9.9, up −0.30 PW − 10.9, outwards 0.33 PW + 7.3
///     knee      middle of the epicondyles. With the lateral one alone, the point of the line
///               through it along the pelvis' transverse axis; without, the point of the knee's functional
///               axis (functional_axis.h) that is nearest to the line from hip to ankle
///     ankle     middle of the malleoli. With the lateral one alone, the point of the same line through it;
///               without, the point of the ankle's functional axis that lies in the plane of hip, heel and
///               toes
///     foot      middle of the first toe or metatarsal and of the fifth metatarsal
///     shoulder  17 % of the distance of the shoulders below the acromion: G. Rab, K. Petuskey, A. Bagley,
///               Gait & Posture 15 (2002)
///     elbow, wrist, head   middles of their markers
///
/// Pelvis, spine, collars and neck, and a head without markers, stand as in the standard body at rest, scaled
/// to the trunk.
///
/// On a treadmill the standing foot moves back while the pelvis stays in place. The belt's velocity is taken
/// out of such motions, so that they walk over ground.
///
/// What it does not do: no smoothing, no static trial, no bodies without arms.
#pragma once

#include "import/opensim/markers.h"
#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// @param up  unit vector, the file's
/// @throws DataError where a joint has no markers
PerFrame<PerBody<Vector3d>> joints_of_markers(const Markers& markers, const Vector3d& up,
                                              std::vector<std::string>& decisions,
                                              std::vector<std::string>& warnings);

/// A .trc as a motion on a skeleton. Without `up` it is y, except where the body clearly stands along another
/// axis. @param path  for messages @param up, metres  of the file, as asked for
/// @throws DataError where its Units give a body that no person has
SkeletonMotion skeleton_of_markers(std::string_view text, const std::string& name, const std::string& path,
                                   std::optional<char> up = {}, std::optional<double> metres = {});

}  // namespace mimicx::import
