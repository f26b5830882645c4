#include "synth/noise/keypoint_noise.h"

#include <gtest/gtest.h>

#include <map>

#include "core/decompositions.h"
#include "motion/metrics.h"
#include "synth/noise/noise_fixtures.h"
#include "synth/noise/occlusion.h"

namespace mimicx::synth {
namespace {

using test::only;
using Term = double NoisePreset::*;

/// Detections of a clip with an exact camera, and their true positions.
struct Detected {
  motion::Keypoints keypoints;
  PerFrame<BodyPoses> poses;

  /// Error of a detection in parts of the box.
  Eigen::Vector2d error(int t, int body) const {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
    for (const Vector3d& joint : poses[t].p_WB) {
      low = low.cwiseMin(test::pinhole(keypoints, t, joint));
      high = high.cwiseMax(test::pinhole(keypoints, t, joint));
    }
    const Eigen::Vector2d off = keypoints.uvc[t][static_cast<std::size_t>(body)].head<2>() -
                                test::pinhole(keypoints, t, poses[t].p_WB[body]);
    return off / (high - low).maxCoeff();
  }
};

Detected detected(const motion::Clip& truth, const NoiseConfig& config) {
  return {*add_noise(truth, config).keypoints, test::poses_of_clip(truth)};
}

TEST(DetectKeypoints, WithoutErrorsAreThePinholeImagesOfTheJoints) {
  const Detected d = detected(test::truth_of("dance"), only(nullptr, 0.0, 2));
  for (int t = 0; t < d.poses.count(); ++t)
    for (int b = 0; b < kBodies; ++b) {
      EXPECT_LT(d.error(t, b).norm(), 1e-9);
      EXPECT_EQ(d.keypoints.uvc[t][static_cast<std::size_t>(b)].z(), 0.8);
    }
}

TEST(DetectKeypoints, OffsetsAreConstantInTheFrameOfTheirLimbAndTurnInThePicture) {
  test::Spread size;
  double turned = 0.0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Detected d = detected(test::truth_of("turn_in_place"), only(&NoisePreset::offset_limb, 0.02, seed));
    for (int b = 0; b < kBodies; ++b) {
      // (K row − u · last row) (R (p + q o) + t) = 0 is linear in o.
      Eigen::MatrixX3d A(2 * d.poses.count(), 3);
      Eigen::VectorXd right(2 * d.poses.count());
      const Eigen::Matrix4d& E = d.keypoints.extrinsics[0];
      for (int t = 0; t < d.poses.count(); ++t)
        for (int row = 0; row < 2; ++row) {
          const Eigen::RowVector3d line =
              d.keypoints.intrinsics.row(row) -
              d.keypoints.uvc[t][static_cast<std::size_t>(b)][row] * d.keypoints.intrinsics.row(2);
          A.row(2 * t + row) = line * E.block<3, 3>(0, 0) * d.poses[t].q_WB[b].toRotationMatrix();
          right[2 * t + row] = -line * (E * d.poses[t].p_WB[b].homogeneous()).head<3>();
        }
      const Vector3d o = Matrix3d(A.transpose() * A).inverse() * (A.transpose() * right);
      EXPECT_LT((A * o - right).norm(), 1e-6);
      for (int axis = 0; axis < 3; ++axis) size.add(o[axis]);
      turned = std::max(turned, (d.error(0, b) - d.error(d.poses.count() - 1, b)).norm());
    }
  }
  EXPECT_NEAR(size.rms(), 0.02, 0.001);
  EXPECT_GT(turned, 0.01);
}

TEST(DetectKeypoints, OffsetsThatFollowTheViewAreALinearMapOfItsDirectionInTheLimb) {
  const motion::Clip still = test::beginning_of("stand", 10);
  test::Spread size;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Detected d = detected(still, only(&NoisePreset::offset_view, 0.02, seed));
    const Vector3d eye = test::camera_position(d.keypoints);
    for (int b = 0; b < kBodies; ++b) {  // across the picture: metres at the joint's depth
      const Vector3d p_C = (d.keypoints.extrinsics[0] * d.poses[9].p_WB[b].homogeneous()).head<3>();
      const Eigen::Vector2d off = d.keypoints.uvc[9][static_cast<std::size_t>(b)].head<2>() -
                                  test::pinhole(d.keypoints, 9, d.poses[9].p_WB[b]);
      size.add(off.y() * p_C.z() / d.keypoints.intrinsics(1, 1));
    }
    EXPECT_GT(eye.z(), 1.0);
  }
  EXPECT_NEAR(size.rms(), 0.02, 0.0012);  // |v| = 1: every component of A v has the σ of A's entries

  // One A explains a whole turn of the body: nine unknowns, two equations per frame.
  const Detected d = detected(test::truth_of("turn_in_place"), only(&NoisePreset::offset_view, 0.02, 1));
  const Vector3d eye = test::camera_position(d.keypoints);
  Eigen::Matrix<double, Eigen::Dynamic, 9> lhs(2 * d.poses.count(), 9);
  Eigen::VectorXd right(2 * d.poses.count());
  for (int t = 0; t < d.poses.count(); ++t) {
    const Matrix3d R = d.poses[t].q_WB[kLeftWrist].toRotationMatrix();
    const Vector3d v = R.transpose() * (eye - d.poses[t].p_WB[kLeftWrist]).normalized();
    for (int row = 0; row < 2; ++row) {
      const Eigen::RowVector3d line = d.keypoints.intrinsics.row(row) -
                                      d.keypoints.uvc[t][kLeftWrist][row] * d.keypoints.intrinsics.row(2);
      const Eigen::RowVector3d by_offset = line * d.keypoints.extrinsics[0].block<3, 3>(0, 0) * R;
      for (int k = 0; k < 3; ++k) lhs.block<1, 3>(2 * t + row, 3 * k) = v[k] * by_offset;
      right[2 * t + row] =
          -line * (d.keypoints.extrinsics[0] * d.poses[t].p_WB[kLeftWrist].homogeneous()).head<3>();
    }
  }
  EXPECT_LT((lhs * solve_symmetric(lhs.transpose() * lhs, lhs.transpose() * right) - right).norm(), 1e-6);
}

TEST(DetectKeypoints, WanderingAndTailsHaveTheirSizes) {
  const motion::Clip still = test::beginning_of("stand", 22);
  test::Spread wander;
  std::vector<double> tail;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const Detected slow = detected(still, only(&NoisePreset::wander, 0.5, seed)),
                   quick = detected(still, only(&NoisePreset::tail, 0.5, seed));
    for (int b = 0; b < kBodies; ++b) {
      wander.add(100.0 * slow.error(20, b).x());
      tail.push_back(100.0 * std::abs(quick.error(20, b).y()));
      EXPECT_LT((slow.error(21, b) - slow.error(20, b)).norm(), 0.005);
    }
  }
  EXPECT_NEAR(wander.rms(), 0.5, 0.03);
  EXPECT_NEAR(test::share_below(tail, 0.5), 0.5 * 0.7649, 0.03);  // Student's t with 3 degrees of freedom
  EXPECT_NEAR(test::share_below(tail, 0.99), 0.5 * 5.841, 0.7);   // a normal error: 1.3
}

TEST(DetectKeypoints, ErrorsGrowWithForeshortening) {
  const motion::Clip& truth = test::truth_of("punch");
  NoiseConfig config = only(&NoisePreset::tail, 0.5, 3);
  const Detected plain = detected(truth, config);
  config.preset.foreshortening = 2.0;
  const Detected grown = detected(truth, config);
  const Vector3d eye = test::camera_position(plain.keypoints);
  double largest = 1.0;
  for (int t = 0; t < truth.frames(); t += 3)
    for (int b = 1; b < kBodies; ++b) {
      const Vector3d bone = plain.poses[t].p_WB[b] - plain.poses[t].p_WB[kParents[b]],
                     ray = (plain.poses[t].p_WB[b] - eye).normalized();
      const double factor = 1.0 + 2.0 * (1.0 - bone.cross(ray).norm() / bone.norm());
      EXPECT_LT((grown.error(t, b) - factor * plain.error(t, b)).norm(), 1e-9);
      largest = std::max(largest, factor);
    }
  EXPECT_GT(largest, 2.0);
}

TEST(DetectKeypoints, OcclusionErrorsOnlyAffectHiddenPoints) {
  const motion::Clip& truth = test::truth_of("walk");
  const Character character = make_character(truth.betas);
  test::Spread size;
  int hidden = 0, seen = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Detected d = detected(truth, only(&NoisePreset::occlusion, 2.0, seed));
    const Vector3d eye = test::camera_position(d.keypoints);
    for (int t = 0; t < truth.frames(); t += 9)
      for (int b = 0; b < kBodies; ++b) {
        const bool behind = is_hidden(character, d.poses[t], eye, d.poses[t].p_WB[b]);
        EXPECT_EQ(d.error(t, b).norm() > 1e-9, behind);
        if (behind) size.add(100.0 * d.error(t, b).x());
        ++(behind ? hidden : seen);
      }
  }
  EXPECT_GT(hidden, 200);
  EXPECT_GT(seen, 2 * hidden);
  EXPECT_NEAR(size.rms(), 2.0, 0.25);
}

TEST(DetectKeypoints, AreLateOrEarlyByAFractionOfAFrame) {
  // A body that glides: the position of a detection shows its time.
  motion::Clip glide = test::beginning_of("stand", 22);
  for (int t = 0; t < glide.frames(); ++t) {
    glide.rotations[t] = glide.rotations[0];
    glide.trans[t] = glide.trans[0] + Vector3d(0.01 * t, 0.0, 0.0);
  }
  test::Spread late;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Detected d = detected(glide, only(&NoisePreset::time_offset, 0.5, seed));
    const auto seen_at = [&](double frame) {
      const Vector3d joint = d.poses[0].p_WB[kHead] + Vector3d(0.01 * frame, 0.0, 0.0);
      return test::pinhole(d.keypoints, 0, joint);
    };
    const Eigen::Vector2d uv = d.keypoints.uvc[20][kHead].head<2>(),
                          per_frame = seen_at(20.5) - seen_at(19.5);
    if (per_frame.norm() < 0.3) continue;  // it glides along the ray
    double frame = 20.0;
    for (int step = 0; step < 5; ++step)
      frame += (uv - seen_at(frame)).dot(per_frame) / per_frame.squaredNorm();
    EXPECT_LT((uv - seen_at(frame)).norm(), 1e-6);
    late.add(20.0 - frame);
  }
  EXPECT_GT(late.count, 300);
  EXPECT_NEAR(late.rms(), 0.5, 0.05);
}

TEST(DetectKeypoints, WholeLimbsSwapSidesAtTheStatedRate) {
  const motion::Clip& truth = test::truth_of("squat");
  int swapped = 0, frames = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Detected plain = detected(truth, only(nullptr, 0.0, seed)),
                   mixed = detected(truth, only(&NoisePreset::swap_rate, 0.5, seed));
    for (int t = 0; t < truth.frames(); ++t, ++frames) {
      bool any = false;
      for (std::size_t b = 0; b < kBodies; ++b) {
        std::string name(kBodyNames[b]);
        const std::size_t side = name.find("left_") == 0 ? 5 : name.find("right_") == 0 ? 6 : 0;
        const int other = side == 0 ? static_cast<int>(b)
                                    : body_of_name((side == 5 ? "right_" : "left_") + name.substr(side));
        const bool stays = mixed.keypoints.uvc[t][b] == plain.keypoints.uvc[t][b];
        EXPECT_TRUE(stays ||
                    mixed.keypoints.uvc[t][b] == plain.keypoints.uvc[t][static_cast<std::size_t>(other)]);
        any = any || !stays;
      }
      swapped += any ? 1 : 0;
    }
  }
  // Swaps of 7 frames on average that begin 0.5 times a second; some overlap or are cut at the end.
  EXPECT_NEAR(static_cast<double>(swapped) / frames, 0.5 * 7.0 / 30.0, 0.02);
}

TEST(DetectKeypoints, FramesAndDetectionsAreMissingAtTheStatedRates) {
  const motion::Clip& truth = test::truth_of("squat");
  int empty = 0, missing = 0, frames = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Detected gaps = detected(truth, only(&NoisePreset::gap_rate, 0.5, seed)),
                   drops = detected(truth, only(&NoisePreset::drop_share, 0.1, seed));
    for (int t = 0; t < truth.frames(); ++t, ++frames) {
      int gone = 0;
      for (std::size_t b = 0; b < kBodies; ++b) {
        gone += gaps.keypoints.uvc[t][b] == Vector3d::Zero() ? 1 : 0;
        missing += drops.keypoints.uvc[t][b] == Vector3d::Zero() ? 1 : 0;
      }
      EXPECT_TRUE(gone == 0 || gone == kBodies);
      empty += gone == kBodies ? 1 : 0;
    }
  }
  EXPECT_NEAR(static_cast<double>(empty) / frames, 0.5 * 5.0 / 30.0, 0.015);
  EXPECT_NEAR(static_cast<double>(missing) / (frames * kBodies), 0.1, 0.003);
}

TEST(DetectKeypoints, ConfidenceCorrelatesWeaklyWithTheError) {
  NoiseConfig config;
  config.camera = camera_error("calibrated");
  double c = 0, e = 0, cc = 0, ee = 0, ce = 0, n = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    config.seed = seed;
    const Detected d = detected(test::truth_of("walk"), config);
    for (int t = 0; t < d.poses.count(); t += 5)
      for (int b = 0; b < kBodies; ++b) {
        const double confidence = d.keypoints.uvc[t][static_cast<std::size_t>(b)].z();
        const double error = std::log(d.error(t, b).norm());
        if (confidence == 0.0 || error > std::log(0.1)) continue;  // missing or mixed up
        c += confidence, e += error, cc += confidence * confidence, ee += error * error,
            ce += confidence * error;
        n += 1.0;
      }
  }
  const double correlation =
      (ce / n - c / n * e / n) / std::sqrt((cc / n - c / n * c / n) * (ee / n - e / n * e / n));
  EXPECT_LT(correlation, -0.05);
  EXPECT_GT(correlation, -0.4);
  EXPECT_NEAR(std::sqrt(cc / n - c / n * c / n), config.preset.confidence_spread, 0.03);
}

TEST(DetectKeypoints, AreCocoPointsOnRequest) {
  const std::vector<std::string> coco = {
      "nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
      "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
      "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle"};
  NoiseConfig config = only(nullptr, 0.0, 1);
  config.keypoints = motion::KeypointSet::kCoco17;
  const Detected d = detected(test::truth_of("wave"), config);
  ASSERT_EQ(d.keypoints.names, coco);
  for (std::size_t k = 0; k < coco.size(); ++k) {
    const int body = body_of_name(coco[k]);
    const Eigen::Vector2d off = d.keypoints.uvc[9][k].head<2>() -
                                test::pinhole(d.keypoints, 9, d.poses[9].p_WB[body < 0 ? kHead : body]);
    EXPECT_LT(off.norm(), body < 0 ? 45.0 : 1e-6) << coco[k];  // the face: near the head
  }
}

TEST(DetectKeypoints, WholeBodyPointsLieOnTheBodyPartTheyName) {
  NoiseConfig config = only(nullptr, 0.0, 7);
  config.keypoints = motion::KeypointSet::kCoco133;
  const auto& [k, poses] = detected(test::truth_of("wave"), config);
  const Camera camera = place_camera(poses, 7);
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
    if (part == parts.end()) continue;
    const double metre = camera.intrinsics(0, 0) / project(camera, poses[40].p_WB[part->second]).z();
    EXPECT_LT((k.uvc[40][i] - project(camera, poses[40].p_WB[part->second])).head<2>().norm(), 0.25 * metre)
        << k.names[i];
  }
}

}  // namespace
}  // namespace mimicx::synth
