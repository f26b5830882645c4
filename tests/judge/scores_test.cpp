#include "judge/scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/made_motions.h"
#include "motion/prepare/prepare.h"
#include "motion/raised_clip.h"
#include "motion/resample.h"
#include "motion/standing_clip.h"

namespace mimicx::judge {
namespace {

TEST(Scores, InputOfAnotherRateIsScoredAtTheReferencesRate) {
  motion::Clip clip = motion::standing_clip(21);
  for (int t = 0; t < clip.frames(); ++t) clip.trans[t].x() += 0.010 * t;
  const motion::Reference reference = motion::prepare_reference(clip, {}, nullptr);
  const NamedValues at_30 = score_input(clip, reference, kGravity).values,
                    at_120 = score_input(motion::resampled(clip, 120.0), reference, kGravity).values;
  EXPECT_GT(value_of(at_30, "FS_gt"), 9.0) << "mm per frame at 30 fps";
  for (const auto& [name, value] : at_30)
    if (!std::isnan(value)) {
      EXPECT_NEAR(value_of(at_120, name), value, 1e-6) << name;
    }
}

// A fit moves the feet, and the plates with them.
TEST(Scores, InputStandsOnItsOwnScene) {
  const motion::Clip input = test::raised(test::standing_clip(21, test::standing_height()));
  motion::Reference reference = motion::prepare_reference(input, {}, nullptr);
  for (const double moved : {0.05, -0.05}) {
    reference.scene.plates[0].height = test::kRaised + moved;
    const NamedValues values = score_input(input, reference, kGravity).values;
    for (const char* name : {"GP", "Float", "slip"}) EXPECT_NEAR(value_of(values, name), 0.0, 1e-6) << name;
  }
}

// A fifth of a second of free fall on the moon, at most 8 mm over the floor, which would carry such a body on
// Earth.
TEST(Scores, InputFallsWithTheGravityOfTheSimulation) {
  constexpr double kMoon = 1.62, kFlight = 0.2;
  motion::Clip clip = test::standing_clip(36, test::standing_height());
  for (int t = 0; t < clip.frames(); ++t) {
    const double s = std::clamp(t / clip.fps - 0.5, 0.0, kFlight);
    clip.trans[t].z() += 0.5 * kMoon * s * (kFlight - s);
  }
  const motion::Reference reference = motion::prepare_reference(clip, {}, nullptr);
  const audit::Slip moon = score_input(clip, reference, kMoon).slip,
                    earth = score_input(clip, reference, kGravity).slip;
  EXPECT_TRUE(std::isnan(moon.speed[18]));
  EXPECT_FALSE(std::isnan(earth.speed[18]));
}

}  // namespace
}  // namespace mimicx::judge
