// Distances of joints from their ranges. The simulator's own are compared in
// tests/physics/joint_torques_test.cpp.
#include "character/joint_range.h"

#include <gtest/gtest.h>

#include <cmath>

#include "character/character.h"
#include "core/random.h"

namespace mimicx {
namespace {

TEST(JointRange, SlopeMatchesDifferences) {
  const Character character = make_character();
  Random random(3, {});
  for (int trial = 0; trial < 200; ++trial)
    for (int body = 1; body < kBodies; ++body) {
      const auto vector = [&] { return Vector3d(random.normal(), random.normal(), random.normal()); };
      const Vector3d turn = is_hinge(body) ? Vector3d(random.normal() * hinge_axis(body)) : vector();
      const Quaterniond q = exp_map(turn);
      const RangeDistance range = range_distance(character.joint[body], body, q);
      for (int k = 0; k < 3; ++k) {
        const Vector3d axis = is_hinge(body) ? hinge_axis(body) : Vector3d(Vector3d::Unit(k));
        const auto moved = [&](double by) {
          return range_distance(character.joint[body], body, q * exp_map(by * axis)).excess;
        };
        EXPECT_NEAR(range.slope.dot(axis), (moved(1e-6) - moved(-1e-6)) / 2e-6, 1e-6) << body;
      }
    }
}

// The knee's range is -7 to 157 degrees; a turn about its axis leaves it by the chord of the turn.
TEST(JointRange, OfAHingeIsAnIntervalOfAngles) {
  const Character character = make_character();
  const JointParameters& knee = character.joint[kLeftKnee];
  const double middle = knee.centre.x(), half = knee.half_range.x();
  const auto excess = [&](double angle) {
    return range_distance(knee, kLeftKnee, exp_map(angle * hinge_axis(kLeftKnee))).excess;
  };
  EXPECT_NEAR(excess(middle + half), 0.0, 1e-12);
  EXPECT_NEAR(excess(middle - half), 0.0, 1e-12);
  EXPECT_LT(excess(middle + half - 0.01), 0.0);
  EXPECT_NEAR(excess(middle + half + 0.1), 2.0 * (std::sin(0.5 * (half + 0.1)) - std::sin(0.5 * half)),
              1e-12);
}

TEST(JointRange, CentreIsInside) {
  const Character character = make_character();
  for (int body = 1; body < kBodies; ++body) {
    const JointParameters& joint = character.joint[body];
    const Vector3d centre = is_hinge(body) ? Vector3d(joint.centre.x() * hinge_axis(body)) : joint.centre;
    EXPECT_LT(range_distance(joint, body, exp_map(centre)).excess, 0.0) << body;
  }
}

}  // namespace
}  // namespace mimicx
