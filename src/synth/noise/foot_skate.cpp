#include "synth/noise/foot_skate.h"

#include <algorithm>

#include "core/elementary.h"
#include "motion/prepare/feet.h"
#include "synth/noise/random_processes.h"

namespace mimicx::synth {
namespace {

constexpr double kSlipTau = 0.4;                              ///< of the slip's velocity, s
constexpr double kStandingReturn = 1.0, kFlyingReturn = 0.1;  ///< s
constexpr double kReach = 0.9999;                             ///< of the straight leg

/// Length of the third side of the triangle of two bones and the angle between their directions, inverted.
double angle_for(double thigh, double shank, double distance) {
  const double cosine = (distance * distance - thigh * thigh - shank * shank) / (2.0 * thigh * shank);
  return acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

PerFrame<Vector3d> drawn_slip(const PerFrame<bool>& standing, double speed, int ankle, std::uint64_t seed,
                              double fps) {
  const int frames = standing.count();
  Random random(seed, {kSkateStream, static_cast<std::uint64_t>(ankle)});
  const PerFrame<double> east = smooth_noise(random, frames, kSlipTau * fps),
                         north = smooth_noise(random, frames, kSlipTau * fps);
  PerFrame<Vector3d> slip(frames, Vector3d::Zero());
  for (int t = 1; t < frames; ++t) {
    const double back = standing[t] ? kStandingReturn : kFlyingReturn;
    const Vector3d pushed = standing[t] ? Vector3d(speed * east[t], speed * north[t], 0.0) : Vector3d::Zero();
    slip[t] = (slip[t - 1] + pushed / fps) / (1.0 + 1.0 / (back * fps));
  }
  return slip;
}

void move_ankle(const Character& character, const Vector3d& shift, int ankle, PerBody<Quaterniond>& q) {
  const int knee = kParents[ankle], hip = kParents[knee];
  const Quaterniond q_root = q[kPelvis], old_hip = q_root * q[hip], old_shank = old_hip * q[knee];
  const Vector3d upper = character.joint_offset[knee],
                 lower = q[knee] * character.joint_offset[ankle];  // in the thigh's frame
  const Vector3d to_ankle = old_hip * (upper + lower), wanted = to_ankle + shift;
  const double reach = kReach * (upper.norm() + lower.norm());
  const double angle = angle_for(upper.norm(), lower.norm(), std::min(wanted.norm(), reach));
  const Vector3d across = upper.cross(lower);
  const Vector3d axis =
      across.norm() > 1e-4 * upper.norm() * lower.norm() ? Vector3d(across.normalized()) : hinge_axis(knee);
  q[knee] = exp_map((angle - angle_between(upper, lower)) * axis) * q[knee];
  const Vector3d bent = old_hip * (upper + q[knee] * character.joint_offset[ankle]);
  const Quaterniond new_hip = rotation_between(bent, wanted) * old_hip;
  q[hip] = (q_root.conjugate() * new_hip).normalized();
  const Quaterniond foot = old_shank * q[ankle];
  q[ankle] = ((new_hip * q[knee]).conjugate() * foot).normalized();
}

void skate(const Character& character, const PerFrame<BodyPoses>& truth, double speed, std::uint64_t seed,
           double fps, EstimatedMotion& motion) {
  if (speed == 0.0) return;
  for (int ankle : {kLeftAnkle, kRightAnkle}) {
    const PerFrame<Vector3d> slip =
        drawn_slip(motion::standing_frames(truth, ankle, fps), speed, ankle, seed, fps);
    for (int t = 0; t < slip.count(); ++t) move_ankle(character, slip[t], ankle, motion.q[t]);
  }
}

}  // namespace mimicx::synth
