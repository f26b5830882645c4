#include "synth/noise/estimator_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/metrics.h"
#include "synth/noise/noise_fixtures.h"

namespace mimicx::synth {
namespace {

using namespace test;

TEST(SmoothNoise, HasUnitVarianceAndAGaussianAutocorrelation) {
  for (double frames : {0.45, 3.0, 12.0}) {
    Random random(11, {static_cast<std::uint64_t>(10.0 * frames)});
    const int lag = static_cast<int>(std::ceil(frames));
    double variance = 0.0, covariance = 0.0;
    constexpr int kTrials = 20000;
    for (int trial = 0; trial < kTrials; ++trial) {
      const std::vector<double> x = smooth_noise(random, lag + 1, frames);
      variance += x.front() * x.front() / kTrials;
      covariance += x.front() * x.back() / kTrials;
    }
    EXPECT_NEAR(variance, 1.0, 0.03);
    // Below a frame the filter is sampled too coarsely for the continuous formula: sum its taps instead.
    double expected = 0.0, squares = 0.0;
    for (int k = -200; k <= 200; ++k) {
      const double here = std::exp(-0.5 * k * k / (frames * frames));
      expected += here * std::exp(-0.5 * (k + lag) * (k + lag) / (frames * frames));
      squares += here * here;
    }
    EXPECT_NEAR(covariance, expected / squares, 0.03);
    if (frames < 3.0) continue;
    EXPECT_NEAR(covariance, std::exp(-lag * lag / (4.0 * frames * frames)), 0.03);
  }
}

TEST(AddNoise, WithoutErrorsReturnsTheTruth) {
  const motion::Clip& truth = test::truth_of("walk");
  const motion::Clip clip = add_noise(truth, test::silent());
  EXPECT_EQ(clip.betas, truth.betas);
  for (std::size_t t = 0; t < truth.rotations.size(); ++t) {
    EXPECT_LT((clip.trans[t] - truth.trans[t]).norm(), 1e-12);
    for (std::size_t b = 0; b < kBodies; ++b)
      EXPECT_LT((clip.rotations[t][b] - truth.rotations[t][b]).norm(), 1e-7);
  }
}

TEST(AddNoise, IsByteIdenticalForEqualSeedsOnly) {
  NoiseConfig config;
  config.seed = 4;
  const motion::Clip a = add_noise(test::truth_of("wave"), config),
                     b = add_noise(test::truth_of("wave"), config);
  EXPECT_TRUE(a.rotations == b.rotations && a.trans == b.trans && a.betas == b.betas);
  EXPECT_TRUE(a.keypoints->uvc == b.keypoints->uvc && a.keypoints->extrinsics == b.keypoints->extrinsics);
  config.seed = 5;
  const motion::Clip c = add_noise(test::truth_of("wave"), config);
  EXPECT_TRUE(a.rotations != c.rotations && a.keypoints->uvc != c.keypoints->uvc);
}

TEST(AddNoise, DrawsEveryTermFromAStreamOfItsOwn) {
  NoiseConfig config, without;
  config.preset.snap = without.preset.snap = 0.0;  // the height would follow the joints
  without.preset.joint_static = without.preset.joint_slow = without.preset.joint_jitter = 0.0;
  const motion::Clip a = add_noise(test::truth_of("wave"), config),
                     b = add_noise(test::truth_of("wave"), without);
  EXPECT_TRUE(a.trans == b.trans);
  EXPECT_TRUE(a.keypoints->uvc == b.keypoints->uvc);
  EXPECT_TRUE(a.rotations != b.rotations);
  for (std::size_t t = 0; t < a.rotations.size(); ++t) EXPECT_EQ(a.rotations[t][0], b.rotations[t][0]);
}

/// Errors of one joint (in its own axes) or of the root (in the world's), degrees.
Vector3d rotation_error(const motion::Clip& truth, const motion::Clip& noisy, int t, int body) {
  const Quaterniond q = exp_map(truth.rotations[t][body]), n = exp_map(noisy.rotations[t][body]);
  return log_map(body == 0 ? n * q.conjugate() : q.conjugate() * n) / test::kDegree;
}

TEST(AddNoise, GivesJointErrorsTheAmplitudeOfEachTermTimesTheJointsWeight) {
  const motion::Clip& truth = test::still_truth();
  const std::map<int, double> weights = {{kLeftHip, 0.9},      {kSpine2, 0.45},   {kRightKnee, 1.0},
                                         {kRightAnkle, 1.3},   {kLeftFoot, 0.6},  {kHead, 0.8},
                                         {kLeftShoulder, 1.2}, {kRightWrist, 1.4}};
  for (double NoisePreset::*term :
       {&NoisePreset::joint_static, &NoisePreset::joint_slow, &NoisePreset::joint_jitter}) {
    std::map<int, test::Spread> spread;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      NoiseConfig config = test::silent(seed);
      config.preset.*term = 2.0;
      const motion::Clip noisy = add_noise(truth, config);
      for (const auto& [body, weight] : weights)
        for (int axis = 0; axis < 3; ++axis)
          spread[body].add(rotation_error(truth, noisy, 20, body)[axis] / weight);
    }
    for (const auto& [body, s] : spread) EXPECT_NEAR(s.rms(), 2.0, 0.22) << kBodyNames[body];
  }
}

TEST(AddNoise, KeepsTheStaticErrorAndChangesTheOthersAtTheirOwnPace) {
  const motion::Clip& truth = test::still_truth();
  const auto change = [&](double NoisePreset::*term, int frames) {
    test::Spread spread;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      NoiseConfig config = test::silent(seed);
      config.preset.*term = 2.0;
      const motion::Clip noisy = add_noise(truth, config);
      const auto error = [&](int t) { return rotation_error(truth, noisy, t, kLeftKnee); };
      for (int axis = 0; axis < 3; ++axis) spread.add(error(5 + frames)[axis] - error(5)[axis]);
    }
    return spread.rms();
  };
  EXPECT_LT(change(&NoisePreset::joint_static, 30), 1e-9);
  // Var(x(t+Δ) − x(t)) = 2σ²(1 − exp(−Δ²/4τ²)), with τ = 0.3 s = 9 frames here.
  EXPECT_NEAR(change(&NoisePreset::joint_slow, 5), 2.0 * std::sqrt(2.0 * (1.0 - std::exp(-25.0 / 324.0))),
              0.1);
  EXPECT_NEAR(change(&NoisePreset::joint_jitter, 5), 2.0 * std::sqrt(2.0), 0.4);
}

TEST(AddNoise, TurnsTheRootAboutWorldAxesAndLetsTheHeadingWalk) {
  const motion::Clip& truth = test::still_truth();
  for (double NoisePreset::*term :
       {&NoisePreset::root_static, &NoisePreset::root_slow, &NoisePreset::root_jitter}) {
    test::Spread spread;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
      NoiseConfig config = test::silent(seed);
      config.preset.*term = 2.0;
      const Vector3d error = rotation_error(truth, add_noise(truth, config), 20, 0);
      for (int axis = 0; axis < 3; ++axis) spread.add(error[axis]);
    }
    EXPECT_NEAR(spread.rms(), 2.0, 0.25);
  }
  test::Spread walk, tilt;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    NoiseConfig config = test::silent(seed);
    config.preset.heading_walk = 1.0;
    const Vector3d error = rotation_error(truth, add_noise(truth, config), 40, 0);
    walk.add(error.z());
    tilt.add(error.head<2>().norm());
  }
  EXPECT_NEAR(walk.rms(), std::sqrt(40.0 / 30.0), 0.15);  // 1 °/√s
  EXPECT_LT(tilt.rms(), 1e-9);
}

TEST(AddNoise, ShiftsTheRootAlongAndAcrossTheCamerasView) {
  const motion::Clip& truth = test::still_truth();
  for (double NoisePreset::*term :
       {&NoisePreset::depth_static, &NoisePreset::depth_slow, &NoisePreset::depth_jitter}) {
    test::Spread along, across, up;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      NoiseConfig config = test::silent(seed);
      config.preset.*term = 0.2;
      config.preset.lateral = 0.3;
      const motion::Clip noisy = add_noise(truth, config);
      Vector3d depth = test::viewing_direction(*noisy.keypoints);
      depth.z() = 0.0;
      depth.normalize();
      const Vector3d error = noisy.trans[20] - truth.trans[20];
      along.add(error.dot(depth));
      across.add(error.dot(Vector3d::UnitZ().cross(depth)));
      up.add(error.z());
    }
    EXPECT_NEAR(along.rms(), 0.2, 0.025);
    EXPECT_NEAR(across.rms(), 0.06, 0.008);
    EXPECT_EQ(up.rms(), 0.0);
  }
}

TEST(AddNoise, LetsTheRootDriftWithASmoothVelocity) {
  const motion::Clip& truth = test::still_truth();
  test::Spread speed;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    NoiseConfig config = test::silent(seed);
    config.preset.drift = 0.05;
    const motion::Clip noisy = add_noise(truth, config);
    const auto offset = [&](std::size_t t) { return Vector3d(noisy.trans[t] - truth.trans[t]); };
    EXPECT_LT(offset(0).norm(), 1e-12);
    const Vector3d view = test::viewing_direction(*noisy.keypoints);
    speed.add((offset(31) - offset(30)).dot(Vector3d(view.x(), view.y(), 0.0).normalized()) * 30.0);
  }
  EXPECT_NEAR(speed.rms(), 0.05, 0.006);
}

TEST(AddNoise, ScalesAndTurnsThePathAboutItsStart) {
  const motion::Clip& truth = test::truth_of("walk");
  test::Spread scale, turn;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    NoiseConfig config = test::silent(seed);
    config.preset.speed_error = 0.03;
    config.preset.heading_error = 2.0;
    const motion::Clip noisy = add_noise(truth, config);
    const Eigen::Vector2d path = (truth.trans.back() - truth.trans.front()).head<2>(),
                          seen = (noisy.trans.back() - noisy.trans.front()).head<2>();
    EXPECT_LT((noisy.trans[0] - truth.trans[0]).norm(), 1e-12);
    scale.add(seen.norm() / path.norm() - 1.0);
    turn.add(std::asin((path.x() * seen.y() - path.y() * seen.x()) / (path.norm() * seen.norm())) /
             test::kDegree);
  }
  EXPECT_NEAR(scale.rms(), 0.03, 0.004);
  EXPECT_NEAR(turn.rms(), 2.0, 0.25);
}

TEST(AddNoise, SnapsTheSupportToItsTrueHeight) {
  const motion::Clip& truth = test::truth_of("squat");
  NoiseConfig config = test::silent(3);
  config.preset.joint_static = config.preset.joint_slow = 4.0;
  const Character character = make_character();
  const std::vector<motion::SurfacePoint> surface = motion::surface_points(character);
  const auto worst = [&](double snap) {
    config.preset.snap = snap;
    double largest = 0.0;
    for (const BodyPoses& poses : test::poses_of_clip(add_noise(truth, config)))
      largest =
          std::max(largest, std::abs(motion::lowest_height(surface, poses)));  // the true support is at 0
    return largest;
  };
  EXPECT_LT(worst(1.0), 1e-9);
  EXPECT_NEAR(worst(0.5), 0.5 * worst(0.0), 1e-9);
  EXPECT_GT(worst(0.0), 0.005);
}

TEST(AddNoise, OffsetsTheHeight) {
  const motion::Clip& truth = test::still_truth();
  test::Spread height;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    NoiseConfig config = test::silent(seed);
    config.preset.height_offset = 0.06;
    config.preset.height_static = 0.04;
    config.preset.height_slow = 0.03;
    const motion::Clip noisy = add_noise(truth, config);
    height.add(noisy.trans[20].z() - truth.trans[20].z());
  }
  EXPECT_NEAR(height.mean(), 0.06, 0.007);
  EXPECT_NEAR(std::sqrt(height.rms() * height.rms() - height.mean() * height.mean()), 0.05, 0.005);
}

TEST(DrawBursts, IsAPoissonProcessWithTheLengthsAndSizesOfThePreset) {
  const NoisePreset preset = noise_preset("vibe-like");
  test::Spread count;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const std::vector<Burst> bursts = draw_bursts(preset, seed, 600, 30.0);
    count.add(static_cast<double>(bursts.size()));
    for (const Burst& burst : bursts) {
      EXPECT_TRUE(burst.first >= 0 && burst.first + burst.length <= 600);
      EXPECT_TRUE(burst.length <= 8 && (burst.length >= 3 || burst.first + burst.length == 600));
      EXPECT_TRUE(burst.peak.norm() >= 30.0 * test::kDegree && burst.peak.norm() <= 70.0 * test::kDegree);
    }
  }
  EXPECT_NEAR(count.mean(), 2.0, 0.12);  // 0.1 /s over 20 s; variance of a Poisson count = its mean
  EXPECT_NEAR(count.rms() * count.rms() - count.mean() * count.mean(), 2.0, 0.25);
}

TEST(AddNoise, OpensAndClosesABurstWithAHannWindow) {
  const motion::Clip& truth = test::truth_of("stand");
  NoiseConfig config = test::silent(1);
  config.preset = noise_preset("gvhmr-like");
  config.preset.burst_rate = 1.0;
  config.preset.joint_static = config.preset.joint_slow = config.preset.joint_jitter = 0.0;
  const std::vector<Burst> bursts = draw_bursts(config.preset, config.seed, truth.frames(), truth.fps);
  ASSERT_FALSE(bursts.empty());
  const motion::Clip noisy = add_noise(truth, config);
  int lonely = 0;  // bursts that no other one on the same joint overlaps
  for (const Burst& burst : bursts) {
    int sharing = 0;
    for (const Burst& other : bursts)
      if (other.joint == burst.joint && other.first < burst.first + burst.length &&
          burst.first < other.first + other.length)
        ++sharing;
    if (sharing > 1) continue;
    ++lonely;
    for (int k = 0; k < burst.length; ++k) {
      const double window = std::pow(std::sin(M_PI * (k + 0.5) / burst.length), 2);
      const Vector3d error = rotation_error(truth, noisy, burst.first + k, burst.joint);
      EXPECT_LT((error * test::kDegree - window * burst.peak).norm(), 1e-9);
    }
  }
  EXPECT_GT(lonely, 0);
}

TEST(AddNoise, RejectsInvalidInput) {
  EXPECT_THROW(noise_preset("mystery"), std::invalid_argument);
  EXPECT_THROW(camera_error("mystery"), std::invalid_argument);
  motion::Clip clip = test::truth_of("stand");
  clip.body_model = "smplx";
  EXPECT_THROW(add_noise(clip, {}), std::invalid_argument);
  motion::Clip single;
  single.rotations = {clip.rotations.front()};
  single.trans = {clip.trans.front()};
  EXPECT_THROW(add_noise(single, {}), std::invalid_argument);
}

/// Mean metrics of noisy clips of every kind, six seeds each.
std::map<std::string, double> mean_metrics(const std::string& preset) {
  constexpr int kTrials = 6;
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

/// The rows of published estimators the model was fitted to, on real clips; the synthetic kinds are calmer,
/// so the margins are wide.
TEST(AddNoise, LandsNearThePublishedErrorsOfVideoEstimators) {
  struct Row {
    const char* preset;
    std::map<std::string, double> target;
  };
  const Row rows[] = {
      {"vibe-like",
       {{"MRPE", 151}, {"MPJPE", 56}, {"PA-MPJPE", 44}, {"Vel", 8.8}, {"Accel", 12.6}, {"GP", 6.5}}},
      {"gvhmr-like",
       {{"MRPE", 296}, {"MPJPE", 45}, {"PA-MPJPE", 32}, {"Vel", 2.8}, {"Accel", 2.5}, {"Float", 72.6}}}};
  for (const Row& row : rows) {
    std::map<std::string, double> mean = mean_metrics(row.preset);
    for (const auto& [name, target] : row.target)
      EXPECT_NEAR(mean.at(name), target, 0.3 * target) << row.preset << " " << name;
  }
}

}  // namespace
}  // namespace mimicx::synth
