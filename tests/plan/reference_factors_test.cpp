#include "plan/reference_factors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/prepare/prepare.h"
#include "motion/synthetic_clip.h"

namespace mimicx::plan {
namespace {

motion::Reference walk_reference() {
  return motion::prepare_reference(test::synthetic_clip("walk", 501), {}, nullptr);
}

TEST(Certainty, OrdinaryMotionIsCertain) {
  const motion::Reference reference = walk_reference();
  const List<control::Certainty> certainty = certainty_of(reference, 150.0);
  ASSERT_EQ(certainty.count(), reference.size());
  for (const control::Certainty& frame : certainty)
    for (float c : frame) EXPECT_EQ(c, 1.0f);
  for (const control::Certainty& frame : certainty_of(reference, 0.0))
    for (float c : frame) EXPECT_EQ(c, 1.0f);
}

// A foot that is d away for one frame has accelerations of d, 2 d and d times the square of the frame rate.
TEST(Certainty, FallsWithTheFourthPowerOfALimbsAcceleration) {
  motion::Reference reference = walk_reference();
  for (motion::ReferenceFrame& frame : reference.frames) frame = reference.frames[0];
  for (BodyPoses& poses : reference.poses) poses = reference.poses[0];
  reference.poses[50].p_WB[kLeftFoot].x() += 0.25;
  const List<control::Certainty> certainty = certainty_of(reference, 150.0);
  const double once = 0.25 * 900.0 / 150.0, twice = 2.0 * once;
  const auto expect = [&](int frame, double excess) {
    for (int body : {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot})
      EXPECT_NEAR(certainty[frame][body], std::pow(excess, -4.0), 1e-6) << frame;
    for (int body : {kPelvis, kRightFoot, kLeftWrist, kHead}) EXPECT_EQ(certainty[frame][body], 1.0f);
  };
  for (int frame : {49, 50, 51}) expect(frame, twice);
  for (int frame : {48, 52}) expect(frame, once);
  EXPECT_EQ(certainty[47][kLeftFoot], 1.0f);
}

TEST(Certainty, BridgedFramesAreUncertain) {
  motion::Reference reference = walk_reference();
  reference.flagged[20] = true;
  const List<control::Certainty> certainty = certainty_of(reference, 150.0);
  for (int body = 0; body < kBodies; ++body) {
    EXPECT_EQ(certainty[20][body], kBridged);
    EXPECT_EQ(certainty[21][body], 1.0f);
  }
}

TEST(MomentumFactors, FallWithTheForceThatAFrameNeeds) {
  audit::PoseNeeds needs;
  needs.weight = 700.0;
  needs.fps = 30.0;
  needs.frames.resize(20);
  needs.frames[10].force = Vector3d(0.0, 0.0, 140.0);  // a fifth of the weight
  const List<float> factors = momentum_factors(needs, 20, 0.1);
  for (int t = 0; t < 20; ++t)
    EXPECT_NEAR(factors[t], std::abs(t - 10) <= 3 ? 1.0 / 25.0 : 1.0, 1e-6) << t;  // (1 + 2²)⁻²
  for (float m : momentum_factors({}, 5, 0.1)) EXPECT_EQ(m, 1.0f);
}

}  // namespace
}  // namespace mimicx::plan
