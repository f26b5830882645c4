/// Storage files for OpenSim: the forces of the floor (.mot) and the moments in the joints (.sto).
///
/// OpenSim's ground: y up, metres, newtons; (x, y, z) of our world is its (x, z, −y). A row holds means over
/// the interval between two frames, at the time of its middle.
///
/// The .mot has, for the right foot, the left foot and, where anything else touches the floor, the rest of
/// the body (`r`, `l`, `o`): ground_force_r_vx vy vz, ground_force_r_px py pz, ground_torque_r_x y z.
/// OpenSim's external loads refer to them as ground_force_r_v, ground_force_r_p and ground_torque_r_,
/// expressed in ground.
///
/// The .sto has a column per degree of freedom: NAME_flexion_moment of knees and elbows, NAME_moment_x y z of
/// every other joint, on the segment beyond the joint, along its own axes, which for OpenSim at rest are x
/// forward, y up, z to the right. Behind them the legs' moments by the coordinates of OpenSim's gait models
/// (gait2392: S. L. Delp et al., IEEE Trans. Biomed. Eng. 37 (1990)), as its inverse dynamics prints them:
/// hip_flexion_r_moment, knee_angle_r_moment, ankle_angle_r_moment and those of `l`. The axes are the
/// pelvis' leftward axis, the knee's hinge and the ankle's oblique one; positive flexes the hip, extends the
/// knee and lifts the toes.
///
/// Format: OpenSim, "Storage (.sto) Files" and "Motion (.mot) Files" of its User's Guide.
#pragma once

#include <string>
#include <string_view>

#include "files/floor_forces.h"

namespace mimicx::files {

/// The first bytes of every file that is written here.
inline constexpr std::string_view kMotOpening = "mimicx ground reaction\nversion=1\n",
                                  kStoOpening = "mimicx joint moments\nversion=1\n";

inline constexpr int kGaitMoments = 3;
/// Moments of hip, knee and ankle of a leg by the coordinates of gait2392, N·m, as in the .sto.
/// @param torque  `RecordedForces::torque`
Array<double, kGaitMoments> gait_moments(const BodyPoses& poses, const PerBody<Vector3d>& torque, bool right);
/// "hip_flexion_r_moment"
std::string gait_moment_name(int joint, bool right);

std::string format_mot(const motion::Clip& clip, const RecordedForces& forces);
std::string format_sto(const motion::Clip& clip, const RecordedForces& forces);

}  // namespace mimicx::files
