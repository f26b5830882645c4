#include "motion/prepare/ground_slope.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "import/world_transform.h"
#include "motion/made_motions.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

std::optional<GroundSlope> slope_of(const Clip& clip) {
  return ground_slope(character_of(clip), poses_of(clip), clip.fps);
}

TEST(GroundSlope, IsTheTiltOfTheWorld) {
  for (const std::string kind : {"stand", "walk", "squat", "jump", "turn_in_place", "jog", "sit"})
    for (const double degrees : {20.0, 30.0, 45.0})
      for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(-0.6, 0.8, 0)}) {
        const Quaterniond tilt = exp_map(degrees * kDegree * axis);
        Clip clip = test::synthetic_clip(kind, 3);
        import::rotate_world(tilt, clip);
        const auto found = slope_of(clip);
        ASSERT_TRUE(found) << kind << ' ' << degrees << ' ' << axis.transpose();
        EXPECT_NEAR(found->degrees, degrees, 6.0) << kind;
        EXPECT_GT(found->up.dot(tilt * Vector3d::UnitZ()), cos(12.0 * kDegree)) << kind;
      }
}

TEST(GroundSlope, IsNoneInALevelWorld) {
  for (const auto& kinds : {synth::synthetic_kinds(), synth::floor_kinds(), synth::ground_kinds()})
    for (const std::string& kind : kinds) EXPECT_FALSE(slope_of(test::synthetic_clip(kind, 2))) << kind;
}

TEST(GroundSlope, IsNotTheConstantErrorOfTheFeet) {
  for (const std::string kind : {"stand", "walk", "squat"})
    for (const double degrees : {-30.0, 15.0, 30.0}) {
      const Clip clip =
          test::with_turned_feet(test::synthetic_clip(kind, 3), degrees * kDegree * Vector3d::UnitX());
      EXPECT_FALSE(slope_of(clip)) << kind << ' ' << degrees;
    }
}

TEST(GroundSlope, IsNotTheLeanOfABodyOverLevelFeet) {
  for (const double degrees : {-20.0, 20.0}) {
    const Vector3d lean = degrees * kDegree * Vector3d::UnitX();  // about the ankles, as the world's x
    Clip clip = test::with_turned_feet(test::standing_clip(60, test::standing_height()), -lean);
    import::rotate_world(exp_map(lean), clip);
    EXPECT_FALSE(slope_of(clip)) << degrees;
    EXPECT_TRUE(slope_of(test::with_turned_feet(clip, lean))) << degrees;
  }
}

}  // namespace
}  // namespace mimicx::motion
