// The floor under a standing and a lying character.
#include <gtest/gtest.h>

#include <cstdio>

#include "physics/rest_poses.h"
#include "physics/standing_state.h"

namespace mimicx::physics {
namespace {

std::vector<Vector3d> contact_positions(const Character& c, const Simulation<double>& s) {
  Snapshot now;
  read_lane(s.state, 0, now);
  const BodyPoses poses = forward_kinematics(c, now.p_root, now.q);
  std::vector<Vector3d> points;
  for (const ContactPoint& p : c.contact_points) points.push_back(lowest_position(p, poses));
  return points;
}

/// Motion of the sole points of the standing feet between the second and the fourth second, m and m/s.
struct SoleMotion {
  double lowest = 1, highest = -1, creep = 0;
};

SoleMotion stand(const Character& c, const Snapshot& pose, double rate, int sole_points) {
  SimulationConfig config;
  config.rate = rate;
  Simulation<double> s(c, config, pose);
  const int settle = static_cast<int>(2 * rate);
  for (int k = 0; k < settle; ++k) s.advance();
  SoleMotion motion;
  std::vector<Vector3d> last = contact_positions(c, s);
  for (int k = 0; k < settle; ++k) {
    s.advance();
    const std::vector<Vector3d> now = contact_positions(c, s);
    for (int i = 0; i < sole_points; ++i) {  // contact points begin with the left foot's six
      motion.lowest = std::min(motion.lowest, now[i].z());
      motion.highest = std::max(motion.highest, now[i].z());
      motion.creep = std::max(motion.creep, (now[i] - last[i]).head<2>().norm() * rate);
    }
    last = now;
  }
  std::printf("  measured: %d points at %.0f Hz: soles %.2f .. %.2f mm, fastest creep %.3f mm/s\n",
              sole_points, rate, kMm * motion.lowest, kMm * motion.highest, kMm * motion.creep);
  return motion;
}

TEST(Standing, StateIsAPoseAsConstructed) {
  const Character c = make_character();
  Simulation<double> s(c, {});
  s.state = State<double>();
  s.target = Target<double>();
  s.state.p_root.z = 2.0;
  for (int i = 0; i < kBodies; ++i) EXPECT_EQ(s.state.q[i].w, 1.0) << i;
  EXPECT_FALSE(s.advance());
  EXPECT_NEAR(s.state.v_root.z, -kGravity / 240.0,
              1e-3);  // it falls; a pelvis of no rotation would stay finite, too
  EXPECT_NEAR(lane_of(s.state.q[kLeftKnee], 0).norm(), 1.0, 1e-12);
}

TEST(Standing, StandingStateHasItsSolesOnTheFloorAndATargetThatHoldsIt) {
  const Character c = stiffened(make_character({1.0}));
  Simulation<double> s(c, {});
  s.state = standing_state(c);
  s.target = target_at(s.state);
  double lowest = 1.0;
  for (const Vector3d& point : contact_positions(c, s)) lowest = std::min(lowest, point.z());
  EXPECT_NEAR(lowest, 0.0, 1e-12);
  const double height = s.state.p_root.z;
  for (int k = 0; k < 60; ++k) EXPECT_FALSE(s.advance());
  EXPECT_NEAR(s.state.p_root.z, height, 0.02);
}

TEST(Standing, SolesStayWithinAMillimetreOfTheFloorAndDoNotCreep) {
  const Character c = stiffened(make_character());
  Snapshot pose = standing(c);
  balance(c, {kLeftFoot, kRightFoot}, pose);
  for (double rate : {120.0, 240.0, 480.0}) {
    const SoleMotion m = stand(c, pose, rate, 12);
    EXPECT_GT(m.lowest, -1e-3) << rate << " Hz";
    EXPECT_LT(m.highest, 1e-3) << rate << " Hz";
    EXPECT_LT(m.creep, 0.5e-3) << rate << " Hz";
  }
}

TEST(Standing, SingleSoleStaysWithinAMillimetreOfTheFloor) {
  const Character c = stiffened(make_character());
  Snapshot pose = standing(c);
  pose.q[kRightHip] = exp_map(Vector3d(-0.9, 0, 0));
  pose.q[kRightKnee] = exp_map(1.2 * hinge_axis(kRightKnee));
  balance(c, {kLeftFoot}, pose);
  for (double rate : {120.0, 240.0, 480.0}) {
    const SoleMotion m = stand(c, pose, rate, 6);
    EXPECT_GT(m.lowest, -1e-3) << rate << " Hz";
    EXPECT_LT(m.highest, 1e-3) << rate << " Hz";
    EXPECT_LT(m.creep, 0.5e-3) << rate << " Hz";
  }
}

TEST(Lying, FloorCarriesTheWeightWithLittleSinking) {
  const Character c = make_character();
  Snapshot pose = standing(c);
  pose.q[0] = exp_map(Vector3d(0, 0, 0));  // face up: z of the body is forward
  pose.p_root.z() += 0.02 - lowest_point(c, pose);
  SimulationConfig config;
  Simulation<double> s(c, config, pose);
  for (int k = 0; k < 960; ++k) s.advance();
  double force = 0, points = 0;
  for (int i = 0; i < kBodies; ++i) {
    force += s.applied.ground[i].f.z;
    EXPECT_LT(lane_of(s.data.v[i], 0).norm(), 0.01) << kBodyNames[i];
  }
  for (int n = 0; n < s.data.ground_count; ++n) points += s.data.ground[n].applied.z;
  EXPECT_NEAR(force, c.total_mass() * config.gravity, 2.0);
  EXPECT_NEAR(points, force, 1e-9 * force);
  double lowest = 1;
  for (const Vector3d& p : contact_positions(c, s)) lowest = std::min(lowest, p.z());
  std::printf("  measured: lowest point of the lying body %.2f mm\n", kMm * lowest);
  EXPECT_GT(lowest, -2.5e-3);
}

/// The bodies that carry a pose, each at least 2 % of the weight, together all of it.
std::vector<int> carriers(RestPose pose) {
  switch (pose) {
    case RestPose::kBothSoles:
    case RestPose::kToeBalls:
      return {kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot};
    case RestPose::kOneSole:
      return {kLeftAnkle, kLeftFoot};
    case RestPose::kKneeling:
      return {kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle};
    case RestPose::kAllFours:
      return {kLeftKnee, kRightKnee, kLeftWrist, kRightWrist};
    case RestPose::kSupine:
      return {kPelvis, kSpine3, kLeftAnkle, kRightAnkle};
    case RestPose::kProne:
      return {kSpine1, kLeftHip, kRightHip, kLeftKnee, kRightKnee, kHead};
  }
  return {};
}

TEST(Rest, TheRightBodiesCarryEveryPoseUnderItsCentreOfMass) {
  for (RestPose pose : kRestPoses)
    for (double rate : {240.0, 480.0})
      for (int passes : {2, 3}) {
        SCOPED_TRACE(testing::Message() << kRestPoseNames[static_cast<int>(pose)] << ", " << rate << " Hz, "
                                        << passes << " passes");
        const RestReport r = rest(pose, rate, passes);
        double sum = 0;
        for (int body : carriers(pose)) {
          const double share = r.share[body];
          EXPECT_GT(share, body == kHead ? 0.005 : 0.02) << kBodyNames[body];
          sum += share;
        }
        EXPECT_NEAR(sum, 1.0, 2e-3);
        EXPECT_LT(r.force_error, 5e-3);
        EXPECT_LT(r.centre_error, 5e-3);  // on the toes the stiff figure still sways by 2 mm
        std::printf("  measured: %-10s centre of pressure to centre of mass %.2f mm\n",
                    kRestPoseNames[static_cast<int>(pose)], kMm * r.centre_error);
      }
}

TEST(Rest, NoPoseSinksCreepsOrJitters) {
  for (RestPose pose : kRestPoses)
    for (double rate : {240.0, 480.0})
      for (int passes : {1, 2, 3}) {
        SCOPED_TRACE(testing::Message() << kRestPoseNames[static_cast<int>(pose)] << ", " << rate << " Hz, "
                                        << passes << " passes");
        const RestReport r = rest(pose, rate, passes);
        EXPECT_LT(r.deepest, 1e-3);
        EXPECT_LT(r.mean_depth, 0.0) << "the skin keeps loaded points above z = 0";
        EXPECT_LT(r.creep, 1e-3);
        EXPECT_LT(r.jitter, 0.03);
      }
}

TEST(Rest, HeelsCarryNothingOnTheToeBalls) {
  EXPECT_EQ(rest(RestPose::kToeBalls, 240, 2).heel_share, 0.0);
  EXPECT_GT(rest(RestPose::kBothSoles, 240, 2).heel_share, 0.1);
}

}  // namespace
}  // namespace mimicx::physics
