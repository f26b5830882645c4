#include "synth/noise/hand_held_camera.h"

#include <gtest/gtest.h>

#include "synth/noise/noise_fixtures.h"
#include "synth/noise/noise_model.h"

namespace mimicx::synth {
namespace {

/// A carried camera without errors.
CameraError exact_moving() {
  CameraError error;
  error.moving = true;
  return error;
}

TEST(Project, IsThePinholeCamera) {
  Camera camera;
  camera.intrinsics << 1000.0, 0.0, 960.0, 0.0, 900.0, 540.0, 0.0, 0.0, 1.0;
  camera.extrinsics.block<3, 3>(0, 0) << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // looks along world y
  camera.extrinsics.block<3, 1>(0, 3) = Vector3d(0.0, 1.5, 4.0);      // from (0, -4, 1.5)
  const Vector3d seen = project(camera, {0.5, 1.0, 2.5});
  EXPECT_NEAR(seen.x(), 960.0 + 1000.0 * 0.5 / 5.0, 1e-9);
  EXPECT_NEAR(seen.y(), 540.0 - 900.0 * 1.0 / 5.0, 1e-9);
  EXPECT_NEAR(seen.z(), 5.0, 1e-12);
}

TEST(PlaceCamera, SeesTheWholeMotionFromAPersonsHeight) {
  for (const std::string& kind : basic_kinds())
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const PerFrame<BodyPoses> poses = test::poses_of_clip(test::truth_of(kind));
      const Camera camera = place_camera(poses, seed);
      motion::Keypoints k;
      k.extrinsics = {camera.extrinsics};
      EXPECT_TRUE((camera.extrinsics.block<3, 3>(0, 0).isUnitary(1e-12)));
      EXPECT_NEAR(camera.extrinsics(0, 2), 0.0, 1e-12);  // the horizon is level
      EXPECT_GT(-camera.extrinsics(1, 2), 0.8);          // and up is up
      const Vector3d eye = test::camera_position(k);
      EXPECT_TRUE(eye.z() >= 1.2 && eye.z() <= 1.8);
      const double distance = (eye - poses[poses.size() / 2].p_WB[0]).head<2>().norm();
      EXPECT_TRUE(distance > 3.0 && distance < 9.0) << kind << " " << distance;
      for (const BodyPoses& pose : poses)
        for (const Vector3d& joint : pose.p_WB) {
          const Vector3d uv = project(camera, joint);
          ASSERT_TRUE(uv.x() > 96.0 && uv.x() < 1824.0 && uv.y() > 54.0 && uv.y() < 1026.0);
        }
    }
}

TEST(ErroneousCamera, ErrsInFocalLengthAndTilt) {
  const motion::Clip& truth = test::still_truth();
  const std::map<std::string, std::array<double, 2>> sigmas = {
      {"calibrated", {0.0, 0.0}}, {"perturbed", {0.01, 0.3}}, {"wild", {0.05, 0.7}}};
  for (const auto& [name, sigma] : sigmas) {
    test::Spread focal, tilt;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      NoiseConfig config = test::only(nullptr, 0.0, seed);
      const motion::Keypoints exact = *add_noise(truth, config).keypoints;
      config.camera = camera_error(name);
      const motion::Clip noisy = add_noise(truth, config);
      const motion::Keypoints& told = *noisy.keypoints;
      EXPECT_TRUE(told.uvc == exact.uvc);  // detections do not depend on the camera's errors
      EXPECT_LT((test::camera_position(told) - test::camera_position(exact)).norm(), 1e-9);
      focal.add(told.intrinsics(0, 0) / exact.intrinsics(0, 0) - 1.0);
      const Matrix3d turn =
          told.extrinsics[0].block<3, 3>(0, 0) * exact.extrinsics[0].block<3, 3>(0, 0).transpose();
      EXPECT_NEAR(turn(0, 0), 1.0, 1e-12);
      tilt.add(std::atan2(turn(2, 1), turn(1, 1)) / kDegree);
    }
    EXPECT_NEAR(focal.rms(), sigma[0], 0.12 * sigma[0] + 1e-12) << name;
    EXPECT_NEAR(tilt.rms(), sigma[1], 0.12 * sigma[1] + 1e-9) << name;
  }
}

TEST(CarriedCamera, ProjectsTrueJointsByThePinholeOfEachFrame) {
  for (const char* kind : {"walk", "dance"}) {
    const motion::Clip& truth = test::truth_of(kind);
    const PerFrame<BodyPoses> poses = test::poses_of_clip(truth);
    NoiseConfig config = test::only(nullptr, 0.0, 4);
    config.camera = exact_moving();
    const motion::Clip noisy = add_noise(truth, config);
    const motion::Keypoints& k = *noisy.keypoints;
    ASSERT_EQ(k.extrinsics.count(), truth.frames());
    for (int t = 0; t < truth.frames(); ++t)
      for (int b = 0; b < kBodies; ++b)
        EXPECT_LT((k.uvc[t][b].head<2>() - test::pinhole(k, t, poses[t].p_WB[b])).norm(), 1e-6);
  }
}

TEST(CarriedCamera, DetectionsUseTheCameraOfTheirFrame) {
  const motion::Clip& truth = test::truth_of("walk");
  const PerFrame<BodyPoses> poses = test::poses_of_clip(truth);
  NoiseConfig config;
  config.seed = 4;
  config.camera = exact_moving();
  const motion::Keypoints k = *add_noise(truth, config).keypoints;
  int near = 0, far = 0;  // swapped ones are far
  for (int t = 0; t < truth.frames(); ++t)
    for (int b = 0; b < kBodies; ++b) {
      if (k.uvc[t][b].z() == 0.0) continue;
      ++((k.uvc[t][b].head<2>() - test::pinhole(k, t, poses[t].p_WB[b])).norm() < 40.0 ? near : far);
    }
  EXPECT_GT(near, 20 * far);
}

TEST(CarriedCamera, KeepsThePersonInThePicture) {
  for (const char* kind : {"walk", "jog", "kick"})
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const PerFrame<BodyPoses> poses = test::poses_of_clip(test::truth_of(kind));
      const CameraPath camera = carry_camera(poses, seed, 30.0);
      for (int t = 0; t < poses.count(); ++t) {
        EXPECT_TRUE((camera.extrinsics[t].block<3, 3>(0, 0).isUnitary(1e-12)));
        EXPECT_GT(-camera.extrinsics[t](1, 2), 0.8);  // up is up
        for (const Vector3d& joint : poses[t].p_WB) {
          const Vector3d uv = project(camera.at(t), joint);
          ASSERT_TRUE(uv.x() > 96.0 && uv.x() < 1824.0 && uv.y() > 54.0 && uv.y() < 1026.0);
        }
      }
      for (int t = 1; t < poses.count(); ++t) {  // hands, not teleports
        EXPECT_LT((motion::eye_of(camera.extrinsics[t]) - motion::eye_of(camera.extrinsics[t - 1])).norm(),
                  0.05);
        EXPECT_NE(camera.extrinsics[t], camera.extrinsics[t - 1]);
      }
    }
}

TEST(CarriedCamera, GivenPathDriftsWithTheRootOfTime) {
  const PerFrame<BodyPoses> poses = test::poses_of_clip(test::truth_of("walk"));
  const int last = poses.count() - 1;
  const double seconds = last / 30.0, tau = 0.5;
  CameraError error = exact_moving();
  error.turn_drift = 0.4, error.place_drift = 0.02;
  test::Spread turn, place;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const CameraPath camera = carry_camera(poses, seed, 30.0),
                     told = erroneous_camera(camera, error, seed, 30.0);
    EXPECT_TRUE(told.extrinsics[0].isApprox(camera.extrinsics[0], 1e-12));
    const Matrix3d off =
        told.extrinsics[last].block<3, 3>(0, 0) * camera.extrinsics[last].block<3, 3>(0, 0).transpose();
    const Vector3d turned = log_map(Quaterniond(off)) / kDegree,
                   moved = motion::eye_of(told.extrinsics[last]) - motion::eye_of(camera.extrinsics[last]);
    for (int axis = 0; axis < 3; ++axis) turn.add(turned[axis]), place.add(moved[axis]);
  }
  // Variance of the integral of a process with autocorrelation exp(−Δ²/4τ²) / (2√π τ).
  const double variance =
      seconds * std::erf(seconds / (2.0 * tau)) -
      2.0 * tau / std::sqrt(M_PI) * (1.0 - std::exp(-seconds * seconds / (4.0 * tau * tau)));
  EXPECT_NEAR(turn.rms(), 0.4 * std::sqrt(variance), 0.04 * std::sqrt(variance));
  EXPECT_NEAR(place.rms(), 0.02 * std::sqrt(variance), 0.002 * std::sqrt(variance));
}

}  // namespace
}  // namespace mimicx::synth
