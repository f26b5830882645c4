#include "synth/noise/independent_noise.h"

#include <gtest/gtest.h>

#include "motion/metrics.h"
#include "motion/prepare/feet.h"
#include "synth/noise/foot_skate.h"
#include "synth/noise/independent_fixtures.h"

namespace mimicx::synth {
namespace {

using Term = double IndependentPreset::*;
using test::only;

constexpr double kMedianOfT4 = 0.7407 / M_SQRT2,
                 kFarOfT4 = 4.6041 / M_SQRT2;  // 50 % and 99 % of |t| at unit σ

TEST(IndependentNoise, WithoutErrorsReturnsTheTruth) {
  const motion::Clip& truth = test::truth_of("walk");
  const motion::Clip clip = add_independent_noise(truth, only(nullptr, 0.0, 1));
  EXPECT_EQ(clip.betas, truth.betas);
  for (int t = 0; t < truth.frames(); ++t) {
    EXPECT_LT((clip.trans[t] - truth.trans[t]).norm(), 1e-12);
    for (int b = 0; b < kBodies; ++b) EXPECT_LT(test::joint_error(truth, clip, t, b).norm(), 1e-6);
  }
}

TEST(IndependentNoise, IsByteIdenticalForEqualSeedsOnly) {
  IndependentNoiseConfig config;
  config.seed = 4;
  const motion::Clip& truth = test::truth_of("wave");
  const motion::Clip a = add_independent_noise(truth, config), b = add_independent_noise(truth, config);
  EXPECT_TRUE(a.rotations == b.rotations && a.trans == b.trans && a.betas == b.betas);
  EXPECT_TRUE(a.keypoints->uvc == b.keypoints->uvc && a.keypoints->extrinsics == b.keypoints->extrinsics);
  config.seed = 5;
  const motion::Clip c = add_independent_noise(truth, config);
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

TEST(IndependentNoise, TurningATermOffChangesOnlyItsOwnQuantities) {
  const motion::Clip& truth = test::truth_of("walk");
  IndependentNoiseConfig all;
  all.preset.swap_rate = all.preset.gap_rate = 1.0;
  const motion::Clip full = add_independent_noise(truth, all);
  for (const auto& term : amplitudes(all.preset)) {
    IndependentNoiseConfig without = all;
    without.preset.*term.value = 0.0;
    const motion::Clip clip = add_independent_noise(truth, without);
    const Reach reach = reach_of(term.name);
    EXPECT_EQ(clip.rotations != full.rotations || clip.trans != full.trans, reach.motion) << term.name;
    EXPECT_EQ(clip.betas != full.betas, reach.betas) << term.name;
    EXPECT_EQ(clip.keypoints->uvc != full.keypoints->uvc, reach.keypoints) << term.name;
    EXPECT_EQ(clip.keypoints->extrinsics != full.keypoints->extrinsics, reach.camera) << term.name;
    EXPECT_EQ(clip.keypoints->intrinsics, full.keypoints->intrinsics);
  }
}

TEST(IndependentNoise, ConstantErrorsHaveTheirSizeAndHeavyTails) {
  const motion::Clip& truth = test::still_truth();
  const std::map<int, double> weights = {
      {kLeftHip, 0.6}, {kSpine2, 0.8}, {kRightWrist, 1.9}, {kLeftFoot, 0.3}};
  std::vector<double> joints, root;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const motion::Clip noisy =
        add_independent_noise(truth, only(&IndependentPreset::joint_static, 2.0, seed));
    const motion::Clip turned =
        add_independent_noise(truth, only(&IndependentPreset::root_static, 2.0, seed));
    const Quaterniond q = exp_map(truth.rotations[9][0]), n = exp_map(turned.rotations[9][0]);
    for (int axis = 0; axis < 3; ++axis) {
      for (const auto& [body, weight] : weights)
        joints.push_back(std::abs(test::joint_error(truth, noisy, 9, body)[axis]) / weight);
      root.push_back(std::abs(log_map(q.conjugate() * n)[axis]) / test::kDegree);
    }
    EXPECT_LT((test::joint_error(truth, noisy, 40, kHead) - test::joint_error(truth, noisy, 3, kHead)).norm(),
              1e-6);
  }
  EXPECT_NEAR(test::share_below(joints, 0.5), 2.0 * kMedianOfT4, 0.06);
  EXPECT_NEAR(test::share_below(joints, 0.99), 2.0 * kFarOfT4, 0.7);  // a normal error: 5.2
  EXPECT_NEAR(test::share_below(root, 0.5), 2.0 * kMedianOfT4, 0.1);
}

TEST(IndependentNoise, SlowErrorsAndJitterHaveTheirSizeAndTheirPace) {
  const motion::Clip& truth = test::still_truth();
  const auto spread = [&](Term term, int later) {
    test::Spread s;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const motion::Clip noisy = add_independent_noise(truth, only(term, 2.0, seed));
      for (int body : {int{kLeftShoulder}, int{kRightShoulder}})  // weight 1
        for (int axis = 0; axis < 3; ++axis) {
          const double here = test::joint_error(truth, noisy, 10, body)[axis];
          s.add(later == 0 ? here : test::joint_error(truth, noisy, 10 + later, body)[axis] - here);
        }
    }
    return s.rms();
  };
  EXPECT_NEAR(spread(&IndependentPreset::joint_slow, 0), 2.0, 0.15);
  // Var(x(t+Δ) − x(t)) = 2σ²(1 − exp(−Δ²/4τ²)), with τ = 1.2 s = 36 frames.
  EXPECT_NEAR(spread(&IndependentPreset::joint_slow, 20),
              2.0 * std::sqrt(2.0 * (1.0 - std::exp(-400.0 / (4.0 * 36.0 * 36.0)))), 0.1);
  EXPECT_NEAR(spread(&IndependentPreset::joint_jitter, 0), 2.0, 0.15);
  EXPECT_NEAR(spread(&IndependentPreset::joint_jitter, 8), 2.0 * M_SQRT2, 0.2);
}

TEST(IndependentNoise, ShrinkingTakesAShareOfEveryJointsRotation) {
  const motion::Clip& truth = test::truth_of("kick");
  const motion::Clip noisy = add_independent_noise(truth, only(&IndependentPreset::joint_shrink, 0.2, 1));
  for (int t = 0; t < truth.frames(); t += 7)
    for (int b = 1; b < kBodies; ++b)
      EXPECT_LT((noisy.rotations[t][b] - 0.8 * truth.rotations[t][b]).norm(), 1e-9);
  EXPECT_LT((noisy.rotations[5][0] - truth.rotations[5][0]).norm(), 1e-9);
}

TEST(IndependentNoise, WobblesAreSlowAndOfTheirMeanSquare) {
  const motion::Clip& truth = test::still_truth();
  test::Spread place, turn;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const motion::Clip moved = add_independent_noise(truth, only(&IndependentPreset::wobble, 0.02, seed));
    const motion::Clip turned =
        add_independent_noise(truth, only(&IndependentPreset::wobble_turn, 2.0, seed));
    for (int axis = 0; axis < 3; ++axis) {
      const double off = (moved.trans[20] - truth.trans[20])[axis],
                   next = (moved.trans[21] - truth.trans[21])[axis];
      place.add(off);
      EXPECT_LE(std::abs(off), 0.02 * M_SQRT2 + 1e-12);
      EXPECT_LE(std::abs(next - off), 0.02 * M_SQRT2 * 2.0 * M_PI * 0.7 / 30.0);  // 0.7 Hz at most
      turn.add(test::joint_error(truth, turned, 20, kPelvis)[axis]);
    }
  }
  EXPECT_NEAR(place.rms(), 0.02, 0.001);
  EXPECT_NEAR(turn.rms(), 2.0, 0.1);
}

TEST(IndependentNoise, DistanceAndHeightAreConstantAndOfTheirSize) {
  const motion::Clip& truth = test::short_walk();
  test::Spread distance, height;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const motion::Clip far = add_independent_noise(truth, only(&IndependentPreset::depth, 0.1, seed));
    const Vector3d offset = far.trans[0] - truth.trans[0];
    const Vector3d ray =
        truth.trans[0] + mimicx::rest_pelvis("mimicx") - test::camera_position(*far.keypoints);
    EXPECT_LT(offset.cross(ray).norm(), 1e-9);
    EXPECT_LT((far.trans.back() - truth.trans.back() - offset).norm(), 1e-9);
    distance.add(offset.dot(ray) / ray.squaredNorm());
    const motion::Clip high = add_independent_noise(truth, only(&IndependentPreset::height, 0.1, seed));
    EXPECT_LT((high.trans[9] - truth.trans[9]).head<2>().norm(), 1e-12);
    height.add(high.trans[9].z() - truth.trans[9].z());
  }
  EXPECT_NEAR(distance.rms(), 0.1, 0.01);
  EXPECT_NEAR(height.rms(), 0.1, 0.01);
}

TEST(IndependentNoise, TravelErrsInSpeedInTheHeadingAndByAFalseVelocity) {
  const motion::Clip& walk = test::short_walk();
  const motion::Clip& still = test::still_truth();
  test::Spread speed, drift, heading;
  const int last = walk.frames() - 1;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const motion::Clip strides = add_independent_noise(walk, only(&IndependentPreset::stride, 0.1, seed));
    const auto step = [](const motion::Clip& clip, int t) {
      return Vector3d(clip.trans[t] - clip.trans[t - 1]);
    };
    speed.add(step(strides, 30).head<2>().norm() / step(walk, 30).head<2>().norm() - 1.0);
    const motion::Clip drifting = add_independent_noise(still, only(&IndependentPreset::drift, 0.1, seed));
    const Vector3d velocity = 30.0 * (step(drifting, 20) - step(still, 20));
    EXPECT_LT(std::abs(velocity.z()), 1e-9);
    drift.add(velocity.x()), drift.add(velocity.y());
    const motion::Clip turning = add_independent_noise(walk, only(&IndependentPreset::turn_drift, 1.0, seed));
    const Vector3d error = test::joint_error(walk, turning, last, kPelvis);
    EXPECT_LT(error.head<2>().norm(), 1e-6);
    heading.add(error.z());
    const Vector3d expected = rotation_z(test::kDegree * error.z()) * step(walk, last);
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

TEST(IndependentNoise, StandingFeetSlipAndNothingElseMoves) {
  const motion::Clip& truth = test::still_truth();
  const PerFrame<BodyPoses> poses = test::poses_of_clip(truth);
  ASSERT_TRUE(motion::standing_frames(poses, kLeftAnkle, truth.fps)[20]);
  test::Spread slip;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const motion::Clip noisy = add_independent_noise(truth, only(&IndependentPreset::skate, 0.05, seed));
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

TEST(IndependentNoise, GivesAnotherBodyShapeWithItsFeetOnTheFloor) {
  const motion::Clip& truth = test::still_truth();
  test::Spread stature, proportions;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const motion::Clip taller = add_independent_noise(truth, only(&IndependentPreset::stature, 0.05, seed));
    const auto height = [](const motion::Clip& clip) {
      const Character c = make_character(clip.betas);
      return (c.joint_offset[kLeftKnee] + c.joint_offset[kLeftAnkle]).norm();
    };
    stature.add(height(taller) / height(truth) - 1.0);
    for (std::size_t k = 1; k < kBetas; ++k) EXPECT_EQ(taller.betas[k], truth.betas[k]);
    const double lowest = lowest_contact(make_character(taller.betas), test::poses_of_clip(taller)[20]),
                 true_lowest = lowest_contact(make_character(truth.betas), test::poses_of_clip(truth)[20]);
    EXPECT_NEAR(lowest, true_lowest, 0.003);
    const motion::Clip other = add_independent_noise(truth, only(&IndependentPreset::proportions, 0.5, seed));
    EXPECT_EQ(other.betas[0], truth.betas[0]);
    for (std::size_t k = 1; k < kBetas; ++k) proportions.add(other.betas[k] - truth.betas[k]);
  }
  EXPECT_NEAR(stature.rms(), 0.05, 0.005);
  EXPECT_NEAR(proportions.rms(), 0.5, 0.02);
}

TEST(IndependentNoise, PanAndRollErrorsScaleWithTheTiltError) {
  const motion::Clip& truth = test::still_truth();
  test::Spread turn;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    IndependentNoiseConfig config = only(&IndependentPreset::camera_turn, 0.5, seed);
    const motion::Keypoints exact =
        *add_independent_noise(truth, config).keypoints;  // no tilt: no turn either
    config.camera.tilt = 2.0;
    IndependentNoiseConfig tilted = config;
    tilted.preset.camera_turn = 0.0;
    const motion::Keypoints told = *add_independent_noise(truth, config).keypoints,
                            plain = *add_independent_noise(truth, tilted).keypoints;
    EXPECT_LT((test::camera_position(told) - test::camera_position(exact)).norm(), 1e-9);
    const Matrix3d off =
        told.extrinsics[0].block<3, 3>(0, 0) * plain.extrinsics[0].block<3, 3>(0, 0).transpose();
    const Vector3d rotation = log_map(Quaterniond(off)) / test::kDegree;
    EXPECT_NEAR(rotation.x(), 0.0, 1e-9);
    turn.add(rotation.y()), turn.add(rotation.z());
  }
  EXPECT_NEAR(turn.rms(), 1.0, 0.08);
}

TEST(IndependentNoise, LandsNearThePublishedErrorsOfAVideoEstimator) {
  std::map<std::string, double> mean;
  const double clips = 4.0 * static_cast<double>(basic_kinds().size());
  std::uint64_t seed = 0;
  for (const std::string& kind : basic_kinds()) {
    const motion::Clip& truth = test::truth_of(kind);
    const motion::MotionSamples exact =
        motion::sample_motion(make_character(truth.betas), test::poses_of_clip(truth), truth.fps);
    for (int trial = 0; trial < 4; ++trial) {
      IndependentNoiseConfig config;
      config.seed = ++seed;
      const motion::Clip noisy = add_independent_noise(truth, config);
      const motion::Metrics metrics = motion::evaluate_motion(
          motion::sample_motion(make_character(noisy.betas), test::poses_of_clip(noisy), noisy.fps), &exact);
      for (const motion::MetricDefinition& definition : motion::metric_definitions())
        mean[definition.name] += (metrics.*definition.value).value / clips;
    }
  }
  const std::map<std::string, double> target = {
      {"MRPE", 296}, {"MPJPE", 45}, {"PA-MPJPE", 32}, {"Vel", 2.8}, {"Accel", 2.5}};
  for (const auto& [name, value] : target) EXPECT_NEAR(mean.at(name), value, 0.3 * value) << name;
}

TEST(IndependentNoise, RejectsInvalidInput) {
  motion::Clip clip = test::truth_of("stand");
  clip.body_model = "smplx";
  EXPECT_THROW(add_independent_noise(clip, {}), std::invalid_argument);
  motion::Clip single;
  single.rotations = {clip.rotations.front()};
  single.trans = {clip.trans.front()};
  EXPECT_THROW(add_independent_noise(single, {}), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::synth
