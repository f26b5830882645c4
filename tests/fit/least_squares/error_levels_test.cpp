#include "fit/least_squares/error_levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/keypoint_fit.h"
#include "fit/least_squares/projection.h"
#include "fit/least_squares/random_problems.h"
#include "motion/metrics.h"
#include "motion/synthetic_clip.h"
#include "synth/noise/estimator_noise.h"

namespace mimicx::fit {
namespace {

using namespace test;

motion::Clip walk(std::size_t frames = 75) { return synthetic_clip("walk", 5, frames); }

/// What turns normal errors into those of Student's distribution with four degrees of freedom.
double tail(Random& random) {
  double squares = 0.0;
  for (int i = 0; i < 4; ++i) squares += std::pow(random.normal(), 2) / 4.0;
  return std::sqrt(squares);
}

/// Detections of the truth with white errors of the fit's own distribution: σ of keypoint k is `sigma` (twice
/// that for odd k) over confidence to `power`, in heights of the box. The motion itself is a little off
/// everywhere.
motion::Clip detected(const motion::Clip& truth, double sigma, double power) {
  Random random(11, {});
  motion::Clip clip = truth;
  const PerFrame<BodyPoses> poses = motion::poses_of(truth);
  const synth::Camera camera = synth::place_camera(poses, 1);
  motion::Keypoints k;
  k.names = motion::keypoint_names(motion::KeypointSet::kJoints22);
  k.intrinsics = camera.intrinsics;
  k.extrinsics = {camera.extrinsics};
  for (const BodyPoses& pose : poses) {
    Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    for (const Vector3d& p : pose.p_WB) {
      const Eigen::Vector2d uv = synth::project(camera, p).head<2>();
      low = low.cwiseMin(uv), high = high.cwiseMax(uv);
    }
    k.uvc.emplace_back();
    for (int b = 0; b < kBodies; ++b) {
      const double confidence = random.uniform(0.3, 1.0);
      const double size = (high - low).maxCoeff() * sigma * (b % 2 ? 2.0 : 1.0) / std::pow(confidence, power);
      const Vector3d seen = synth::project(camera, pose.p_WB[b]);
      const double u = random.normal(), v = random.normal(), w = tail(random);
      k.uvc.back().push_back({seen.x() + size * u / w, seen.y() + size * v / w, confidence});
    }
  }
  clip.keypoints = k;
  for (auto& frame : clip.rotations)
    for (int b = 1; b < kBodies; ++b)
      frame[b] = log_map(exp_map(frame[b]) * exp_map(Vector3d(0.03, -0.02, 0.02)));
  return clip;
}

FitConfig exact_camera_of(double sigma) {
  FitConfig config;
  config.focal_sigma = config.tilt_sigma = config.beta_sigma = 0.0;
  config.keypoint_sigma = sigma;
  config.keypoint_correlation = 0.0;
  config.smallest_change = 0.0;  // the poses are found sooner than the levels
  return config;
}

double mpjpe(const motion::Clip& truth, const motion::Clip& motion) {
  const auto samples = [](const motion::Clip& c) {
    return motion::sample_motion(make_character(c.usable_betas()), motion::poses_of(c), c.fps);
  };
  const motion::MotionSamples t = samples(truth);
  return motion::evaluate_motion(samples(motion), &t).mpjpe.value;
}

TEST(FitLevels, ConvergeFromThreeTimesTooLargeAndTooSmall) {
  constexpr double kSigma = 0.006;
  const motion::Clip clip = detected(walk(150), kSigma, 1.0);
  for (const double wrong :
       {kSigma / 2.0, 1.5 * kSigma, 4.5 * kSigma}) {  // the right one is 1.5 in the middle
    FitReport report;
    fit_keypoints(clip, exact_camera_of(wrong), &report);
    const double middle = 100.0 * 1.5 * kSigma, worst = 100.0 * 2.0 * kSigma;  // of one and two, in percent
    EXPECT_NEAR(report.keypoint_sigma, middle, 0.3 * middle) << wrong;
    EXPECT_NEAR(report.keypoint_sigma_max, worst, 0.3 * worst) << wrong;
  }
}

TEST(FitLevels, FindTheConfidencePowerFromTheResiduals) {
  const auto found = [](double power) {
    FitReport report;
    fit_keypoints(detected(walk(), 0.005, power), exact_camera_of(0.005), &report);
    return report.confidence_power;
  };
  EXPECT_NEAR(found(0.0), 0.0, 0.25);
  EXPECT_NEAR(found(1.0), 1.0, 0.25);
  EXPECT_NEAR(found(2.0), 2.0, 0.4);
}

TEST(FitLevels, EstimatedLevelsReduceTheErrorFromAWrongLevel) {
  const motion::Clip truth = walk(), clip = detected(truth, 0.009, 1.0);
  const auto error = [&](double sigma, bool find) {
    FitConfig config = exact_camera_of(sigma);
    config.find_levels = find;
    return mpjpe(truth, fit_keypoints(clip, config, nullptr));
  };
  const double right = error(0.0135, true), found = error(0.0045, true), believed = error(0.0045, false);
  EXPECT_LT(found - right, 0.7 * (believed - right));
  EXPECT_GT(believed, right);
}

}  // namespace
}  // namespace mimicx::fit
