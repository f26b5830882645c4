#include "motion/prepare/limb_glitches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/made_motions.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

using test::kPi;

Clip synthetic(const std::string& kind) { return test::synthetic_clip(kind, 501); }

/// The right leg is displaced in the frames first … last: its hip is turned by 0.6 rad.
Clip with_swapped_leg(Clip clip, int first, int last) {
  for (int t = first; t <= last; ++t) clip.rotations[t][kRightHip] += Vector3d(0.6, 0.2, 0.3);
  return clip;
}

TEST(LimbGlitches, FindsTheExactFramesOfADisplacedLimb) {
  const Clip walk = synthetic("walk");
  ASSERT_TRUE(find_limb_glitches(walk).empty());
  for (const auto& [first, last] : {std::pair<int, int>{40, 40}, {60, 62}, {80, 84}}) {
    const List<LimbGlitch> found = find_limb_glitches(with_swapped_leg(walk, first, last));
    ASSERT_EQ(found.size(), 1u) << first;
    EXPECT_EQ(kLimbRoot[found[0].limb], kRightHip);
    EXPECT_EQ(found[0].first, first);
    EXPECT_EQ(found[0].last, last);
  }
}

TEST(LimbGlitches, IgnoresLongAndLastingChanges) {
  const Clip walk = synthetic("walk");
  EXPECT_TRUE(find_limb_glitches(with_swapped_leg(walk, 60, 75)).empty());
  EXPECT_TRUE(find_limb_glitches(with_swapped_leg(walk, 60, walk.frames() - 1)).empty());
}

TEST(LimbGlitches, FindsNoneInFastMotions) {
  for (const char* kind : {"kick", "punch", "jump", "jog", "dance"})
    EXPECT_TRUE(find_limb_glitches(synthetic(kind)).empty()) << kind;
  Clip kick = test::standing_clip(60, 1.0);  // the whole leg swings up and back in 0.4 s
  for (int t = 20; t < 32; ++t)
    kick.rotations[t][kLeftHip].x() = -1.6 * std::pow(std::sin(kPi * (t - 20) / 12.0), 2);
  EXPECT_TRUE(find_limb_glitches(kick).empty());
}

TEST(LimbGlitches, BridgingRestoresTheLimbAndChangesNothingElse) {
  const Clip walk = synthetic("walk");
  Clip clip = with_swapped_leg(walk, 60, 62);
  bridge_limb_glitches(clip, find_limb_glitches(clip));
  for (int t = 0; t < walk.frames(); ++t)
    for (int body = 0; body < kBodies; ++body) {
      const bool bridged = kLimbOf[body] == kLimbOf[kRightHip] && t >= 60 && t <= 62;
      if (!bridged) {
        EXPECT_EQ(clip.rotations[t][body], walk.rotations[t][body]) << t << " " << body;
        continue;
      }
      const Quaterniond now = exp_map(clip.rotations[t][body]), then = exp_map(walk.rotations[t][body]);
      EXPECT_LT(now.angularDistance(then), 0.12) << t << " " << body;
    }
}

}  // namespace
}  // namespace mimicx::motion
