#include "rl/tracking/state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rl/tracking/tracking_fixture.h"

namespace mimicx::rl::tracking {
namespace {

std::array<float, kStateSize> state_of(const Pose& reference, const Pose& simulated, double beta0 = 0.0) {
  std::array<float, kStateSize> state{};
  tracking_state(reference, joint_features(reference.frame), {beta0}, simulated, state.data());
  return state;
}

// Everything on a step, ground included: the same state as on the floor.
TEST(TrackingState, CountsHeightsFromTheGroundUnderTheReference) {
  const Character character = make_character();
  Random random(4);
  const Pose reference = pose_of(character, random_frame(random, 0.5)),
             simulated = pose_of(character, random_frame(random, 0.5));
  const auto raised = [](Pose pose) {
    pose.frame.p_root.z() += 0.25;
    for (Vector3d& p : pose.p_WB) p.z() += 0.25;
    return pose;
  };
  Pose high = raised(reference);
  high.ground = 0.25;
  const auto low_state = state_of(reference, simulated), high_state = state_of(high, raised(simulated));
  for (int k = 0; k < kStateSize; ++k) EXPECT_NEAR(low_state[k], high_state[k], 1e-6f) << k;
  std::array<float, kPoseFeatures> low_own{}, high_own{};
  own_pose_features(reference, low_own.data());
  own_pose_features(high, high_own.data());
  for (int k = 0; k < kPoseFeatures; ++k) EXPECT_NEAR(low_own[k], high_own[k], 1e-6f) << k;
}

TEST(TrackingState, HasExactly570NumbersAndWritesThemAll) {
  const Character character = make_character();
  Random random(3);
  const Pose a = pose_of(character, random_frame(random, 0.5)),
             b = pose_of(character, random_frame(random, 0.5));
  Array<float, kStateSize + 1> state;
  state.fill(std::numeric_limits<float>::quiet_NaN());
  tracking_state(a, joint_features(a.frame), {}, b, state.data());
  for (int k = 0; k < 570; ++k) EXPECT_TRUE(std::isfinite(state[k])) << k;
  EXPECT_TRUE(std::isnan(state[570])) << "wrote past its end";
}

/// P by another way: the body itself is moved so that the heading is x and the origin is under the simulated
/// pelvis, and its numbers are read off. @param offset  of the simulated root on the floor
std::vector<double> features_of(const Character& character, const Pose& pose, double heading,
                                const Eigen::Vector2d& offset) {
  const Eigen::Vector2d back = -(Eigen::Rotation2Dd(-heading) * offset);
  const Pose m = moved(character, pose, -heading, back);
  std::vector<double> p = {m.frame.p_root.z()};
  const auto put = [&p](const Vector3d& v) { p.insert(p.end(), v.data(), v.data() + 3); };
  const Matrix3d R = m.frame.q[0].toRotationMatrix();
  put(R.col(0)), put(R.col(1)), put(m.frame.v_root), put(R * m.frame.omega[0]);
  for (int body = 1; body < kBodies; ++body) {
    const Matrix3d r = m.frame.q[body].toRotationMatrix();
    if (is_hinge(body)) {
      const Vector3d sine(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
      p.push_back(std::atan2(0.5 * sine.dot(hinge_axis(body)), 0.5 * (r.trace() - 1.0)));
    } else {
      put(r.col(0)), put(r.col(1));
    }
  }
  for (int body = 1; body < kBodies; ++body)
    is_hinge(body) ? p.push_back(m.frame.omega[body].dot(hinge_axis(body))) : put(m.frame.omega[body]);
  for (const int body : {kLeftWrist, kRightWrist, kLeftFoot, kRightFoot}) put(m.p_WB[body] - m.frame.p_root);
  p.push_back(m.frame.p_root.x()), p.push_back(m.frame.p_root.y());
  return p;
}

TEST(TrackingState, AgreesWithAnIndependentAssembly) {
  const Character character = make_character();
  Random random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose reference = pose_of(character, random_frame(random, 0.5)),
               simulated = pose_of(character, random_frame(random, 0.5));
    const Vector3d forward = simulated.frame.q[0].toRotationMatrix().col(2);
    const double heading = std::atan2(forward.y(), forward.x());
    const Eigen::Vector2d at = simulated.frame.p_root.head<2>();
    const std::vector<double> wanted = features_of(character, reference, heading, at),
                              is = features_of(character, simulated, heading, at);
    std::vector<double> expected(wanted.begin(), wanted.begin() + 186);
    for (int k = 0; k < 10; ++k) expected.push_back(k == 0 ? 0.7 : 0.0);
    expected.insert(expected.end(), is.begin(), is.begin() + 186);
    for (std::size_t k = 0; k < 186; ++k) expected.push_back(wanted[k] - is[k]);
    expected.insert(expected.end(), wanted.begin() + 186, wanted.end());
    const auto state = state_of(reference, simulated, 0.7);
    ASSERT_EQ(expected.size(), state.size());
    for (std::size_t k = 0; k < state.size(); ++k) EXPECT_NEAR(state[k], expected[k], 2e-5) << k;
  }
}

TEST(TrackingState, IsInvariantToHeadingAndPlaceOfBothPoses) {
  const Character character = make_character();
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose reference = pose_of(character, random_frame(random, 0.4));
    const Pose simulated = pose_of(character, random_frame(random, 0.4));
    const double angle = random.uniform(-3.0, 3.0);
    const Eigen::Vector2d offset(random.normal(), random.normal());
    const auto before = state_of(reference, simulated);
    const auto after =
        state_of(moved(character, reference, angle, offset), moved(character, simulated, angle, offset));
    for (std::size_t k = 0; k < kStateSize; ++k) EXPECT_NEAR(before[k], after[k], 2e-5) << "entry " << k;
  }
}

TEST(TrackingState, ChangesWithTheHeadingOrPlaceOfOnePose) {
  const Character character = make_character();
  Random random(5);
  const Pose pose = pose_of(character, random_frame(random, 0.3));
  const auto same = state_of(pose, pose);
  for (std::size_t k = 382; k < kStateSize; ++k) EXPECT_EQ(same[k], 0.0F) << "a difference of equal poses";
  const auto shifted = state_of(moved(character, pose, 0.0, {0.3, 0.4}), pose);
  EXPECT_NEAR(std::hypot(shifted[568], shifted[569]), 0.5, 1e-6) << "root offset";
  for (std::size_t k = 382; k < 568; ++k) EXPECT_NEAR(shifted[k], 0.0F, 1e-6);
  const auto turned = state_of(moved(character, pose, 0.5, {0, 0}), pose);
  double difference = 0.0;
  for (std::size_t k = 383; k < 389; ++k) difference += std::abs(turned[k]);
  EXPECT_GT(difference, 0.1) << "root rotation";
}

TEST(TrackingState, HeadingDirectionMatchesTheHeadingAngle) {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Quaterniond q = random_frame(random, 0.7).q[0];
    const double angle = heading_angle(q);
    EXPECT_NEAR(heading_direction(q).x(), std::cos(angle), 1e-12);
    EXPECT_NEAR(heading_direction(q).y(), std::sin(angle), 1e-12);
  }
}

TEST(EncodedState, TurnedFeaturesEqualFeaturesInTheOtherHeading) {
  const Character character = make_character();
  Random random(21);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose pose = pose_of(character, random_frame(random, 0.4));
    const double a = random.uniform(-3, 3), b = random.uniform(-3, 3);
    const Eigen::Vector2d from(std::cos(a), std::sin(a)), to(std::cos(b), std::sin(b));
    std::array<float, kPoseFeatures> seen_from{}, seen_to{}, turned{};
    pose_features(pose, joint_features(pose.frame), from, 0.0, seen_from.data());
    pose_features(pose, joint_features(pose.frame), to, 0.0, seen_to.data());
    turn_features(seen_from.data(), from, to, turned.data());
    for (std::size_t k = 0; k < kPoseFeatures; ++k) EXPECT_NEAR(turned[k], seen_to[k], 2e-5) << k;
  }
}

TEST(EncodedState, EqualsTheRawStateBehindTheCodeForAPerfectDecoder) {
  const Character character = make_character();
  Random random(22);
  const Pose reference = pose_of(character, random_frame(random, 0.3)),
             simulated = pose_of(character, random_frame(random, 0.3));
  std::array<float, kStateSize> raw{};
  tracking_state(reference, joint_features(reference.frame), {0.5}, simulated, raw.data());
  std::array<float, kPoseFeatures> decoded{};
  own_pose_features(reference, decoded.data());
  const float code[] = {1.0F, 2.0F, 3.0F};
  std::array<float, kEncodedRest + 4> state{};
  state.back() = -7.0F;
  encoded_state(code, decoded, reference, {0.5}, simulated, state.data());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(state[k], code[k]);
  for (std::size_t k = 0; k < kEncodedRest; ++k) EXPECT_NEAR(state[3 + k], raw[kPoseFeatures + k], 2e-5) << k;
  EXPECT_EQ(state.back(), -7.0F) << "wrote past its end";
}

}  // namespace
}  // namespace mimicx::rl::tracking
