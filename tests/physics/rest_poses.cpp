#include "physics/rest_poses.h"

#include <algorithm>
#include <numbers>

namespace mimicx::physics {
namespace {

constexpr double kRight = std::numbers::pi / 2;
constexpr double kSettleSeconds = 3.0, kSettleLying = 8.0;

Quaterniond about_x(double angle) { return exp_map(Vector3d(angle, 0, 0)); }
Quaterniond about_y(double angle) { return exp_map(Vector3d(0, angle, 0)); }
Quaterniond about_z(double angle) { return exp_map(Vector3d(0, 0, angle)); }

/// Flexion of hips and knees, plantar flexion of the ankles, extension of the balls of the feet.
void bend_legs(double hip, double knee, double ankle, double ball, Snapshot& s) {
  for (int side : {0, 1}) {
    const auto body = [&](int left) { return left + side; };
    s.q[body(kLeftHip)] = about_x(-hip);
    s.q[body(kLeftKnee)] = about_x(knee);
    s.q[body(kLeftAnkle)] = about_x(ankle);
    s.q[body(kLeftFoot)] = about_x(-ball);
  }
}

/// Of the points of the ankle's body the two behind the ankle; the others are ball and instep.
bool is_heel(const ContactPoint& p) {
  return (p.body == kLeftAnkle || p.body == kRightAnkle) && p.p_B.z() < 0.0;
}

/// On the balls and toes of both feet, heels up by 34°, toes level, the centre of mass between the two.
void stand_on_toe_balls(const Character& c, Snapshot& s) {
  const double heel_up = 0.6;
  bend_legs(0.0, 0.0, heel_up, heel_up, s);
  const Quaterniond level = about_x(kRight);
  for (int iteration = 0; iteration < 30; ++iteration) {
    const BodyPoses poses = forward_kinematics(c, s.p_root, s.q);
    Vector3d offset = Vector3d::Zero();
    for (int i = 0; i < kBodies; ++i)
      offset += c.mass[i] / c.total_mass() * (poses.p_WB[i] + poses.q_WB[i] * c.com_B[i]);
    for (int k = 0; k < kFootPoints; ++k) {
      const ContactPoint& p = c.contact_points[k];
      const int i = p.body;
      if (!is_heel(p)) offset -= (poses.p_WB[i] + poses.q_WB[i] * p.p_B) / 8.0;
    }
    s.q[0] = about_x(offset.y() / offset.z()) * s.q[0];
    for (const int foot : {kLeftFoot, kRightFoot}) {
      const auto ankle = kParents[foot];
      s.q[foot] = poses.q_WB[ankle].conjugate() * level;
    }
  }
}

/// Face down, arms straight towards the floor, hands bent back to lie on it.
void go_on_all_fours(Snapshot& s) {
  s.q[0] = about_x(2 * kRight);
  bend_legs(kRight, kRight + 0.2, 1.1, 0.0, s);
  s.q[kLeftShoulder] = about_y(-kRight);
  s.q[kRightShoulder] = about_y(kRight);
  s.q[kLeftElbow] = s.q[kRightElbow] = Quaterniond::Identity();
  s.q[kLeftWrist] = about_z(kRight);
  s.q[kRightWrist] = about_z(-kRight);
}

}  // namespace

Snapshot rest_pose(RestPose pose, const Character& c) {
  Snapshot s = standing(c);
  switch (pose) {
    case RestPose::kBothSoles:
      balance(c, {kLeftFoot, kRightFoot}, s);
      break;
    case RestPose::kOneSole:
      s.q[kRightHip] = about_x(-0.9);
      s.q[kRightKnee] = about_x(1.2);
      balance(c, {kLeftFoot}, s);
      break;
    case RestPose::kToeBalls:
      stand_on_toe_balls(c, s);
      break;
    case RestPose::kKneeling:  // thighs leaning back by 20°, trunk upright, feet stretched out behind
      bend_legs(0.35, kRight + 0.35, 1.25, 0.0, s);
      break;
    case RestPose::kAllFours:
      go_on_all_fours(s);
      break;
    case RestPose::kSupine:
      s.q[0] = Quaterniond::Identity();
      bend_legs(0.0, 0.0, 0.4, 0.0, s);
      break;
    case RestPose::kProne:
      s.q[0] = about_x(2 * kRight);
      bend_legs(0.0, 0.0, 1.25, 0.0, s);
      break;
  }
  s.p_root.z() -= lowest_point(c, s);
  s.target_q = s.q;
  return s;
}

RestReport rest(RestPose pose, double rate, int passes) {
  const bool lying = pose == RestPose::kSupine || pose == RestPose::kProne;
  const Character c = lying ? make_character() : stiffened(make_character());
  SimulationConfig o;
  o.rate = rate;
  o.passes = passes;
  Simulation<double> s(c, o, rest_pose(pose, c));
  for (int k = 0; k < static_cast<int>((lying ? kSettleLying : kSettleSeconds) * rate); ++k) s.advance();
  const double weight = c.total_mass() * o.gravity;
  const int steps = static_cast<int>(rate);
  RestReport report;
  std::array<double, kMaxContacts> least, most{};
  least.fill(1e9);
  double depth_sum = 0, loaded = 0;
  for (int k = 0; k < steps; ++k) {
    s.advance();
    Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
    std::array<double, kMaxContacts> point_force{};
    for (int n = 0; n < s.data.ground_count; ++n) {
      const GroundContact<double>& contact = s.data.ground[n];
      const ContactPoint& point = s.model.contacts[contact.index];
      const int body = point.body;
      const Vector3d f = lane_of(contact.applied, 0);
      const Vector3d at = lane_of(s.data.p_WB[body], 0) + lane_of(contact.arm, 0);
      force += f;
      point_force[contact.index] = f.z();
      moment += f.z() * at;
      report.share[body] += f.z() / weight / steps;
      if (is_heel(point)) report.heel_share += f.z() / weight / steps;
      report.deepest = std::max(report.deepest, contact.surface.depth - o.skin);
      if (f.z() <= 0.0) continue;
      depth_sum += contact.surface.depth - o.skin;
      loaded += 1;
      report.creep = std::max(report.creep, lane_of(contact.velocity, 0).head<2>().norm());
    }
    for (int n = 0; n < s.model.contacts.count(); ++n) {
      least[n] = std::min(least[n], point_force[n]);
      most[n] = std::max(most[n], point_force[n]);
    }
    Vector3d mass_centre = Vector3d::Zero();
    for (int i = 0; i < kBodies; ++i)
      mass_centre +=
          c.mass[i] / c.total_mass() * (lane_of(s.data.p_WB[i], 0) + lane_of(s.data.q_WB[i], 0) * c.com_B[i]);
    report.force_error = std::max(report.force_error, (force - Vector3d(0, 0, weight)).norm() / weight);
    report.centre_error = std::max(report.centre_error, (moment / force.z() - mass_centre).head<2>().norm());
  }
  for (int n = 0; n < s.model.contacts.count(); ++n)
    report.jitter = std::max(report.jitter, (most[n] - least[n]) / weight);
  report.mean_depth = depth_sum / loaded;
  return report;
}

}  // namespace mimicx::physics
