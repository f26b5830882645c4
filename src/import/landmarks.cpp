#include "import/landmarks.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/quantile.h"

namespace mimicx::import {
namespace {

constexpr std::array<std::array<int, 3>, 2> kLegs = {
    {{kLeftHip, kLeftKnee, kLeftAnkle}, {kRightHip, kRightKnee, kRightAnkle}}};
constexpr std::array<std::array<int, 3>, 2> kArms = {
    {{kLeftShoulder, kLeftElbow, kLeftWrist}, {kRightShoulder, kRightElbow, kRightWrist}}};

/// Hips and knees within 37° of straight.
bool has_straight_legs(const Landmarks& pose) {
  constexpr double kStraight = 0.8;
  return std::all_of(kLegs.begin(), kLegs.end(), [&](const auto& leg) {
    const Vector3d thigh = pose.direction(leg[0], leg[1]);
    return -thigh.dot(pose.trunk()) > kStraight && thigh.dot(pose.direction(leg[1], leg[2])) > kStraight;
  });
}

/// Mean angle by which the bodies turn relative to their parents between two poses, rad.
double step_between(const Landmarks& a, const Landmarks& b) {
  double sum = 0.0;
  for (int j = 1; j < kBodies; ++j) {
    const int parent = kParents[j];
    sum += angle_between(Quaterniond(a.q[parent].conjugate() * a.q[j]),
                         Quaterniond(b.q[parent].conjugate() * b.q[j]));
  }
  return sum / kJoints;
}

}  // namespace

Vector3d Landmarks::trunk() const {
  return (between(kLeftShoulder, kRightShoulder) - between(kLeftHip, kRightHip)).normalized();
}

Vector3d Landmarks::forward() const { return direction(kRightHip, kLeftHip).cross(trunk()).normalized(); }

Landmarks landmarks_of(const SkeletonPose& pose, const JointMap& map) {
  Landmarks out;
  for (int b = 0; b < kBodies; ++b) {
    const int parent = std::max(kParents[b], 0), joint = map[b];
    out.p[b] = joint < 0 ? out.p[parent] : pose.p[joint];
    out.q[b] = joint < 0 ? out.q[parent] : pose.q[joint];
  }
  return out;
}

PerFrame<Landmarks> landmarks_of(const SkeletonMotion& motion, const JointMap& map) {
  PerFrame<Landmarks> out;
  for (int t = 0; t < motion.frames(); ++t) out.push_back(landmarks_of(pose_of(motion, t), map));
  return out;
}

PerFrame<Landmarks> landmarks_of(const PerFrame<BodyPoses>& poses) {
  PerFrame<Landmarks> out;
  for (const BodyPoses& pose : poses) out.push_back({pose.p_WB, pose.q_WB});
  return out;
}

Landmarks transformed(const Landmarks& landmarks, const Quaterniond& turn, double scale) {
  Landmarks out;
  for (int b = 0; b < kBodies; ++b) {
    out.p[b] = scale * (turn * landmarks.p[b]);
    out.q[b] = turn * landmarks.q[b];
  }
  return out;
}

double leg_length(const PerFrame<Landmarks>& poses) {
  double sum = 0.0;
  for (const Landmarks& pose : poses)
    for (const auto& [hip, knee, ankle] : kLegs)
      sum += 0.5 * ((pose.p[knee] - pose.p[hip]).norm() + (pose.p[ankle] - pose.p[knee]).norm());
  return sum / static_cast<double>(poses.size());
}

double bend_of(const Landmarks& pose) {
  double bend = 0.0;
  for (const auto& [hip, knee, ankle] : kLegs) {
    const Vector3d thigh = pose.direction(hip, knee);
    bend += 2.0 + thigh.dot(pose.trunk()) - thigh.dot(pose.direction(knee, ankle));
  }
  for (const auto& [shoulder, elbow, wrist] : kArms) {
    const Vector3d arm = pose.direction(shoulder, elbow);
    bend += 0.5 * (1.0 - arm.dot(pose.direction(elbow, wrist))) + pow(arm.dot(pose.forward()), 2);
  }
  return bend;
}

bool is_stance(const Landmarks& pose) {
  return has_straight_legs(pose) && std::all_of(kArms.begin(), kArms.end(), [&](const auto& arm) {
           const Vector3d upper = pose.direction(arm[0], arm[1]);
           return upper.dot(pose.direction(arm[1], arm[2])) > 0.7 &&
                  std::abs(upper.dot(pose.forward())) < 0.6;
         });
}

bool is_t_pose(const Landmarks& pose) {
  const Vector3d left = pose.direction(kRightHip, kLeftHip);
  return is_stance(pose) && pose.direction(kLeftShoulder, kLeftElbow).dot(left) > 0.85 &&
         pose.direction(kRightShoulder, kRightElbow).dot(left) < -0.85;
}

bool starts_with_t_pose(const PerFrame<Landmarks>& frames) {
  if (frames.size() < 3 || !is_t_pose(frames[0])) return false;
  std::vector<double> steps;
  for (int t = 1; t < frames.count(); ++t) steps.push_back(step_between(frames[t - 1], frames[t]));
  const double first = steps[0];
  constexpr double kJump = 0.05;  // rad in the mean over the bodies: three degrees
  return first > kJump && first > 5.0 * median(steps);
}

}  // namespace mimicx::import
