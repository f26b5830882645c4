#include "run/preparation.h"

#include <gtest/gtest.h>

#include "core/temporary_folder.h"
#include "core/units.h"
#include "motion/clip_file.h"
#include "motion/made_motions.h"
#include "synth/synthesize.h"

namespace mimicx::run {
namespace {

const std::filesystem::path kNoisy =
    std::filesystem::path(MIMICX_SOURCE_DIR) / "data/synthetic/test/noisy/stand_1.npz";

TEST(Preparation, ReferenceKeepsKeypointsOnlyIfFittedToThem) {
  EXPECT_TRUE(prepare_motion(kNoisy, {}, {.fit = true}).reference.keypoints.has_value());
  const PreparedMotion unfitted = prepare_motion(kNoisy, {}, {});
  EXPECT_TRUE(unfitted.input.keypoints.has_value());
  EXPECT_FALSE(unfitted.reference.keypoints.has_value()) << "Eq. 3 would ask for a second pose";
}

TEST(Preparation, KeptKeypointsOfAnUnfittedReferenceAreThoseOfTheInput) {
  for (const bool as_is : {false, true}) {
    const PreparedMotion kept = prepare_motion(kNoisy, {}, {.as_is = as_is, .unfitted_keypoints = true});
    ASSERT_TRUE(kept.reference.keypoints.has_value());
    EXPECT_EQ(kept.reference.keypoints->uvc, kept.input.keypoints->uvc);
    EXPECT_FALSE(kept.has_fit);
  }
}

TEST(Preparation, AsIsChangesNoPose) {
  const PreparedMotion plain = prepare_motion(kNoisy, {}, {.as_is = true});
  EXPECT_EQ(plain.fitted.rotations, plain.input.rotations);
  ASSERT_EQ(plain.reference.size(), plain.input.frames());
  const auto pelvis = motion::rest_pelvis(plain.input);
  for (int t = 0; t < plain.reference.size(); ++t) {
    EXPECT_EQ(plain.reference.frames[t].p_root, plain.input.trans[t] + pelvis)
        << "it floats, and stays there";
    EXPECT_LT(plain.reference.frames[t].q[0].angularDistance(exp_map(plain.input.rotations[t][0])), 1e-12);
  }
  EXPECT_FALSE(plain.reference.keypoints.has_value());
}

TEST(Preparation, AbsentKeypointsGiveTheResultOfIgnoredOnes) {
  const PreparedMotion ignored = prepare_motion(kNoisy, {}, {});
  motion::Clip bare = ignored.input;
  bare.keypoints.reset();
  const TemporaryFolder folder;
  motion::write_clip(folder.path / "stand_1.npz", bare);
  const PreparedMotion without = prepare_motion(folder.path / "stand_1.npz", {}, {.fit = true});
  ASSERT_EQ(without.reference.size(), ignored.reference.size());
  for (int t = 0; t < ignored.reference.size(); ++t)
    EXPECT_LT((without.reference.frames[t].p_root - ignored.reference.frames[t].p_root).norm(), 1e-4)
        << "files have single precision";
}

TEST(Preparation, LevelsFeetInTheReferenceOnly) {
  constexpr double kPitch = 15 * kDegree;
  synth::SynthConfig config;
  config.kind = "walk";
  const motion::Clip clip = test::with_turned_feet(synth::synthesize(config), kPitch * Vector3d::UnitX());
  const TemporaryFolder folder;
  motion::write_clip(folder.path / "tip_toe.npz", clip);
  const PreparedMotion prepared = prepare_motion(folder.path / "tip_toe.npz", {}, {.fit = true});
  ASSERT_EQ(prepared.reference.size(), clip.frames());
  for (int t = 0; t < clip.frames(); ++t)
    for (const int ankle : {kLeftAnkle, kRightAnkle}) {
      const Quaterniond given = exp_map(clip.rotations[t][ankle]);
      EXPECT_LT(given.angularDistance(exp_map(prepared.fitted.rotations[t][ankle])), 1e-4) << t;
      EXPECT_NEAR(given.angularDistance(prepared.reference.frames[t].q[ankle]), kPitch, 1 * kDegree) << t;
    }
}

}  // namespace
}  // namespace mimicx::run
