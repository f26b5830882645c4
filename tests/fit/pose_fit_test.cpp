#include "fit/pose_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fit/fitted_clips.h"
#include "fit/keypoint_fit.h"
#include "motion/made_motions.h"
#include "motion/metrics.h"
#include "motion/raised_clip.h"
#include "motion/synthetic_clip.h"
#include "synth/noise/estimator_noise.h"

namespace mimicx::fit {
namespace {

using namespace test;

motion::Clip estimate_of(const motion::Clip& truth, const char* preset) {
  return noisy_of(truth, preset, motion::KeypointSet::kJoints22, 3);
}

bool same_motion(const motion::Clip& a, const motion::Clip& b) {
  return a.rotations == b.rotations && a.trans == b.trans && a.betas == b.betas &&
         a.body_model == b.body_model && a.keypoints.has_value() == b.keypoints.has_value() &&
         (!a.keypoints || a.keypoints->uvc == b.keypoints->uvc);
}

/// The clip, pushed over the floor at a constant speed, m per frame.
motion::Clip sliding(motion::Clip clip, double speed) {
  for (int t = 0; t < clip.frames(); ++t) clip.trans[t].x() += speed * t;
  return clip;
}

TEST(FitPoses, StopsASlidingStance) {
  for (const char* kind : {"squat", "bow", "punch"}) {
    const motion::Clip truth = truth_of(kind), slid = sliding(truth, 0.005);
    EXPECT_GT(against(truth, slid).fs_gt.value, 4.5) << kind;  // mm per frame
    const motion::Metrics after = against(truth, fit_poses(slid, {}, nullptr));
    EXPECT_LT(after.fs_gt.value, 0.5) << kind;
    EXPECT_LT(after.vel.value, 3.0) << kind << ": the body comes to rest with its feet";
  }
}

TEST(FitPoses, OnAPlateIsAsOnTheFloor) {
  motion::Clip slid = sliding(truth_of("squat"), 0.005);
  for (int t = 0; t < slid.frames(); ++t) slid.trans[t].z() += 0.05 + 0.02 * std::sin(0.05 * t);
  const motion::Clip low = fit_poses(slid, {}, nullptr), high = fit_poses(raised(slid), {}, nullptr);
  EXPECT_EQ(high.scene, wide_plate());
  EXPECT_GT((low.trans[40] - slid.trans[40]).norm(), 0.02);
  for (int t = 0; t < low.frames(); ++t)
    EXPECT_LT((high.trans[t] - low.trans[t] - kRaised * Vector3d::UnitZ()).norm(), 1e-6) << t;
}

TEST(FitPoses, PutsAFloatingAndSlidingMotionOnTheFloor) {
  const motion::Clip truth = truth_of("squat");
  for (const double height : {0.12, -0.07}) {
    motion::Clip lifted = sliding(truth, 0.005);
    for (int t = 0; t < lifted.frames(); ++t) lifted.trans[t].z() += height + 0.03 * std::sin(0.05 * t);
    const motion::Metrics after = against(truth, fit_poses(lifted, {}, nullptr));
    EXPECT_LT(after.float_gt.value, 1.0);
    EXPECT_LT(after.gp.value, 1.0);
  }
}

TEST(FitPoses, MovesALeaningBodyOverItsFeet) {
  const motion::Clip truth = truth_of("squat");
  motion::Clip leaning = sliding(truth, 0.005);
  const Quaterniond lean = exp_map(Vector3d(0.09, 0.0, 0.0));  // about the world's x axis
  for (auto& frame : leaning.rotations) frame[0] = log_map(lean * exp_map(frame[0]));
  FitConfig config;
  config.balance_frames = 0.0;
  const double before = against(truth, leaning).mpjpe.value;
  const double with = against(truth, fit_poses(leaning, {}, nullptr)).mpjpe.value;
  const double without = against(truth, fit_poses(leaning, config, nullptr)).mpjpe.value;
  EXPECT_LT(with, before);
  EXPECT_LT(with, without) << "the balance term reduces the lean";
}

TEST(FitPoses, MovesEstimatesCloserToTheTruth) {
  for (const char* preset : {"gvhmr", "vibe"})
    for (const char* kind : {"walk", "punch"}) {
      const motion::Clip truth = truth_of(kind), noisy = estimate_of(truth, preset);
      FitReport report;
      const motion::Metrics before = against(truth, noisy),
                            after = against(truth, fit_poses(noisy, {}, &report));
      EXPECT_LT(after.mpjpe.value, before.mpjpe.value) << preset << kind;
      EXPECT_LT(after.vel.value, before.vel.value) << preset << kind;
      EXPECT_LT(after.accel.value, before.accel.value) << preset << kind;
      EXPECT_LT(after.fs_gt.value, 0.5 * before.fs_gt.value) << preset << kind;
      EXPECT_LT(after.gp.value, 1.0) << preset << kind;
      EXPECT_GT(report.change_mean_mm, 0.0);
    }
}

TEST(FitPoses, SmoothsATremblingMotion) {
  for (const char* kind : {"walk", "punch"}) {
    const motion::Clip truth = truth_of(kind), noisy = estimate_of(truth, "vibe");
    const motion::Clip calm = fit_poses(noisy, {}, nullptr);
    EXPECT_LT(against(truth, calm).accel.value, 0.5 * against(truth, noisy).accel.value) << kind;
    for (std::size_t i = 0; i < kBetas; ++i)
      EXPECT_NEAR(calm.betas[i], noisy.betas[i], 1e-4) << "the shape is not observable";
  }
}

TEST(FitPoses, TheLessAMotionSlidesTheLessItsPosesChange) {
  const motion::Clip truth = truth_of("squat");
  double before = 0.0;
  for (const double speed : {0.0005, 0.001, 0.003}) {
    motion::Clip slid = sliding(truth, speed);
    for (int t = 0; t < slid.frames(); ++t) slid.rotations[t][kLeftHip].y() += 0.05;  // the foot turns
    const double changed = against(slid, fit_poses(slid, {}, nullptr)).pa_mpjpe.value;
    EXPECT_GT(changed, before);
    before = changed;
  }
}

TEST(FitPoses, CleanMotionStaysByteIdentical) {
  for (const char* kind : {"walk", "jog", "kick", "punch", "jump", "side_step"}) {
    const motion::Clip truth = truth_of(kind);
    EXPECT_TRUE(same_motion(fit_poses(truth, {}, nullptr), truth)) << kind;
  }
}

TEST(FitPoses, IgnoresTheKeypoints) {
  const motion::Clip noisy = estimate_of(truth_of("walk"), "gvhmr");
  motion::Clip blind = noisy;
  blind.keypoints.reset();
  const motion::Clip fitted = fit_poses(noisy, {}, nullptr);
  EXPECT_EQ(fitted.rotations, fit_poses(blind, {}, nullptr).rotations);
  EXPECT_EQ(fitted.keypoints->uvc, noisy.keypoints->uvc);
}

TEST(FitPoses, FeetOfALyingOrCrawlingPersonDoNotStand) {
  motion::Clip lying = truth_of("stand");
  const Quaterniond over = exp_map(Vector3d(test::kPi / 2, 0.0, 0.0));
  for (auto& frame : lying.rotations) frame[0] = log_map(over * exp_map(frame[0]));
  const motion::Clip slid = sliding(lying, 0.005), fitted = fit_poses(slid, {}, nullptr);
  EXPECT_LT(against(slid, fitted).mpjpe.value, 0.1) << "nothing holds";
}

TEST(FitPoses, RejectsNonFiniteValues) {
  motion::Clip clip = truth_of("stand");
  clip.trans[7].x() = std::nan("");
  EXPECT_THROW(fit_poses(clip, {}, nullptr), DataError);
}

}  // namespace
}  // namespace mimicx::fit
