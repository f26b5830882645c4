#include "fit/camera_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/fitted_clips.h"

namespace mimicx::fit {
namespace {

using namespace test;

/// A moving camera that follows a person, with a tremor of an angle in degrees and of 50 mm per degree.
PerFrame<Eigen::Matrix4d> carried(int frames, double degrees) {
  Random random(3, {1});
  PerFrame<Eigen::Matrix4d> path;
  for (int t = 0; t < frames; ++t) {
    const Vector3d eye(0.02 * t, 4.0 + 0.1 * std::sin(0.1 * t), 1.4);
    const Matrix3d pan = Eigen::AngleAxisd(0.01 * t + 0.1 * std::sin(0.15 * t), Vector3d::UnitY()).matrix();
    const Vector3d shake = degrees * kDegree * random_vector(random);
    const Vector3d moved = eye + 0.05 * degrees * random_vector(random);
    Eigen::Matrix4d E = Eigen::Matrix4d::Identity();
    E.topLeftCorner<3, 3>() = exp_map(shake).toRotationMatrix() * pan;
    E.topRightCorner<3, 1>() = -E.topLeftCorner<3, 3>() * moved;
    path.push_back(E);
  }
  return path;
}

double distance(const PerFrame<Eigen::Matrix4d>& a, const PerFrame<Eigen::Matrix4d>& b) {
  double sum = 0.0;
  for (int t = 0; t < a.count(); ++t) sum += (a[t] - b[t]).squaredNorm();
  return std::sqrt(sum / a.count());
}

TEST(CameraSmoothing, SteadyPathStaysBitIdentical) {
  for (const int frames : {1, 2, 3, 200})
    EXPECT_EQ(smoothed_path(carried(frames, 0.0), 30.0), carried(frames, 0.0));
}

TEST(CameraSmoothing, MeasuresJitterAndRemovesAThirdOfTheErrorDespiteSway) {
  const PerFrame<Eigen::Matrix4d> truth = carried(300, 0.0), told = carried(300, 0.3);
  EXPECT_NEAR(jitter_of_camera(told).turn, 0.3 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(jitter_of_camera(told).place, 0.015, 0.004);
  EXPECT_LT(distance(smoothed_path(told, 30.0), truth), 0.67 * distance(told, truth));
}

TEST(CameraSmoothing, TremblingCameraDoesNotShrinkTheWorld) {
  const motion::Clip truth = truth_of("walk");
  const motion::Clip still = noisy_of(truth, "gvhmr", motion::KeypointSet::kJoints22, 3);
  motion::Clip trembling = still;
  Random random(4, {1});
  const Eigen::Matrix4d E = still.keypoints->extrinsics[0];
  trembling.keypoints->extrinsics.clear();
  for (int t = 0; t < truth.frames(); ++t) {
    Eigen::Matrix4d shaken = E;
    shaken.topLeftCorner<3, 3>() =
        exp_map(0.2 * kDegree * random_vector(random)).toRotationMatrix() * E.topLeftCorner<3, 3>();
    shaken.topRightCorner<3, 1>() += 0.01 * random_vector(random);
    trembling.keypoints->extrinsics.push_back(shaken);
  }
  FitReport report;
  const motion::Clip fitted = fit_keypoints(trembling, {}, &report);
  EXPECT_LT(against(truth, fitted).mpjpe.value,
            1.5 * against(truth, fit_keypoints(still, {}, nullptr)).mpjpe.value);
  EXPECT_NEAR(report.focal_scale, 1.0, 0.02);
  EXPECT_EQ(report.notes.size(), 1u);
}

}  // namespace
}  // namespace mimicx::fit
