#include "motion/prepare/prepare.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <limits>

#include "core/quantile.h"
#include "core/units.h"
#include "import/world_transform.h"
#include "motion/clip_file.h"
#include "motion/metrics.h"
#include "motion/prepare/damaged_motions.h"
#include "motion/raised_clip.h"
#include "motion/standing_clip.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

using test::jump_heights;
using test::with_glitch;

std::vector<double> lowest_of(const Reference& r) {
  const auto points = surface_points(r.character);
  std::vector<double> z;
  for (const BodyPoses& pose : r.poses) z.push_back(lowest_height(points, pose));
  return z;
}

Clip lifted(Clip clip, const std::vector<double>& height) {
  for (std::size_t t = 0; t < clip.trans.size(); ++t) clip.trans[t].z() += height[t];
  return clip;
}

TEST(Prepare, LiftedAndSunkMotionsStandOnTheFloor) {
  for (const double height : {0.4, -0.25}) {
    PreparationReport report;
    const Clip clip = test::standing_clip(60, test::standing_height() + height);
    const Reference r = prepare_reference(clip, {}, &report);
    for (const double z : lowest_of(r)) EXPECT_NEAR(z, 0.0, 1e-9);
    EXPECT_NEAR(report.floor_shift_mm, -1000 * height, 1e-6);
    EXPECT_NEAR(report.change_max_mm, 1000 * std::abs(height), 1e-6);
    EXPECT_LT(report.hinge_residual_max_mm, 1e-3);
    EXPECT_EQ(report.flagged_frames, 0);
    PreparationConfig off;
    off.ground = false;
    EXPECT_NEAR(lowest_of(prepare_reference(clip, off, nullptr))[30], height, 1e-9);
  }
}

TEST(Prepare, KeepsABallisticJump) {
  const std::vector<double> jump = test::jump_heights(90, 2.5);
  std::vector<double> height = jump;
  for (double& z : height) z += 0.06;  // floating, as video estimates do
  const Reference r =
      prepare_reference(lifted(test::standing_clip(90, test::standing_height()), height), {}, nullptr);
  const std::vector<double> z = lowest_of(r);
  for (std::size_t t = 0; t < 90; ++t) EXPECT_NEAR(z[t], jump[t], 0.003) << t;
  for (std::size_t t = 0; t < 90; ++t)
    if (jump[t] > 0.1) {
      EXPECT_NEAR((r.frames[t + 1].v_root - r.frames[t - 1].v_root).z() * 15.0, -9.81, 0.2);
    }
}

/// Heights over the floor that begin in the air, with the upward speed and acceleration, and end standing.
std::vector<double> fall_heights(int frames, double height, double speed, double acceleration) {
  std::vector<double> z;
  for (int t = 0; t < frames; ++t) {
    const double s = t / 30.0;
    z.push_back(std::max(0.0, height + speed * s + 0.5 * acceleration * s * s));
  }
  return z;
}

TEST(Prepare, AMotionThatBeginsInTheAirHasTheVelocityOfItsFlight) {
  const auto beginning = [](double acceleration) {
    const Clip standing = test::standing_clip(90, test::standing_height());
    return prepare_reference(lifted(standing, fall_heights(90, 0.3, 1.0, acceleration)), {}, nullptr).frames;
  };
  EXPECT_NEAR(beginning(-9.81)[0].v_root.z(), 1.0, 1e-9);
  const auto held = beginning(-4.0);  // no fall: the difference stays
  EXPECT_NEAR(held[0].v_root.z(), 30.0 * (held[1].p_root - held[0].p_root).z(), 1e-9);
}

TEST(Prepare, BoundsPenetrationOfARandomMotion) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Reference r = prepare_reference(test::random_clip(seed, 90, 0.3), {}, nullptr);
    for (const double z : lowest_of(r)) EXPECT_GE(z, -0.0101);
  }
}

TEST(Prepare, ResamplesTo30FpsOnTheCharacterOfTheClip) {
  Clip clip = test::random_clip(8, 121, 0.2, 120.0);
  clip.betas[0] = 1.0;
  const Reference r = prepare_reference(clip, {}, nullptr);
  EXPECT_EQ(r.fps, 30.0);
  EXPECT_EQ(r.size(), 31);
  EXPECT_EQ(r.poses.size(), 31u);
  EXPECT_EQ(r.flagged.size(), 31u);
  EXPECT_EQ(r.character.betas[0], 1.0);
  for (const ReferenceFrame& f : r.frames)
    for (const int hinge : {kLeftKnee, kRightKnee, kLeftElbow, kRightElbow})
      EXPECT_LT(log_map(f.q[hinge]).cross(hinge_axis(hinge)).norm(), 1e-12);
}

TEST(Prepare, FlaggedFramesAreBridgedAndReported) {
  const Clip clip = test::with_glitch(test::random_clip(6, 90, 0.3), 40, 43, 2.0);
  PreparationReport report;
  const Reference r = prepare_reference(clip, {}, &report);
  EXPECT_EQ(report.flagged_frames, 3);
  EXPECT_TRUE(r.flagged[41]);
  EXPECT_GT(report.change_max_mm, 100.0);
  for (const ReferenceFrame& f : r.frames)
    for (const Vector3d& w : f.omega) EXPECT_LT(w.norm(), 25.0);
}

TEST(Prepare, FramesThatAreNotBridgedAreNotFlagged) {
  const Clip clip = test::with_glitch(test::random_clip(6, 90, 0.3), 40, 43, 2.0);
  PreparationConfig as_it_is;
  as_it_is.bridge_flagged = false;
  PreparationReport report;
  const Reference r = prepare_reference(clip, as_it_is, &report);
  EXPECT_EQ(report.flagged_frames, 0) << "the manifest's number of bridged frames";
  EXPECT_EQ(r.flagged, PerFrame<bool>(90, false));
}

TEST(Prepare, NotesSignsOfWrongAxesScaleOrRate) {
  const auto notes = [](const Clip& clip) {
    PreparationReport report;
    prepare_reference(clip, {}, &report);
    return report.notes;
  };
  EXPECT_TRUE(notes(test::standing_clip(30, test::standing_height())).empty());
  Clip lying = test::standing_clip(30, 0.3);
  for (auto& frame : lying.rotations) frame[0] = Vector3d::Zero();  // y up, taken for z up
  ASSERT_EQ(notes(lying).size(), 1u);
  EXPECT_NE(notes(lying)[0].find("z up"), std::string::npos);
  ASSERT_EQ(notes(test::standing_clip(30, 90.0)).size(), 1u);
  EXPECT_NE(notes(test::standing_clip(30, 90.0))[0].find("metres"), std::string::npos);
  Clip fast = test::standing_clip(30, test::standing_height());
  for (std::size_t t = 0; t < 30; ++t) fast.trans[t].x() = static_cast<double>(t);
  ASSERT_EQ(notes(fast).size(), 1u);
  EXPECT_NE(notes(fast)[0].find("speed"), std::string::npos);
  Clip tilted = test::synthetic_clip("squat", 3);
  import::rotate_world(exp_map(20.0 * kDegree * Vector3d::UnitX()), tilted);
  ASSERT_EQ(notes(tilted).size(), 1u);
  EXPECT_NE(notes(tilted)[0].find("tilted"), std::string::npos);
  Clip treadmill = test::synthetic_clip("walk", 3);
  for (Vector3d& trans : treadmill.trans) trans.head<2>().setZero();
  ASSERT_EQ(notes(treadmill).size(), 1u);
  EXPECT_NE(notes(treadmill)[0].find("treadmill"), std::string::npos);
}

/// Largest distance of a joint from where it is in another reference and `up` higher, m.
double farthest_from(const Reference& a, const Reference& b, double up) {
  double most = 0.0;
  for (int t = 0; t < a.size(); ++t)
    for (int k = 0; k < kBodies; ++k)
      most = std::max(most, (a.poses[t].p_WB[k] - b.poses[t].p_WB[k] - up * Vector3d::UnitZ()).norm());
  return most;
}

// Every step that knows a floor meets the plate in its place. Planting asks whether a standing point is below
// the ground, and most are there to rounding: a motion that is only lifted comes down with other swings of
// its feet, too.
TEST(Prepare, OnAPlateIsAsOnTheFloor) {
  Clip clip = test::synthetic_clip("walk_turn", 3, 80);
  for (int t = 0; t < clip.frames(); ++t)
    clip.trans[t] += Vector3d(0.004 * t, 0.0, 0.05 + 0.02 * std::sin(0.1 * t));
  for (const bool plant : {false, true}) {
    PreparationConfig config;
    config.plant = plant;
    PreparationReport low_report, high_report;
    Clip lifted = test::raised(clip);
    lifted.scene = {};
    const Reference low = prepare_reference(clip, config, &low_report),
                    high = prepare_reference(test::raised(clip), config, &high_report),
                    again = prepare_reference(lifted, config, nullptr);
    EXPECT_EQ(high.scene, test::wide_plate());
    EXPECT_LT(low_report.floor_shift_mm, -30.0);
    EXPECT_NEAR(high_report.floor_shift_mm, low_report.floor_shift_mm, 1e-6);
    EXPECT_EQ(low_report.feet_planted_mm > 5.0, plant);
    std::printf("  farthest on the plate %.1e m, lifted %.1e m\n", farthest_from(high, low, test::kRaised),
                farthest_from(again, low, 0.0));
    EXPECT_LT(farthest_from(high, low, test::kRaised), plant ? 0.02 : 1e-8);
  }
}

// It did, by up to 8 cm, and with it everything else.
TEST(Prepare, AHandThatHangsBesideASeatDoesNotLiftTheBody) {
  Clip clip = motion::standing_clip(30);
  PreparationReport on_the_floor, beside;
  prepare_reference(clip, {}, &on_the_floor);
  const Vector3d hand = poses_of(clip)[0].p_WB[kLeftWrist];
  clip.scene.plates.push_back(
      {.centre = hand.head<2>(), .half_extents = {0.05, 0.05}, .height = hand.z() + 0.04});
  ASSERT_LT(clip.scene.clearance(hand), 0.0);
  prepare_reference(clip, {}, &beside);
  EXPECT_NEAR(beside.max_floor_shift_mm, on_the_floor.max_floor_shift_mm, 0.1);
}

TEST(Prepare, RejectsTooShortAndNonFiniteClips) {
  EXPECT_THROW(prepare_reference(test::standing_clip(1, 1.0), {}, nullptr), DataError);
  EXPECT_THROW(prepare_reference(test::standing_clip(3, 1.0, 120.0), {}, nullptr),
               DataError);  // one frame at 30 fps
  Clip broken = test::standing_clip(10, 1.0);
  broken.rotations[4][3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(prepare_reference(broken, {}, nullptr), DataError);
}

TEST(Prepare, RealClipsComeOutOnTheFloorAndLittleChanged) {
  namespace fs = std::filesystem;
  const fs::path motions = fs::path(MIMICX_SHARED_DIR) / "motions";
  if (!fs::exists(motions)) GTEST_SKIP() << "no folder of real motions here";
  for (const auto& entry : fs::directory_iterator(motions / "video")) {
    PreparationReport report;
    const Reference r = prepare_reference(read_clip(entry.path()), {}, &report);
    // the last three frames of one clip are 23 cm over the others
    const bool hangs = entry.path().stem() == "video_single_foot_balance_level2_filter_amass";
    EXPECT_EQ(report.flagged_frames, hangs ? 3 : 0) << entry.path();
    EXPECT_LT(report.change_mean_mm, 40.0) << entry.path();  // floor, levelled and planted feet
    EXPECT_LT(report.hinge_residual_mean_mm, 2.0) << entry.path();
    const Metrics m = evaluate_motion(sample_motion(r.character, r.poses, r.fps), nullptr);
    EXPECT_LT(m.gp_max.value, 3.0) << entry.path();
    EXPECT_NEAR(ranked(lowest_of(r), 15), 0.0, 0.01) << entry.path();
  }
}

}  // namespace
}  // namespace mimicx::motion
