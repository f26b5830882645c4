#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "synth/noise/noise_fixtures.h"

namespace mimicx::synth {
namespace {

using namespace test;

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

TEST(AddNoise, AddsErrorsToCameraAndShape) {
  const motion::Clip& truth = test::still_truth();
  const std::map<std::string, std::array<double, 3>> sigmas = {
      {"calibrated", {0.0, 0.0, 0.0}}, {"perturbed", {0.01, 0.3, 0.15}}, {"wild", {0.05, 0.7, 0.3}}};
  for (const auto& [name, sigma] : sigmas) {
    test::Spread focal, tilt, beta;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      NoiseConfig config = test::silent(seed);
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
      tilt.add(std::atan2(turn(2, 1), turn(1, 1)) / test::kDegree);
      for (std::size_t k = 0; k < kBetas; ++k) beta.add(noisy.betas[k] - truth.betas[k]);
    }
    EXPECT_NEAR(focal.rms(), sigma[0], 0.12 * sigma[0] + 1e-12) << name;
    EXPECT_NEAR(tilt.rms(), sigma[1], 0.12 * sigma[1] + 1e-9) << name;
    EXPECT_NEAR(beta.rms(), sigma[2], 0.05 * sigma[2]) << name;
  }
}

/// Errors of the detections of a clip in units of the person's box, with the camera known exactly.
struct Detection {
  double u, v, confidence;
};
PerFrame<PerBody<Detection>> detections(const PerFrame<BodyPoses>& poses, std::uint64_t seed,
                                        const std::vector<Burst>& bursts) {
  const Camera camera = place_camera(poses, seed);
  const motion::Keypoints k =
      detect_keypoints(poses, camera, motion::KeypointSet::kJoints22, bursts, seed, 30.0);
  PerFrame<PerBody<Detection>> errors(poses.size());
  for (std::size_t t = 0; t < poses.size(); ++t) {
    double low_u = 1e9, high_u = -1e9, low_v = 1e9, high_v = -1e9;
    for (const Vector3d& joint : poses[t].p_WB) {
      const Vector3d uv = project(camera, joint);
      low_u = std::min(low_u, uv.x()), high_u = std::max(high_u, uv.x());
      low_v = std::min(low_v, uv.y()), high_v = std::max(high_v, uv.y());
    }
    const double box = std::max(high_u - low_u, high_v - low_v);
    for (std::size_t b = 0; b < kBodies; ++b) {
      const Vector3d uv = project(camera, poses[t].p_WB[b]);
      errors[t][b] = {(k.uvc[t][b].x() - uv.x()) / box, (k.uvc[t][b].y() - uv.y()) / box, k.uvc[t][b].z()};
    }
  }
  return errors;
}

TEST(DetectKeypoints, HasABiasPerClipSmallNoiseAndDropouts) {
  const PerFrame<BodyPoses> poses = test::poses_of_clip(test::still_truth());
  test::Spread bias, quick, quick_wrist, confidence;
  int dropped = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const auto errors = detections(poses, seed, {});
    for (std::size_t b = 0; b < kBodies; ++b) {
      for (std::size_t t = 0; t < poses.size(); ++t, ++all)
        if (errors[t][b].confidence == 0.0) ++dropped;
      if (errors[9][b].confidence == 0.0 || errors[10][b].confidence == 0.0) continue;
      if (std::abs(errors[10][b].u - errors[9][b].u) > 0.03 || std::abs(errors[10][b].u) > 0.05)
        continue;  // swapped
      bias.add(errors[10][b].u);
      confidence.add(errors[10][b].confidence);
      (b == kLeftWrist || b == kRightWrist ? quick_wrist : quick).add(errors[10][b].v - errors[9][b].v);
    }
  }
  // Of two successive frames the correlated part (ρ = .6) keeps 2σ²(1 − ρ), the white part 2σ².
  const double step = std::sqrt(2.0 * 0.4 * 0.001 * 0.001 + 2.0 * 0.0005 * 0.0005);
  EXPECT_NEAR(bias.rms(), 0.0071, 0.0004);
  EXPECT_NEAR(quick.rms(), step, 0.05 * step);
  EXPECT_NEAR(quick_wrist.rms(), 3.0 * step, 0.4 * step);
  EXPECT_NEAR(confidence.mean(), 0.93, 0.005);
  EXPECT_NEAR(static_cast<double>(dropped) / all, 0.02, 0.001);
}

TEST(DetectKeypoints, LowersConfidenceDuringABurst) {
  const PerFrame<BodyPoses> poses = test::poses_of_clip(test::truth_of("stand"));
  const std::vector<Burst> bursts = {{kLeftShoulder, 20, 30, Vector3d::Zero()}};
  test::Spread hidden;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto clear = detections(poses, seed, {}), burst = detections(poses, seed, bursts);
    for (std::size_t t = 0; t < poses.size(); ++t)
      for (int body : {kLeftShoulder, kLeftElbow, kLeftWrist, kRightElbow, kLeftKnee, kHead}) {
        const Detection &a = burst[t][body], &b = clear[t][body];
        const bool covered =
            t >= 20 && t < 50 && (body == kLeftShoulder || body == kLeftElbow || body == kLeftWrist);
        if (a.confidence == 0.0) continue;
        if (covered && a.confidence < 0.7) {
          EXPECT_TRUE(a.confidence >= 0.2 && a.confidence <= 0.6);
          hidden.add(a.u - b.u);
        } else if (!covered && a.confidence > 0.7) {
          EXPECT_EQ(a.u, b.u);
        }
      }
  }
  EXPECT_GT(hidden.count, 40 * 30 * 2);
  EXPECT_NEAR(hidden.rms(), 0.02, 0.001);
}

TEST(DetectKeypoints, SwapsLeftAndRightAtItsRate) {
  // A line-up of the sides would hide swaps; frames where the left wrist is nearer to the right one's place
  // than to its own count.
  const PerFrame<BodyPoses> poses = test::poses_of_clip(test::truth_of("squat"));
  int swapped_arms = 0, frames = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Camera camera = place_camera(poses, seed);
    const motion::Keypoints k =
        detect_keypoints(poses, camera, motion::KeypointSet::kJoints22, {}, seed, 30.0);
    const auto distance = [&](std::size_t t, std::size_t detection, int truth) {
      const Vector3d uv = project(camera, poses[t].p_WB[truth]);
      return (k.uvc[t][detection] - uv).head<2>().norm();
    };
    // Seen from the side the shoulders coincide: no verdict.
    if (std::abs(project(camera, poses[0].p_WB[kLeftShoulder]).x() -
                 project(camera, poses[0].p_WB[kRightShoulder]).x()) < 30.0)
      continue;
    for (std::size_t t = 0; t < poses.size(); ++t) {
      if (k.uvc[t][kLeftShoulder].z() == 0.0) continue;
      ++frames;
      if (distance(t, kLeftShoulder, kRightShoulder) < distance(t, kLeftShoulder, kLeftShoulder))
        ++swapped_arms;
    }
  }
  // 0.05 /s, 6.5 frames on average, half of them arms: 0.05 · 6.5/30 / 2 of all frames.
  EXPECT_NEAR(static_cast<double>(swapped_arms) / frames, 0.05 * 6.5 / 30.0 / 2.0, 0.0018);
}

TEST(DetectKeypoints, NamesTheCoco17PointsAndPutsThemOnTheSameJoints) {
  const std::vector<std::string> names = motion::keypoint_names(motion::KeypointSet::kCoco17);
  const std::vector<std::string> coco = {
      "nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
      "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
      "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle"};
  EXPECT_EQ(names, coco);
  const PerFrame<BodyPoses> poses = test::poses_of_clip(test::truth_of("wave"));
  const Camera camera = place_camera(poses, 7);
  const motion::Keypoints k = detect_keypoints(poses, camera, motion::KeypointSet::kCoco17, {}, 7, 30.0);
  EXPECT_EQ(k.names, coco);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int found = body_of_name(names[i]), body = found < 0 ? kHead : found;  // face points: the head's
    if (k.uvc[40][i].z() == 0.0) continue;
    EXPECT_LT((k.uvc[40][i] - project(camera, poses[40].p_WB[body])).head<2>().norm(), 45.0) << names[i];
  }
  EXPECT_EQ(motion::keypoint_names(motion::KeypointSet::kJoints22)[kLeftFoot], "left_foot");
}

TEST(DetectKeypoints, WholeBodyPointsLieOnTheBodyPartTheyName) {
  const PerFrame<BodyPoses> poses = test::poses_of_clip(test::truth_of("wave"));
  const Camera camera = place_camera(poses, 7);
  const motion::Keypoints k = detect_keypoints(poses, camera, motion::KeypointSet::kCoco133, {}, 7, 30.0);
  ASSERT_EQ(k.names.size(), 133u);
  const std::map<std::string, int> parts = {{"left_heel", kLeftAnkle},
                                            {"right_heel", kRightAnkle},
                                            {"left_big_toe", kLeftFoot},
                                            {"right_small_toe", kRightFoot},
                                            {"left_forefinger4", kLeftWrist},
                                            {"right_thumb1", kRightWrist},
                                            {"face-30", kHead}};
  for (std::size_t i = 0; i < k.names.size(); ++i) {
    const auto part = parts.find(k.names[i]);
    if (part == parts.end() || k.uvc[40][i].z() == 0.0) continue;
    const double metre = camera.intrinsics(0, 0) / project(camera, poses[40].p_WB[part->second]).z();
    EXPECT_LT((k.uvc[40][i] - project(camera, poses[40].p_WB[part->second])).head<2>().norm(), 0.25 * metre)
        << k.names[i];
  }
}

}  // namespace
}  // namespace mimicx::synth
