#include "import/retarget/retarget_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/elementary.h"
#include "core/quantile.h"

namespace mimicx::import {
namespace {

constexpr double kOtherRatio = 0.12;          ///< of thigh to shank
constexpr double kRestingKnee = 0.13;         ///< m over the floor
constexpr double kRestingSpeed = 0.35;        ///< m/s
constexpr double kKneeRadius = 0.055;         ///< m
constexpr double kSole = 0.08, kToes = 0.02;  ///< m under ankle and toes
constexpr double kEaseTime = 0.2;             ///< s on either side

struct LegJoints {
  int hip, knee, ankle, foot;
};
constexpr std::array<LegJoints, 2> kSides = {
    {{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}, {kRightHip, kRightKnee, kRightAnkle, kRightFoot}}};

/// Height of the floor under the skeleton, m.
double floor_under(const PerFrame<Landmarks>& frames) {
  std::vector<double> lowest;
  for (const Landmarks& pose : frames) {
    double low = pose.p[kLeftAnkle].z() - kSole;
    for (const LegJoints& leg : kSides)
      low = std::min({low, pose.p[leg.ankle].z() - kSole, pose.p[leg.foot].z() - kToes});
    lowest.push_back(low);
  }
  return quantile(lowest, 0.1);
}

/// How far the pelvis must move for resting knees to lie on the floor, m per frame; 0 where none rests.
/// @param floor  of the skeleton @param lift  of our poses over the scaled skeleton
std::vector<double> knee_shifts(const PerFrame<Landmarks>& frames, const PerFrame<BodyPoses>& poses,
                                double fps, double floor, double leg_ratio) {
  std::vector<double> shifts(frames.size(), 0.0);
  for (int t = 0; t < frames.count(); ++t)
    for (const LegJoints& leg : kSides) {
      const int next = std::min(t + 1, frames.count() - 1), before = std::max(next - 1, 0);
      const double speed = fps * (frames[next].p[leg.knee] - frames[before].p[leg.knee]).norm();
      if (frames[t].p[leg.knee].z() - floor > kRestingKnee || speed > kRestingSpeed) continue;
      const double shift = leg_ratio * floor + kKneeRadius - poses[t].p_WB[leg.knee].z();
      double& now = shifts[static_cast<std::size_t>(t)];
      now = now == 0.0 ? shift : std::min(now, shift);
    }
  return shifts;
}

/// Spreads shifts over the frames around, so that none begins at once.
std::vector<double> eased(const std::vector<double>& shifts, double fps) {
  const int reach = std::max(1, static_cast<int>(std::lround(kEaseTime * fps))),
            count = static_cast<int>(shifts.size());
  std::vector<double> out(shifts.size());
  for (int t = 0; t < count; ++t) {
    double sum = 0.0, weights = 0.0;
    for (int s = std::max(0, t - reach); s <= std::min(count - 1, t + reach); ++s) {
      const double weight = reach + 1 - std::abs(s - t);
      sum += weight * shifts[static_cast<std::size_t>(s)];
      weights += weight;
    }
    out[static_cast<std::size_t>(t)] = sum / weights;
  }
  return out;
}

/// Distance from hip to ankle, m: `wanted`, but for legs that are nearly straight. The change of their `own`
/// distance stays below half of what they lack to be straight: else their knees would bend with every
/// millimetre.
double eased_distance(double own, double wanted, double length) {
  const double most = 0.5 * std::max(length - own, 1e-9), change = wanted - own;
  return own + change / hypot(1.0, change / most);
}

/// Bends a leg so that its ankle comes to `target`; the foot keeps its rotation in the world.
void reach_for(const Character& character, const LegJoints& leg, const Vector3d& target, BodyPoses& pose) {
  const double thigh = character.joint_offset[leg.knee].norm(),
               shank = character.joint_offset[leg.ankle].norm();
  const Vector3d hip = pose.p_WB[leg.hip], to = target - hip;
  const double far = 0.9999 * (thigh + shank), near = 1.0001 * std::abs(thigh - shank) + 1e-6;
  const double own = (pose.p_WB[leg.ankle] - hip).norm();
  const double distance = std::clamp(eased_distance(own, to.norm(), thigh + shank), near, far);
  const Vector3d axis = to.normalized();
  Vector3d bend = pose.p_WB[leg.knee] - hip;
  bend -= bend.dot(axis) * axis;
  if (!(bend.norm() > 1e-6)) return;  // straight: its plane is not known, and it reaches its end
  const double along = (distance * distance + thigh * thigh - shank * shank) / (2.0 * distance);
  const Vector3d knee =
      hip + along * axis + std::sqrt(std::max(0.0, thigh * thigh - along * along)) * bend.normalized();
  const Vector3d ankle = hip + distance * axis;
  pose.q_WB[leg.hip] = swung(pose.q_WB[leg.hip], character.joint_offset[leg.knee], knee - hip);
  pose.q_WB[leg.knee] = swung(pose.q_WB[leg.knee], character.joint_offset[leg.ankle], ankle - knee);
}

}  // namespace

bool has_other_legs(const Character& character, double thigh, double shank) {
  const double ours = character.joint_offset[kLeftKnee].norm() / character.joint_offset[kLeftAnkle].norm();
  return std::abs(log(ours * shank / thigh)) > kOtherRatio;
}

void keep_contacts(const Character& character, const PerFrame<Landmarks>& frames, double leg_ratio,
                   motion::Clip& clip) {
  PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const std::vector<double> shifts =
      eased(knee_shifts(frames, poses, clip.fps, floor_under(frames), leg_ratio), clip.fps);
  double most = 0.0;
  for (int t = 0; t < poses.count(); ++t) {
    BodyPoses& pose = poses[t];
    const Vector3d hips = 0.5 * (pose.p_WB[kLeftHip] + pose.p_WB[kRightHip]),
                   their_hips = frames[t].between(kLeftHip, kRightHip);
    const double shift = shifts[static_cast<std::size_t>(t)];
    most = std::max(most, std::abs(shift));
    clip.trans[t].z() += shift;
    for (Vector3d& p : pose.p_WB) p.z() += shift;
    for (const LegJoints& leg : kSides) {
      reach_for(character, leg, hips + leg_ratio * (frames[t].p[leg.ankle] - their_hips), pose);
      for (const int b : {leg.hip, leg.knee, leg.ankle})
        clip.rotations[t][b] = log_map(pose.q_WB[kParents[b]].conjugate() * pose.q_WB[b]);
    }
  }
  clip.decisions.emplace_back(
      std::string(
          "legs are bent so that ankles keep their places, whatever the proportions of thigh and shank") +
      (most > 0.005 ? ", and the pelvis is moved so that kneeling knees stay on the floor" : ""));
}

}  // namespace mimicx::import
