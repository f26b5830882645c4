#include "synth/inverse_kinematics.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace mimicx::synth {
namespace {

constexpr double kToesFollow =
    0.7;  ///< share of the foot's pitch that the toes take; they extend by the rest

/// Position of a point of the sole in the ankle's frame, toes straight. @param index  0..5: heel, ball, toe
Vector3d foot_point(const Character& c, int side, int index) {
  const ContactPoint& point = c.contact_points[6 * side + index];
  const bool on_toes = point.body == kLeftFoot || point.body == kRightFoot;
  return on_toes ? Vector3d(c.joint_offset[point.body] + sole_point(point)) : sole_point(point);
}

/// Rotation about the line from a point of the sole to its neighbour, lateral axis to the left.
struct Roll {
  Vector3d pivot, axis;
};
Roll roll_over(const Character& c, int side, int first_point) {
  const Vector3d a = foot_point(c, side, first_point), b = foot_point(c, side, first_point + 1);
  const Vector3d axis = (b - a).normalized();
  return {a, axis.x() < 0.0 ? Vector3d(-axis) : axis};
}

/// Columns: e1 = first, e2 = the part of second across it, e3 = their product.
Matrix3d frame_of(const Vector3d& first, const Vector3d& second) {
  Matrix3d R;
  R.col(0) = first.normalized();
  R.col(1) = (second - second.dot(R.col(0)) * R.col(0)).normalized();
  R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

}  // namespace

FootPose foot_pose(const Character& c, int side, const FootTarget& target) {
  const Vector3d ball = c.joint_offset[side == 0 ? kLeftFoot : kRightFoot];
  const Roll over_toes = roll_over(c, side, 4), over_heel = roll_over(c, side, 0);
  // In the frame of the flat foot (origin: its ankle): toes roll first, the foot follows at their joint.
  const Quaterniond toes = exp_map(kToesFollow * target.heel_rise * over_toes.axis);
  const Quaterniond foot = exp_map(target.heel_rise * over_toes.axis);
  const Vector3d ball_rolled = over_toes.pivot + toes * (ball - over_toes.pivot);
  const Vector3d ankle = ball_rolled - foot * ball;
  const Quaterniond heel = exp_map(-target.toe_rise * over_heel.axis);
  const Quaterniond flat = rotation_z(target.yaw) * kModelToPlan;
  const double ankle_height = -foot_point(c, side, 0).y();
  FootPose pose;
  pose.p_ankle = Vector3d(target.place.x(), target.place.y(), target.lift + ankle_height) +
                 flat * (over_heel.pivot + heel * (ankle - over_heel.pivot));
  pose.q_ankle = flat * heel * foot;
  pose.q_toes = foot.conjugate() * toes;
  return pose;
}

LegPose solve_leg(const Character& c, int side, const Vector3d& p_pelvis, const Quaterniond& q_pelvis,
                  const FootPose& foot, const Vector3d& knee_axis) {
  const int hip = side == 0 ? kLeftHip : kRightHip, knee = side == 0 ? kLeftKnee : kRightKnee;
  const Vector3d thigh = c.joint_offset[knee], shank = c.joint_offset[side == 0 ? kLeftAnkle : kRightAnkle];
  const Vector3d to_ankle = foot.p_ankle - (p_pelvis + q_pelvis * c.joint_offset[hip]);
  // |thigh + Rx(k)·shank|² = constant + A cos k + B sin k; the flexing solution is the larger k.
  const double constant = thigh.squaredNorm() + shank.squaredNorm() + 2.0 * thigh.x() * shank.x();
  const double A = 2.0 * (thigh.y() * shank.y() + thigh.z() * shank.z());
  const double B = 2.0 * (thigh.z() * shank.y() - thigh.y() * shank.z());
  const double straightest = atan2(B, A), amplitude = hypot(A, B);
  const double cosine = (to_ankle.squaredNorm() - constant) / amplitude;
  LegPose pose;
  pose.knee = straightest + acos(std::clamp(cosine, -1.0, 1.0));
  const Quaterniond bend = exp_map(pose.knee * Vector3d::UnitX());
  const Vector3d reach = thigh + bend * shank;  // hip → ankle in the thigh's frame
  pose.shortfall = std::abs(to_ankle.norm() - reach.norm());
  const Quaterniond q_thigh(frame_of(to_ankle, knee_axis) * frame_of(reach, Vector3d::UnitX()).transpose());
  pose.hip = q_pelvis.conjugate() * q_thigh;
  pose.ankle = (q_thigh * bend).conjugate() * foot.q_ankle;
  return pose;
}

}  // namespace mimicx::synth
