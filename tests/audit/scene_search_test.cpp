#include "audit/scene_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "synth/data_set.h"

namespace mimicx::audit {
namespace {

/// A clip whose scene is known, and not told.
struct Known {
  motion::Clip clip;
  Scene scene;
};
Known known(const std::string& kind) {
  synth::SynthConfig config;
  config.kind = kind;
  Known known{synth::synthesize(config), {}};
  std::swap(known.scene, known.clip.scene);
  return known;
}

motion::Clip noisy(const std::string& kind) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 1;
  return synth::make_synth_pair(config, {}).noisy;
}

TEST(FindScene, FindsEveryStepAtItsHeightAndPlace) {
  for (const std::string kind : {"stairs_up", "stairs_down", "kerb", "box"}) {
    SCOPED_TRACE(kind);
    const Known k = known(kind);
    const FoundScene found = find_scene(k.clip);
    ASSERT_EQ(found.scene.plates.count(), k.scene.plates.count());
    ASSERT_EQ(found.words.size(), k.scene.plates.size());
    EXPECT_NEAR(found.floor, 0.0, 0.002);
    for (int i = 0; i < k.scene.plates.count(); ++i) {
      EXPECT_NEAR(found.scene.plates[i].height, k.scene.plates[i].height, 0.005);
      EXPECT_TRUE(
          k.scene.plates[i].spans({found.scene.plates[i].centre.x(), found.scene.plates[i].centre.y(), 0.0}));
    }
  }
}

// Its margin would otherwise be the side of a box in which the toes of a foot on the step before stand.
TEST(FindScene, StepEndsWhereAFootStandsLower) {
  const Known k = known("stairs_up");
  const Scene found = find_scene(k.clip).scene;
  const Character c = motion::character_of(k.clip);
  const PerFrame<BodyPoses> poses = motion::poses_of(k.clip);
  int lower = 0, inside = 0;
  for (int t = 1; t < poses.count(); ++t)
    for (int i = 0; i < kFootPoints; ++i) {
      const ContactPoint& point = c.contact_points[i];
      const Vector3d p = lowest_position(point, poses[t]), before = lowest_position(point, poses[t - 1]);
      if ((p - before).norm() * k.clip.fps > 0.02 || std::abs(k.scene.clearance(p)) > 0.002) continue;
      for (const Plate& plate : found.plates) {
        if (p.z() > plate.height - 0.05) continue;
        inside += plate.spans(p);
        ++lower;
      }
    }
  EXPECT_GT(lower, 500);
  EXPECT_LT(inside, lower / 100);  // of feet that are about to leave
}

TEST(FindScene, FindsTheSeatAsACushionUnderTheHips) {
  const Known k = known("sit_down");
  const FoundScene found = find_scene(k.clip);
  ASSERT_EQ(found.scene.plates.size(), 1u);
  const Plate& seat = found.scene.plates.front();
  EXPECT_NEAR(seat.height - seat.give(), k.scene.plates.front().height, 0.02);
  EXPECT_GT(seat.give(), 0.003);
  EXPECT_TRUE(k.scene.plates.front().spans({seat.centre.x(), seat.centre.y(), 0.0}));
  EXPECT_EQ(found.words.front().rfind("a seat of 0.", 0), 0u) << found.words.front();
  EXPECT_NE(found.words.front().find("under the pelvis, frames "), std::string::npos);
}

/// Balance over the feet needs no seat, and a flight no step, whatever the errors of an estimator.
TEST(FindScene, FindsNothingWhereTheFloorIsEnough) {
  for (const std::string kind : {"sit", "crouch", "squat", "jumps", "kick", "march"}) {
    const FoundScene found = find_scene(noisy(kind));
    EXPECT_TRUE(found.scene.flat()) << kind << ": " << found.words.front();
  }
}

// The bound of docs/scenes.md, "Finding the scene". In these estimates one foot is up to 5 cm higher than the
// other.
TEST(FindScene, FindsNineOfTenNoisyStepsToTwoCentimetres) {
  int plates = 0, near = 0, found_plates = 0;
  for (const std::string kind : {"stairs_up", "stairs_down", "kerb", "box"})
    for (const std::uint64_t seed : {7, 8}) {
      SCOPED_TRACE(kind + " " + std::to_string(seed));
      synth::SynthConfig config;
      config.kind = kind;
      config.seed = seed;
      const synth::SynthPair pair = synth::make_synth_pair(config, {});
      const Scene found = find_scene(pair.noisy).scene;
      plates += pair.truth.scene.plates.count();
      found_plates += found.plates.count();
      for (const Plate& plate : pair.truth.scene.plates)
        near += std::any_of(found.plates.begin(), found.plates.end(), [&](const Plate& estimate) {
          return std::abs(estimate.height - plate.height) < 0.02;
        });
    }
  EXPECT_GE(10 * near, 9 * plates);
  EXPECT_LE(found_plates, plates);
}

TEST(FindScene, FindsStepsOfANoisyEstimate) {
  const FoundScene found = find_scene(noisy("stairs_up"));
  synth::SynthConfig config;
  config.kind = "stairs_up";
  config.seed = 1;
  const Scene truth = synth::synthesize(config).scene;
  ASSERT_EQ(found.scene.plates.count(), truth.plates.count());
  for (int i = 0; i < truth.plates.count(); ++i)
    EXPECT_NEAR(found.scene.plates[i].height, truth.plates[i].height, 0.05);
}

TEST(FindScene, StepsOfAFlightRiseEqually) {
  const Scene found = find_scene(noisy("stairs_up")).scene;
  ASSERT_GE(found.plates.count(), 3);
  for (int i = 0; i < found.plates.count(); ++i)
    EXPECT_NEAR(found.plates[i].height, (i + 1) * found.plates[0].height, 1e-12);
}

/// Up, down backwards, and up again: the same steps, not three times as many.
TEST(FindScene, StepsThatAreUsedAgainAreTheSame) {
  const Known k = known("stairs_up");
  motion::Clip clip = k.clip;
  const auto append = [&](bool reversed) {
    for (int t = 0; t < k.clip.frames(); ++t) {
      const auto from = static_cast<std::size_t>(reversed ? k.clip.frames() - 1 - t : t);
      clip.rotations.push_back(k.clip.rotations[from]);
      clip.trans.push_back(k.clip.trans[from]);
    }
  };
  append(true), append(false);
  EXPECT_EQ(find_scene(clip).scene.plates.count(), k.scene.plates.count());
}

/// Two squats, between which the estimate rises by 20 cm: nobody has stepped.
TEST(FindScene, MotionThatDriftsUpIsOnNoStep) {
  synth::SynthConfig config;
  config.kind = "squat";
  motion::Clip clip = synth::synthesize(config);
  const int frames = clip.frames();
  for (int t = 0; t < frames; ++t) {
    clip.rotations.push_back(clip.rotations[static_cast<std::size_t>(t)]);
    clip.trans.push_back(clip.trans[static_cast<std::size_t>(t)] + 0.2 * Vector3d::UnitZ());
  }
  EXPECT_TRUE(find_scene(clip).scene.flat());
}

TEST(FindScene, FloorThatIsKnownMakesAStepOfAPersonWhoNeverLeavesIt) {
  synth::SynthConfig config;
  config.kind = "squat";
  motion::Clip clip = synth::synthesize(config);
  for (Vector3d& p : clip.trans) p.z() += 0.4;
  EXPECT_TRUE(find_scene(clip).scene.flat());
  clip.on_floor = true;
  const FoundScene found = find_scene(clip);
  ASSERT_EQ(found.scene.plates.count(), 1);
  EXPECT_NEAR(found.scene.plates[0].height, 0.4, 0.01);
}

TEST(FindScene, RefusesTwoFrames) {
  motion::Clip clip = known("kerb").clip;
  clip.rotations.resize(2);
  clip.trans.resize(2);
  EXPECT_THROW(find_scene(clip), std::exception);
}

}  // namespace
}  // namespace mimicx::audit
