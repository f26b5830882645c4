#include "judge/scores.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/prepare/prepare.h"
#include "motion/resample.h"
#include "motion/standing_clip.h"

namespace mimicx::judge {
namespace {

TEST(Scores, InputOfAnotherRateIsScoredAtTheReferencesRate) {
  motion::Clip clip = motion::standing_clip(21);
  for (int t = 0; t < clip.frames(); ++t) clip.trans[t].x() += 0.010 * t;
  const motion::Reference reference = motion::prepare_reference(clip, {}, nullptr);
  const NamedValues at_30 = score_input(clip, reference).values,
                    at_120 = score_input(motion::resampled(clip, 120.0), reference).values;
  EXPECT_GT(value_of(at_30, "FS_gt"), 9.0) << "mm per frame at 30 fps";
  for (const auto& [name, value] : at_30)
    if (!std::isnan(value)) {
      EXPECT_NEAR(value_of(at_120, name), value, 1e-6) << name;
    }
}

}  // namespace
}  // namespace mimicx::judge
