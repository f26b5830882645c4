#include "synth/noise/estimator_noise.h"

#include <gtest/gtest.h>

#include "motion/metrics.h"
#include "motion/prepare/feet.h"
#include "motion/surface_points.h"
#include "synth/noise/foot_skate.h"
#include "synth/noise/noise_fixtures.h"

namespace mimicx::synth {
namespace {

using Term = double NoisePreset::*;
using test::only;

constexpr double kMedianOfT4 = 0.7407 / M_SQRT2,
                 kFarOfT4 = 4.6041 / M_SQRT2;  // 50 % and 99 % of |t| at unit σ

TEST(AddNoise, WithoutErrorsReturnsTheTruth) {
  const motion::Clip& truth = test::truth_of("walk");
  const motion::Clip clip = add_noise(truth, only(nullptr, 0.0, 1));
  EXPECT_EQ(clip.betas, truth.betas);
  for (int t = 0; t < truth.frames(); ++t) {
    EXPECT_LT((clip.trans[t] - truth.trans[t]).norm(), 1e-12);
    for (int b = 0; b < kBodies; ++b) EXPECT_LT(test::joint_error(truth, clip, t, b).norm(), 1e-6);
  }
}

TEST(AddNoise, IsByteIdenticalForEqualSeedsOnly) {
  NoiseConfig config;
  config.seed = 4;
  const motion::Clip& truth = test::truth_of("wave");
  const motion::Clip a = add_noise(truth, config), b = add_noise(truth, config);
  EXPECT_TRUE(a.rotations == b.rotations && a.trans == b.trans && a.betas == b.betas);
  EXPECT_TRUE(a.keypoints->uvc == b.keypoints->uvc && a.keypoints->extrinsics == b.keypoints->extrinsics);
  config.seed = 5;
  const motion::Clip c = add_noise(truth, config);
  EXPECT_TRUE(a.rotations != c.rotations && a.keypoints->uvc != c.keypoints->uvc);
}

/// What a term of the model may change.
struct Reach {
  bool motion, betas, keypoints, camera;
};
Reach reach_of(const std::string& name) {
  if (name == "camera_turn") return {false, false, false, true};
  if (name == "stature" || name == "proportions") return {true, true, false, false};
  for (const char* seen :
       {"time_offset", "offset_limb", "offset_view", "wander", "tail", "foreshortening", "occlusion",
        "swap_rate", "gap_rate", "drop_share", "confidence_truth", "confidence_spread"})
    if (name == seen) return {false, false, true, false};
  return {true, false, false, false};
}

TEST(AddNoise, TurningATermOffChangesOnlyItsOwnQuantities) {
  const motion::Clip& truth = test::truth_of("walk");
  NoiseConfig all;
  all.preset.swap_rate = all.preset.gap_rate = 1.0;
  all.preset.snap = 0.5, all.preset.height_offset = 0.01;
  const motion::Clip full = add_noise(truth, all);
  for (const Amplitude& term : amplitudes()) {
    NoiseConfig without = all;
    without.preset.*term.value = std::max(term.least, 0.0);
    const motion::Clip clip = add_noise(truth, without);
    const Reach reach = reach_of(term.name);
    EXPECT_EQ(clip.rotations != full.rotations || clip.trans != full.trans, reach.motion) << term.name;
    EXPECT_EQ(clip.betas != full.betas, reach.betas) << term.name;
    EXPECT_EQ(clip.keypoints->uvc != full.keypoints->uvc, reach.keypoints) << term.name;
    EXPECT_EQ(clip.keypoints->extrinsics != full.keypoints->extrinsics, reach.camera) << term.name;
    EXPECT_EQ(clip.keypoints->intrinsics, full.keypoints->intrinsics);
  }
}

TEST(AddNoise, ConstantErrorsHaveTheirSizeAndHeavyTails) {
  const motion::Clip truth = test::beginning_of("stand", 12);
  const std::map<int, double> weights = {
      {kLeftHip, 0.6}, {kSpine2, 0.8}, {kRightWrist, 1.9}, {kLeftFoot, 0.3}};
  std::vector<double> joints, root;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    NoiseConfig config = only(&NoisePreset::joint_static, 2.0, seed);
    config.preset.root_static = 2.0;
    const motion::Clip noisy = add_noise(truth, config);
    const Quaterniond q = exp_map(truth.rotations[9][0]), n = exp_map(noisy.rotations[9][0]);
    for (int axis = 0; axis < 3; ++axis) {
      for (const auto& [body, weight] : weights)
        joints.push_back(std::abs(test::joint_error(truth, noisy, 9, body)[axis]) / weight);
      root.push_back(std::abs(log_map(q.conjugate() * n)[axis]) / kDegree);
    }
    EXPECT_LT((test::joint_error(truth, noisy, 11, kHead) - test::joint_error(truth, noisy, 3, kHead)).norm(),
              1e-6);
  }
  EXPECT_NEAR(test::share_below(joints, 0.5), 2.0 * kMedianOfT4, 0.06);
  EXPECT_NEAR(test::share_below(joints, 0.99), 2.0 * kFarOfT4, 0.7);  // a normal error: 5.2
  EXPECT_NEAR(test::share_below(root, 0.5), 2.0 * kMedianOfT4, 0.1);
}

TEST(AddNoise, SlowErrorsAndJitterHaveTheirSizeAndTheirPace) {
  const motion::Clip truth = test::beginning_of("stand", 31);
  const auto expect_spreads = [&](Term term, int later, double change, double tolerance) {
    test::Spread here, changes;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const motion::Clip noisy = add_noise(truth, only(term, 2.0, seed));
      for (int body : {int{kLeftShoulder}, int{kRightShoulder}})  // weight 1
        for (int axis = 0; axis < 3; ++axis) {
          const double now = test::joint_error(truth, noisy, 10, body)[axis];
          here.add(now);
          changes.add(test::joint_error(truth, noisy, 10 + later, body)[axis] - now);
        }
    }
    EXPECT_NEAR(here.rms(), 2.0, 0.15);
    EXPECT_NEAR(changes.rms(), change, tolerance);
  };
  // Var(x(t+Δ) − x(t)) = 2σ²(1 − exp(−Δ²/4τ²)), with τ = 1.2 s = 36 frames.
  expect_spreads(&NoisePreset::joint_slow, 20,
                 2.0 * std::sqrt(2.0 * (1.0 - std::exp(-400.0 / (4.0 * 36.0 * 36.0)))), 0.1);
  expect_spreads(&NoisePreset::joint_jitter, 8, 2.0 * M_SQRT2, 0.2);
}

TEST(AddNoise, JitterIsCorrelatedOverItsFrames) {
  const motion::Clip truth = test::beginning_of("stand", 12);
  for (const double frames : {0.3, 3.0}) {
    test::Spread step;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      NoiseConfig config = only(&NoisePreset::joint_jitter, 2.0, seed);
      config.preset.jitter_frames = frames;
      const motion::Clip noisy = add_noise(truth, config);
      for (int axis = 0; axis < 3; ++axis)
        step.add((test::joint_error(truth, noisy, 11, kLeftShoulder) -
                  test::joint_error(truth, noisy, 10, kLeftShoulder))[axis]);
    }
    // Var(x(t+1) − x(t)) = 2σ²(1 − ρ); below half a frame neighbours are hardly correlated.
    const double rho = frames < 1.0 ? 0.008 : std::exp(-1.0 / (4.0 * frames * frames));
    EXPECT_NEAR(step.rms(), 2.0 * std::sqrt(2.0 * (1.0 - rho)), 0.1 * 2.0 * std::sqrt(2.0 * (1.0 - rho)));
  }
}

TEST(AddNoise, SnapsTheLowestPointToItsTrueHeightAndAddsAMeanError) {
  const motion::Clip& truth = test::truth_of("squat");  // its lowest point is on the floor
  NoiseConfig config = only(&NoisePreset::joint_static, 4.0, 3);
  config.preset.stature = 0.03, config.preset.height = 0.05;
  const auto heights = [&](double snap) {
    config.preset.snap = snap;
    const motion::Clip noisy = add_noise(truth, config);
    const std::vector<motion::SurfacePoint> points = motion::surface_points(make_character(noisy.betas));
    PerFrame<double> lowest;
    for (const BodyPoses& poses : test::poses_of_clip(noisy))
      lowest.push_back(motion::lowest_height(points, poses));
    return lowest;
  };
  const PerFrame<double> free = heights(0.0), half = heights(0.5), snapped = heights(1.0);
  config.preset.height_offset = -0.02;
  const PerFrame<double> sunk = heights(1.0);
  double largest = 0.0;
  for (int t = 0; t < truth.frames(); ++t) {
    EXPECT_NEAR(snapped[t], 0.0, 1e-5);
    EXPECT_NEAR(half[t], 0.5 * (free[t] + snapped[t]), 1e-9);
    EXPECT_NEAR(sunk[t], snapped[t] - 0.02, 1e-9);
    largest = std::max(largest, std::abs(free[t]));
  }
  EXPECT_GT(largest, 0.01);
}

TEST(AddNoise, ShrinkingTakesAShareOfEveryJointsRotation) {
  const motion::Clip& truth = test::truth_of("kick");
  const motion::Clip noisy = add_noise(truth, only(&NoisePreset::joint_shrink, 0.2, 1));
  for (int t = 0; t < truth.frames(); t += 7)
    for (int b = 1; b < kBodies; ++b)
      EXPECT_LT((noisy.rotations[t][b] - 0.8 * truth.rotations[t][b]).norm(), 1e-9);
  EXPECT_LT((noisy.rotations[5][0] - truth.rotations[5][0]).norm(), 1e-9);
}

TEST(AddNoise, WobblesAreSlowAndOfTheirMeanSquare) {
  const motion::Clip truth = test::beginning_of("stand", 22);
  test::Spread place, turn;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    NoiseConfig config = only(&NoisePreset::wobble, 0.02, seed);
    config.preset.wobble_turn = 2.0;
    const motion::Clip noisy = add_noise(truth, config);
    for (int axis = 0; axis < 3; ++axis) {
      const double off = (noisy.trans[20] - truth.trans[20])[axis],
                   next = (noisy.trans[21] - truth.trans[21])[axis];
      place.add(off);
      EXPECT_LE(std::abs(off), 0.02 * M_SQRT2 + 1e-12);
      EXPECT_LE(std::abs(next - off), 0.02 * M_SQRT2 * 2.0 * M_PI * 0.7 / 30.0);  // 0.7 Hz at most
      turn.add(test::joint_error(truth, noisy, 20, kPelvis)[axis]);
    }
  }
  EXPECT_NEAR(place.rms(), 0.02, 0.001);
  EXPECT_NEAR(turn.rms(), 2.0, 0.1);
}

TEST(AddNoise, DistanceAndHeightAreConstantAndOfTheirSize) {
  const motion::Clip truth = test::beginning_of("walk", 12);
  test::Spread distance, height;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const motion::Clip far = add_noise(truth, only(&NoisePreset::depth, 0.1, seed));
    const Vector3d offset = far.trans[0] - truth.trans[0];
    const Vector3d ray =
        truth.trans[0] + mimicx::rest_pelvis("mimicx") - test::camera_position(*far.keypoints);
    EXPECT_LT(offset.cross(ray).norm(), 1e-9);
    EXPECT_LT((far.trans.back() - truth.trans.back() - offset).norm(), 1e-9);
    distance.add(offset.dot(ray) / ray.squaredNorm());
    const motion::Clip high = add_noise(truth, only(&NoisePreset::height, 0.1, seed));
    EXPECT_LT((high.trans[9] - truth.trans[9]).head<2>().norm(), 1e-12);
    height.add(high.trans[9].z() - truth.trans[9].z());
  }
  EXPECT_NEAR(distance.rms(), 0.1, 0.01);
  EXPECT_NEAR(height.rms(), 0.1, 0.01);
}

TEST(AddNoise, TravelErrsInSpeedInTheHeadingAndByAFalseVelocity) {
  const motion::Clip& walk = test::short_walk();
  const motion::Clip still = test::beginning_of("stand", 22);
  test::Spread speed, drift, heading;
  const int last = walk.frames() - 1;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const motion::Clip strides = add_noise(walk, only(&NoisePreset::stride, 0.1, seed));
    const auto step = [](const motion::Clip& clip, int t) {
      return Vector3d(clip.trans[t] - clip.trans[t - 1]);
    };
    speed.add(step(strides, 30).head<2>().norm() / step(walk, 30).head<2>().norm() - 1.0);
    const motion::Clip drifting = add_noise(still, only(&NoisePreset::drift, 0.1, seed));
    const Vector3d velocity = 30.0 * (step(drifting, 20) - step(still, 20));
    EXPECT_LT(std::abs(velocity.z()), 1e-9);
    drift.add(velocity.x()), drift.add(velocity.y());
    const motion::Clip turning = add_noise(walk, only(&NoisePreset::turn_drift, 1.0, seed));
    const Vector3d error = test::joint_error(walk, turning, last, kPelvis);
    EXPECT_LT(error.head<2>().norm(), 1e-6);
    heading.add(error.z());
    const Vector3d expected = rotation_z(kDegree * error.z()) * step(walk, last);
    EXPECT_LT((step(turning, last) - expected).norm(), 1e-9);  // the path turns with the heading
  }
  EXPECT_NEAR(speed.rms(), 0.1, 0.01);
  EXPECT_NEAR(drift.rms(), 0.1, 0.01);
  const double T = last / 30.0, tau = 1.0;
  const double variance = T * std::erf(T / (2.0 * tau)) -
                          2.0 * tau / std::sqrt(M_PI) * (1.0 - std::exp(-T * T / (4.0 * tau * tau)));
  EXPECT_NEAR(heading.rms(), std::sqrt(variance), 0.1 * std::sqrt(variance));
}

TEST(FootSkate, SlipGrowsWhileTheFootStandsAndDecaysInTheAir) {
  PerFrame<bool> standing(4000, true);
  test::Spread speed;
  const PerFrame<Vector3d> slip = drawn_slip(standing, 0.05, kLeftAnkle, 3, 30.0);
  for (int t = 1; t < slip.count(); ++t) {
    const Vector3d pushed = 30.0 * (slip[t] - slip[t - 1]) + slip[t] / 1.0;  // returns within 1 s
    speed.add(pushed.x()), speed.add(pushed.y());
    EXPECT_EQ(slip[t].z(), 0.0);
  }
  EXPECT_NEAR(speed.rms(), 0.05, 0.005);
  for (int t = 2000; t < 4000; ++t) standing[t] = false;
  const PerFrame<Vector3d> lifted = drawn_slip(standing, 0.05, kLeftAnkle, 3, 30.0);
  EXPECT_EQ(lifted[1999], slip[1999]);
  EXPECT_LT(lifted[2030].norm(), 1e-3 * lifted[1999].norm() + 1e-6);
}

TEST(FootSkate, MovesTheAnkleAndKeepsTheFootsOrientationAndTheRest) {
  const motion::Clip& truth = test::truth_of("squat");
  const Character character = make_character(truth.betas);
  for (int t = 0; t < truth.frames(); t += 11) {
    const PerBody<Quaterniond> q = test::rotations_of(truth, static_cast<std::size_t>(t));
    PerBody<Quaterniond> moved = q;
    const Vector3d shift(0.01, -0.02, 0.005);
    const BodyPoses before = forward_kinematics(character, Vector3d::Zero(), q);
    move_ankle(character, shift, kRightAnkle, moved);
    const BodyPoses after = forward_kinematics(character, Vector3d::Zero(), moved);
    const double reach =
        (after.p_WB[kRightAnkle] - after.p_WB[kRightHip]).norm() /
        (character.joint_offset[kRightKnee].norm() + character.joint_offset[kRightAnkle].norm());
    const double missed = (after.p_WB[kRightAnkle] - before.p_WB[kRightAnkle] - shift).norm();
    EXPECT_TRUE(missed < 1e-9 || reach > 0.9998) << missed;
    EXPECT_LT(before.q_WB[kRightAnkle].angularDistance(after.q_WB[kRightAnkle]), 1e-7);
    for (int b = 0; b < kBodies; ++b)
      EXPECT_TRUE(b == kRightHip || b == kRightKnee || b == kRightAnkle ||
                  moved[b].coeffs() == q[b].coeffs());
  }
}

TEST(AddNoise, StandingFeetSlipAndNothingElseMoves) {
  const motion::Clip& truth = test::still_truth();
  const PerFrame<BodyPoses> poses = test::poses_of_clip(truth);
  ASSERT_TRUE(motion::standing_frames(poses, kLeftAnkle, truth.fps)[20]);
  test::Spread slip;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const motion::Clip noisy = add_noise(truth, only(&NoisePreset::skate, 0.05, seed));
    const PerFrame<BodyPoses> skating = test::poses_of_clip(noisy);
    for (int ankle : {int{kLeftAnkle}, int{kRightAnkle}}) {
      const auto off = [&](int t) { return Vector3d(skating[t].p_WB[ankle] - poses[t].p_WB[ankle]); };
      const Vector3d pushed = 30.0 * (off(20) - off(19)) + off(20);
      slip.add(pushed.x()), slip.add(pushed.y());
    }
    EXPECT_LT((noisy.trans[20] - truth.trans[20]).norm(), 1e-12);
    EXPECT_LT((noisy.rotations[20][kLeftShoulder] - truth.rotations[20][kLeftShoulder]).norm(), 1e-12);
  }
  EXPECT_NEAR(slip.rms(), 0.05, 0.006);
}

TEST(AddNoise, GivesAnotherBodyShapeWithItsFeetOnTheFloor) {
  const motion::Clip truth = test::beginning_of("stand", 2);
  const double true_lowest = lowest_contact(make_character(truth.betas), test::poses_of_clip(truth)[1]);
  test::Spread stature, proportions;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const motion::Clip taller = add_noise(truth, only(&NoisePreset::stature, 0.05, seed));
    const auto height = [](const motion::Clip& clip) {
      const Character c = make_character(clip.betas);
      return (c.joint_offset[kLeftKnee] + c.joint_offset[kLeftAnkle]).norm();
    };
    stature.add(height(taller) / height(truth) - 1.0);
    for (std::size_t k = 1; k < kBetas; ++k) EXPECT_EQ(taller.betas[k], truth.betas[k]);
    const double lowest = lowest_contact(make_character(taller.betas), test::poses_of_clip(taller)[1]);
    EXPECT_NEAR(lowest, true_lowest, 0.003);
    const motion::Clip other = add_noise(truth, only(&NoisePreset::proportions, 0.5, seed));
    EXPECT_EQ(other.betas[0], truth.betas[0]);
    for (std::size_t k = 1; k < kBetas; ++k) proportions.add(other.betas[k] - truth.betas[k]);
  }
  EXPECT_NEAR(stature.rms(), 0.05, 0.005);
  EXPECT_NEAR(proportions.rms(), 0.5, 0.02);
}

TEST(AddNoise, PanAndRollErrorsScaleWithTheTiltError) {
  const motion::Clip truth = test::beginning_of("stand", 2);
  test::Spread turn;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    NoiseConfig config = only(&NoisePreset::camera_turn, 0.5, seed);
    const motion::Keypoints exact = *add_noise(truth, config).keypoints;  // no tilt: no turn either
    config.camera.tilt = 2.0;
    NoiseConfig tilted = config;
    tilted.preset.camera_turn = 0.0;
    const motion::Keypoints told = *add_noise(truth, config).keypoints,
                            plain = *add_noise(truth, tilted).keypoints;
    EXPECT_LT((test::camera_position(told) - test::camera_position(exact)).norm(), 1e-9);
    const Matrix3d off =
        told.extrinsics[0].block<3, 3>(0, 0) * plain.extrinsics[0].block<3, 3>(0, 0).transpose();
    const Vector3d rotation = log_map(Quaterniond(off)) / kDegree;
    EXPECT_NEAR(rotation.x(), 0.0, 1e-9);
    turn.add(rotation.y()), turn.add(rotation.z());
  }
  EXPECT_NEAR(turn.rms(), 1.0, 0.08);
}

/// Mean metrics of noisy clips of every kind, three seeds each.
std::map<std::string, double> mean_metrics(const std::string& preset) {
  constexpr int kTrials = 3;
  const double clips = kTrials * static_cast<double>(basic_kinds().size());
  std::map<std::string, double> mean;
  std::uint64_t seed = 0;
  for (const std::string& kind : basic_kinds()) {
    const motion::Clip& truth = test::truth_of(kind);
    const motion::MotionSamples exact =
        motion::sample_motion(make_character(truth.betas), test::poses_of_clip(truth), truth.fps);
    for (int trial = 0; trial < kTrials; ++trial) {
      NoiseConfig config;
      config.preset = noise_preset(preset);
      config.camera = camera_error("calibrated");
      config.seed = ++seed;
      const motion::Clip noisy = add_noise(truth, config);
      const motion::Metrics metrics = motion::evaluate_motion(
          motion::sample_motion(make_character(noisy.betas), test::poses_of_clip(noisy), noisy.fps), &exact);
      for (const motion::MetricDefinition& definition : motion::metric_definitions())
        mean[definition.name] += (metrics.*definition.value).value / clips;
    }
  }
  return mean;
}

/// The rows of the paper's Table 1. The synthetic kinds are calmer than the clips of the calibration.
TEST(AddNoise, LandsNearThePublishedErrorsOfVideoEstimators) {
  struct Row {
    const char* preset;
    std::map<std::string, double> target;
  };
  const Row rows[] = {
      {"independent", {{"MRPE", 296}, {"MPJPE", 45}, {"PA-MPJPE", 32}, {"Vel", 2.8}, {"Accel", 2.5}}},
      {"gvhmr",
       {{"MRPE", 296},
        {"MPJPE", 45},
        {"PA-MPJPE", 32},
        {"Vel", 2.8},
        {"Accel", 2.5},
        {"GP", 6.7},
        {"Float", 72.6}}},
      {"vibe", {{"MRPE", 151}, {"MPJPE", 56}, {"PA-MPJPE", 44}, {"Vel", 8.8}, {"Accel", 12.6}, {"GP", 6.5}}}};
  for (const Row& row : rows) {
    std::map<std::string, double> mean = mean_metrics(row.preset);
    for (const auto& [name, target] : row.target)
      EXPECT_NEAR(mean.at(name), target, 0.3 * target) << row.preset << " " << name;
  }
}

TEST(NoisePreset, AllHaveOneDetectorAndOnlyNoneIsExact) {
  const NoisePreset none = noise_preset("none"), exact;
  for (const Amplitude& amplitude : amplitudes()) {
    const bool seen = reach_of(amplitude.name).keypoints || reach_of(amplitude.name).camera;
    for (const char* name : {"independent", "gvhmr", "vibe"}) {
      if (!seen) continue;
      EXPECT_EQ(noise_preset(name).*amplitude.value, none.*amplitude.value) << name << " " << amplitude.name;
    }
    EXPECT_EQ(none.*amplitude.value == exact.*amplitude.value, !seen) << amplitude.name;
  }
}

TEST(AddNoise, RejectsInvalidInput) {
  motion::Clip clip = test::truth_of("stand");
  clip.body_model = "smplx";
  EXPECT_THROW(noise_preset("mystery"), std::invalid_argument);
  EXPECT_THROW(camera_error("mystery"), std::invalid_argument);
  EXPECT_THROW(add_noise(clip, {}), std::invalid_argument);
  motion::Clip single;
  single.rotations = {clip.rotations.front()};
  single.trans = {clip.trans.front()};
  EXPECT_THROW(add_noise(single, {}), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::synth
