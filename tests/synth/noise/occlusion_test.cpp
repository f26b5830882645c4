#include "synth/noise/occlusion.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "motion/segment_distance.h"
#include "synth/noise/noise_fixtures.h"

namespace mimicx::synth {
namespace {

/// Length inside a capsule by walking along the ray: a step counts where its middle is within the radius.
double walked_length(const Vector3d& eye, const Vector3d& point, const Vector3d& a, const Vector3d& b,
                     double radius, int steps) {
  int inside = 0;
  for (int i = 0; i < steps; ++i) {
    const Vector3d at = eye + (i + 0.5) / steps * (point - eye);
    if (motion::segment_distance(at, at, a, b) < radius) ++inside;
  }
  return (point - eye).norm() * inside / steps;
}

TEST(Occlusion, LengthInsideACapsuleMatchesRayMarching) {
  Random random(3);
  const auto drawn = [&](double size) {
    const double x = random.uniform(-size, size), y = random.uniform(-size, size),
                 z = random.uniform(-size, size);
    return Vector3d(x, y, z);
  };
  int met = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Vector3d eye = drawn(2.0), point = drawn(1.0), a = drawn(0.5);
    const Vector3d b = trial % 10 == 0 ? a : Vector3d(a + drawn(0.5));  // a sphere now and then
    const double radius = random.uniform(0.05, 0.4);
    const double walked = walked_length(eye, point, a, b, radius, 4000);
    if (walked > 0.0) ++met;
    EXPECT_NEAR(length_inside(eye, point, a, b, radius), walked, 2.0 * (point - eye).norm() / 4000.0);
  }
  EXPECT_GT(met, 30);
  // Along the axis, from outside through both caps; and with both ends inside.
  EXPECT_NEAR(length_inside({0, 0, -3}, {0, 0, 3}, {0, 0, 0}, {0, 0, 1}, 0.2), 1.4, 1e-12);
  EXPECT_NEAR(length_inside({0, 0, 0.1}, {0.1, 0, 0.9}, {0, 0, 0}, {0, 0, 1}, 0.2), std::hypot(0.1, 0.8),
              1e-12);
  EXPECT_EQ(length_inside({0.3, 0, -3}, {0.3, 0, 3}, {0, 0, 0}, {0, 0, 1}, 0.2), 0.0);
}

TEST(Occlusion, HidesPointsBehindMoreThanOneAndAHalfRadii) {
  const Character character = make_character();
  int hidden = 0, seen = 0;
  for (const char* kind : {"walk", "squat", "dance"}) {
    const PerFrame<BodyPoses> poses = test::poses_of_clip(test::truth_of(kind));
    for (int i = 0; i < 6; ++i) {
      const BodyPoses& pose = poses[7 * i];
      const Vector3d eye = pose.p_WB[kPelvis] + Vector3d(3.0 * std::cos(i), 3.0 * std::sin(i), 0.4);
      for (const Vector3d& joint : pose.p_WB) {
        bool expected = false, close_call = false;
        for (const Capsule& c : character.capsule) {
          const Vector3d a = pose.p_WB[c.body] + pose.q_WB[c.body] * c.a_B,
                         b = pose.p_WB[c.body] + pose.q_WB[c.body] * c.b_B;
          const double radii = walked_length(eye, joint, a, b, c.radius, 3000) / c.radius;
          expected = expected || radii > kHidingDepth;
          close_call = close_call || std::abs(radii - kHidingDepth) < 0.1;
        }
        if (close_call) continue;
        EXPECT_EQ(is_hidden(character, pose, eye, joint), expected);
        ++(expected ? hidden : seen);
      }
    }
  }
  EXPECT_GT(hidden, 30);
  EXPECT_GT(seen, 150);
}

TEST(Occlusion, HidesOnlyTheFarHipInASideView) {
  const Character character = make_character();
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  q[kPelvis] = rotation_between(Vector3d::UnitY(), Vector3d::UnitZ());
  const BodyPoses pose = forward_kinematics(character, {0.0, 0.0, 0.95}, q);
  const Vector3d left = (pose.p_WB[kLeftHip] - pose.p_WB[kRightHip]).normalized();
  const Vector3d eye = pose.p_WB[kPelvis] + 5.0 * left;
  EXPECT_TRUE(is_hidden(character, pose, eye, pose.p_WB[kRightHip]));
  EXPECT_FALSE(is_hidden(character, pose, eye, pose.p_WB[kLeftHip]));
  EXPECT_TRUE(is_hidden(character, pose, eye, pose.p_WB[kRightKnee]));
  EXPECT_FALSE(is_hidden(character, pose, eye, pose.p_WB[kLeftKnee]));
}

}  // namespace
}  // namespace mimicx::synth
