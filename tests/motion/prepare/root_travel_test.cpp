#include "motion/prepare/root_travel.h"

#include <gtest/gtest.h>

#include <tuple>

#include "core/units.h"
#include "import/world_transform.h"
#include "motion/made_motions.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

std::optional<TravelContradiction> contradiction_of(const Clip& clip) {
  return travel_contradiction(character_of(clip), poses_of(clip), clip.fps);
}

/// The clip with each place of the pelvis times these factors, about that of its first frame.
Clip with_travel(Clip clip, double x, double y, double z) {
  const Vector3d first = clip.trans[0];
  for (Vector3d& trans : clip.trans) trans = first + Vector3d(x, y, z).cwiseProduct(trans - first);
  return clip;
}

TEST(RootTravel, RatioSaysWhatIsWrongWithTheTranslation) {
  for (const std::string kind : {"walk", "walk_back", "walk_turn", "walk_curve"})
    for (const auto& [x, y, z] : {std::tuple(0.0, 0.0, 1.0),
                                  {0.0, 0.0, 0.0},
                                  {-1.0, -1.0, 1.0},
                                  {0.01, 0.01, 0.01},
                                  {2.54, 2.54, 1.0}}) {
      const auto found = contradiction_of(with_travel(test::synthetic_clip(kind, 3), x, y, z));
      ASSERT_TRUE(found) << kind << ' ' << x;
      EXPECT_NEAR(found->ratio, x, 0.1 + 0.05 * std::abs(x)) << kind;
      EXPECT_GT(found->slide_mm, 3.0) << kind;
    }
}

TEST(RootTravel, IsNotContradictedByItsOwnFeet) {
  for (const auto& kinds : {synth::basic_kinds(), synth::floor_kinds(), synth::ground_kinds()})
    for (const std::string& kind : kinds)
      EXPECT_FALSE(contradiction_of(test::synthetic_clip(kind, 2))) << kind;
}

TEST(RootTravel, FeetOfEstimatorsMaySkate) {
  const Clip walk = test::synthetic_clip("walk", 3);
  EXPECT_FALSE(contradiction_of(with_travel(walk, 0.8, 0.8, 1.0)));
  EXPECT_FALSE(contradiction_of(with_travel(walk, 1.25, 1.25, 1.0)));
  Clip tilted = walk;
  import::rotate_world(exp_map(10.0 * kDegree * Vector3d::UnitX()), tilted);
  EXPECT_FALSE(contradiction_of(tilted));
}

}  // namespace
}  // namespace mimicx::motion
