#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "motion/synth/noise.h"
#include "rl/tracking/environment.h"
#include "rl/tracking/rollout.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::rl {
namespace {

std::array<float, kStateSize> state_of(const Pose& reference, const Pose& simulated, double beta0 = 0.0) {
  std::array<float, kStateSize> state{};
  tracking_state(reference, joint_features(reference.frame), {beta0}, simulated, state.data());
  return state;
}

TEST(TrackingState, HasExactly570NumbersAndWritesThemAll) {
  const Character character = make_character();
  Random random(3);
  const Pose a = pose_of(character, random_frame(random, 0.5)),
             b = pose_of(character, random_frame(random, 0.5));
  std::array<float, kStateSize + 1> state;
  state.fill(std::numeric_limits<float>::quiet_NaN());
  tracking_state(a, joint_features(a.frame), {}, b, state.data());
  for (int k = 0; k < 570; ++k) EXPECT_TRUE(std::isfinite(state[static_cast<std::size_t>(k)])) << k;
  EXPECT_TRUE(std::isnan(state[570])) << "wrote past its end";
}

TEST(TrackingState, IgnoresWhereBothLookAndStand) {
  const Character character = make_character();
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose reference = pose_of(character, random_frame(random, 0.4));
    const Pose simulated = pose_of(character, random_frame(random, 0.4));
    const double angle = random.uniform(-3.0, 3.0);
    const Eigen::Vector2d offset(random.normal(), random.normal());
    const auto before = state_of(reference, simulated);
    const auto after =
        state_of(moved(character, reference, angle, offset), moved(character, simulated, angle, offset));
    for (std::size_t k = 0; k < kStateSize; ++k) EXPECT_NEAR(before[k], after[k], 2e-5) << "entry " << k;
  }
}

TEST(TrackingState, SeesATurnOrAShiftOfOneOfThem) {
  const Character character = make_character();
  Random random(5);
  const Pose pose = pose_of(character, random_frame(random, 0.3));
  const auto same = state_of(pose, pose);
  for (std::size_t k = 382; k < kStateSize; ++k) EXPECT_EQ(same[k], 0.0F) << "a difference of equal poses";
  const auto shifted = state_of(moved(character, pose, 0.0, {0.3, 0.4}), pose);
  EXPECT_NEAR(std::hypot(shifted[568], shifted[569]), 0.5, 1e-6) << "root offset";
  for (std::size_t k = 382; k < 568; ++k) EXPECT_NEAR(shifted[k], 0.0F, 1e-6);
  const auto turned = state_of(moved(character, pose, 0.5, {0, 0}), pose);
  double difference = 0.0;
  for (std::size_t k = 383; k < 389; ++k) difference += std::abs(turned[k]);
  EXPECT_GT(difference, 0.1) << "root rotation";
}

TEST(TrackingState, HeadingDirectionIsThatOfTheHeadingAngle) {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Quaterniond q = random_frame(random, 0.7).q[0];
    const double angle = heading_angle(q);
    EXPECT_NEAR(heading_direction(q).x(), std::cos(angle), 1e-12);
    EXPECT_NEAR(heading_direction(q).y(), std::sin(angle), 1e-12);
  }
}

TEST(TrackingReward, IsOneOnTheReference) {
  const Character character = make_character();
  Random random(7);
  const Pose pose = pose_of(character, random_frame(random, 0.5));
  const Reward reward = tracking_reward({}, pose, pose, nullptr);
  EXPECT_NEAR(reward.total, 1.0, 1e-12);
}

TEST(TrackingReward, TermsFollowTheirClosedForms) {
  const Character character = make_character();
  Random random(8);
  const Pose pose = pose_of(character, random_frame(random, 0.3));
  const RewardWeights w;

  const Reward shifted = tracking_reward(w, pose, moved(character, pose, 0.0, {0.03, 0.04}), nullptr);
  EXPECT_NEAR(shifted.term[0], std::exp(-w.root_position * 0.0025), 1e-9);
  EXPECT_NEAR(shifted.total, shifted.term[0], 1e-9) << "a shift must not touch any other term";

  ReferenceFrame bent = pose.frame;
  bent.q[kHead] = bent.q[kHead] * exp_map(Vector3d(0.2, 0, 0));  // moves no end effector
  const Reward nod = tracking_reward(w, pose, pose_of(character, bent), nullptr);
  EXPECT_NEAR(nod.term[2], std::exp(-w.pose * 0.04 / 21.0), 1e-9);
  EXPECT_NEAR(nod.total, nod.term[2], 1e-9);

  ReferenceFrame faster = pose.frame;
  faster.omega[kNeck] += Vector3d(3, 0, 4);
  const Reward fast = tracking_reward(w, pose, pose_of(character, faster), nullptr);
  EXPECT_NEAR(fast.term[3], std::exp(-w.velocity * 25.0 / 21.0), 1e-9);

  ReferenceFrame turned = pose.frame;
  turned.q[0] = rotation_z(0.3) * turned.q[0];
  EXPECT_NEAR(tracking_reward(w, pose, pose_of(character, turned), nullptr).term[1],
              std::exp(-w.root_rotation * 0.09), 1e-9);

  Pose lifted = pose;
  lifted.p_WB[kLeftWrist].z() += 0.1;
  EXPECT_NEAR(tracking_reward(w, pose, lifted, nullptr).term[4], std::exp(-w.end_effector * 0.01 / 4.0),
              1e-9);
}

Keypoints camera_and_points(const Pose& pose) {
  Keypoints k;
  k.intrinsics << 1000, 0, 500, 0, 1000, 500, 0, 0, 1;
  Eigen::Matrix4d e = Eigen::Matrix4d::Identity();  // looks along world +y from y = −5
  e.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  e.topRightCorner<3, 1>() = Vector3d(0, 1, 5);
  k.extrinsics = {e};
  k.uvc.emplace_back();
  for (std::size_t i = 0; i < kBodies; ++i) {
    k.names.emplace_back(kBodyNames[i]);
    const Vector3d p = k.intrinsics * (e.topLeftCorner<3, 3>() * pose.p_WB[i] + e.topRightCorner<3, 1>());
    k.uvc[0].push_back({p.x() / p.z(), p.y() / p.z(), 1.0});
  }
  return k;
}

TEST(TrackingReward, ProjectionTermIsExactlyOneWithoutKeypointsAndOnThem) {
  const Character character = make_character();
  const Pose pose = pose_of(character, swaying_reference(2).frames[0]);
  EXPECT_EQ(tracking_reward({}, pose, moved(character, pose, 0, {0.1, 0}), nullptr).term[5], 1.0);
  const auto frames = match_keypoints(camera_and_points(pose));
  EXPECT_NEAR(tracking_reward({}, pose, pose, &frames[0]).term[5], 1.0, 1e-12);
}

TEST(TrackingReward, ProjectionErrorIsMeasuredInBoxHeights) {
  const Character character = make_character();
  const Pose pose = pose_of(character, swaying_reference(2).frames[0]);
  Keypoints keypoints = camera_and_points(pose);
  for (double zoom : {1.0, 3.0}) {  // the image's resolution must not matter
    Keypoints scaled = keypoints;
    scaled.intrinsics.topRows<2>() *= zoom;
    double box = match_keypoints(keypoints)[0].box_height;
    for (auto& uvc : scaled.uvc[0]) uvc.head<2>() = zoom * (uvc.head<2>() + Eigen::Vector2d(0.02 * box, 0.0));
    const auto frames = match_keypoints(scaled);
    const RewardWeights w;
    EXPECT_NEAR(tracking_reward(w, pose, pose, &frames[0]).term[5], std::exp(-w.projection * 0.0004), 1e-6);
  }
}

TEST(TrackingReward, KeypointsWithoutConfidenceDoNotCount) {
  const Character character = make_character();
  const Pose pose = pose_of(character, swaying_reference(2).frames[0]);
  Keypoints keypoints = camera_and_points(pose);
  keypoints.uvc[0][kLeftWrist] = {1e6, -1e6, 0.0};
  const auto frames = match_keypoints(keypoints);
  EXPECT_NEAR(tracking_reward({}, pose, pose, &frames[0]).term[5], 1.0, 1e-12);
}

/// What a detector of COCO-17 reports of `points`: its own order, and a face that no body of ours stands for.
Keypoints as_coco17(const Keypoints& points) {
  Keypoints coco = points;
  coco.names = keypoint_names(KeypointSet::kCoco17);
  coco.uvc.assign(points.uvc.size(), {});
  for (std::size_t t = 0; t < points.uvc.size(); ++t)
    for (const std::string& name : coco.names) {
      const auto at = std::find(points.names.begin(), points.names.end(), name) - points.names.begin();
      const bool face = at == static_cast<std::ptrdiff_t>(points.names.size());
      coco.uvc[t].push_back(face ? Vector3d(-1e4, 1e4, 1.0) : points.uvc[t][static_cast<std::size_t>(at)]);
    }
  return coco;
}

TEST(TrackingReward, Coco17IsComparedJointByJointWithoutTheFace) {
  const Character character = make_character();
  const Pose pose = pose_of(character, swaying_reference(2).frames[0]);
  const Keypoints coco = as_coco17(camera_and_points(pose));
  ASSERT_EQ(coco.names.size(), 17u);
  const auto frames = match_keypoints(coco);
  ASSERT_EQ(frames[0].detections.size(), 12u);
  const RewardWeights w;
  EXPECT_NEAR(tracking_reward(w, pose, pose, &frames[0]).term[5], 1.0, 1e-12);
  for (std::size_t k = 5; k < 17; ++k) {  // one joint a tenth of the box off counts for a twelfth
    Keypoints off = coco;
    off.uvc[0][k].x() += 0.1 * frames[0].box_height;
    const auto moved_frames = match_keypoints(off);
    EXPECT_NEAR(tracking_reward(w, pose, pose, &moved_frames[0]).term[5],
                std::exp(-w.projection * 0.01 / 12.0), 1e-9)
        << coco.names[k];
  }
}

TEST(TrackingPack, ActionHas55EntriesAndZeroResidualAimsAtTheReference) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(30), config);
  const std::array<float, 55> zero{};
  TrackingPack pack(clip, config);
  Data<TrackingPack::P> scratch;
  for (int lane = 0; lane < kLanes; ++lane) pack.act(lane, zero.data());
  pack.advance(scratch);
  EXPECT_EQ(pack.frame(0), 1);
  EXPECT_LT(pack.worst_distance(0), 0.01) << "one step of PD control towards the reference stays beside it";
}

TEST(TrackingPack, AbsoluteActionIsTheTargetPoseItself) {
  // With absolute actions that spell out the next reference pose, the motion must be that of zero residuals.
  TrackingConfig absolute, residual;
  absolute.action_mode = ActionMode::kAbsolute;
  const auto clip = make_tracking_clip(swaying_reference(30), residual);
  TrackingPack a(clip, absolute), r(clip, residual);
  Data<TrackingPack::P> scratch;
  const std::array<float, kDofs> zero{};
  for (int t = 0; t < 5; ++t) {
    std::array<float, kDofs> target{};
    const ReferenceFrame& next = clip->poses[static_cast<std::size_t>(t + 1)].frame;
    for (int body = 1; body < kBodies; ++body) {
      const Vector3d v = log_map(next.q[static_cast<std::size_t>(body)]);
      const auto dof = static_cast<std::size_t>(first_dof(body));
      if (is_hinge(body))
        target[dof] = static_cast<float>(v.dot(hinge_axis(body)));
      else
        for (std::size_t k = 0; k < 3; ++k) target[dof + k] = static_cast<float>(v[static_cast<int>(k)]);
    }
    for (int lane = 0; lane < kLanes; ++lane) {
      a.act(lane, target.data());
      r.act(lane, zero.data());
    }
    a.advance(scratch);
    r.advance(scratch);
  }
  for (std::size_t i = 0; i < kBodies; ++i)
    EXPECT_LT((a.pose(0).p_WB[i] - r.pose(0).p_WB[i]).norm(), 1e-4) << kBodyNames[i];
}

TEST(TrackingPack, NumbersThatAreNoneInAnActionCountAsZero) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(10), config);
  const std::array<float, kDofs> zero{};
  std::array<float, kDofs> none;
  none.fill(std::numeric_limits<float>::quiet_NaN());
  none[3] = std::numeric_limits<float>::infinity();
  TrackingPack with(clip, config), without(clip, config);
  Data<TrackingPack::P> scratch;
  for (int lane = 0; lane < kLanes; ++lane) {
    with.act(lane, none.data());
    without.act(lane, zero.data());
  }
  with.advance(scratch);
  without.advance(scratch);
  for (std::size_t i = 0; i < kBodies; ++i) EXPECT_EQ(with.pose(0).p_WB[i], without.pose(0).p_WB[i]);
}

TEST(TrackingPack, LanesOnDifferentFramesDoNotDisturbEachOther) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(40), config);
  const std::array<float, kDofs> zero{};
  std::array<float, kDofs> violent;
  violent.fill(2.0F);
  TrackingPack alone(clip, config), mixed(clip, config);
  Data<TrackingPack::P> scratch;
  for (int lane = 1; lane < kLanes; ++lane) mixed.reset(lane, lane);
  for (int t = 0; t < 10; ++t) {
    for (int lane = 0; lane < kLanes; ++lane) {
      alone.act(lane, zero.data());
      mixed.act(lane, lane == 0 ? zero.data() : violent.data());
    }
    alone.advance(scratch);
    mixed.advance(scratch);
    if (t == 5) mixed.reset(3, 20);
  }
  for (std::size_t i = 0; i < kBodies; ++i) EXPECT_EQ(alone.pose(0).p_WB[i], mixed.pose(0).p_WB[i]);
  EXPECT_EQ(mixed.frame(3), 24);
}

/// Steps an environment with fixed actions; returns every reward.
std::vector<float> drive(TrackingEnvironment& environment, int steps, int threads, int first_step = 0) {
  std::vector<StepResult> results(static_cast<std::size_t>(environment.groups()),
                                  StepResult(environment.group_size(), environment.observation_dim()));
  std::vector<float> rewards;
  for (int t = first_step; t < first_step + steps; ++t) {
    parallel_for(environment.groups(), threads, [&](int g) {
      nn::Matrix<float> actions(environment.group_size(), kDofs);
      Random random(9, {static_cast<std::uint64_t>(t), static_cast<std::uint64_t>(g)});
      for (int k = 0; k < actions.size(); ++k) actions.data()[k] = static_cast<float>(0.3 * random.normal());
      environment.step(g, actions, results[static_cast<std::size_t>(g)]);
    });
    for (const auto& result : results)
      rewards.insert(rewards.end(), result.reward.begin(), result.reward.end());
    if (t % 16 == 15) environment.end_iteration();
  }
  return rewards;
}

TEST(TrackingEnvironment, IsBitIdenticalForOneAndTwoThreads) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(90), config);
  TrackingEnvironment one({clip}, config, 4 * kLanes, 2 * kLanes, 11),
      two({clip}, config, 4 * kLanes, 2 * kLanes, 11);
  EXPECT_EQ(drive(one, 48, 1), drive(two, 48, 2));
}

TEST(TrackingEnvironment, GoesOnBitIdenticallyAfterSaveAndLoad) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(90), config);
  TrackingEnvironment first({clip}, config, 2 * kLanes, kLanes, 12),
      second({clip}, config, 2 * kLanes, kLanes, 13);
  drive(first, 32, 1);
  Npz archive;
  first.save(archive, "e.");
  second = TrackingEnvironment({clip}, config, 2 * kLanes, kLanes, 12);
  second.load(archive, "e.");
  EXPECT_EQ(drive(first, 32, 1, 32), drive(second, 32, 1, 32));
}

TEST(TrackingEnvironment, RefusesTheStateOfOtherClipsOrCharacters) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(90), config);
  const auto longer = make_tracking_clip(swaying_reference(120), config);
  TrackingEnvironment saved({clip}, config, 2 * kLanes, kLanes, 12);
  Npz archive;
  saved.save(archive, "e.");
  TrackingEnvironment of_more_frames({longer}, config, 2 * kLanes, kLanes, 12),
      in_one_group({clip}, config, 2 * kLanes, 2 * kLanes, 12),
      of_more({clip}, config, 3 * kLanes, kLanes, 12);
  for (TrackingEnvironment* other : {&of_more_frames, &in_one_group, &of_more})
    EXPECT_THROW(other->load(archive, "e."), DataError);
  archive.set("e.next_clip", NpyArray::scalar_int(7));
  EXPECT_THROW(saved.load(archive, "e."), DataError);
}

TEST(TrackingEnvironment, EndsEpisodesAtFallsAndAtTheClipsEnd) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(12), config);
  TrackingEnvironment environment({clip}, config, kLanes, kLanes, 14);
  StepResult result(kLanes, kStateSize);
  bool truncated = false;
  for (int t = 0; t < 12; ++t) {
    environment.step(0, nn::Matrix<float>::Zero(kLanes, kDofs), result);
    EXPECT_FALSE(result.terminated.any()) << "standing on the reference for 0.4 s is no fall";
    truncated = truncated || result.truncated.any();
  }
  EXPECT_TRUE(truncated);

  config.terminate_distance = 0.02;
  TrackingEnvironment strict({clip}, config, kLanes, kLanes, 14);
  strict.step(0, nn::Matrix<float>::Constant(kLanes, kDofs, 2.0F), result);
  EXPECT_TRUE(result.terminated.all());
  EXPECT_FALSE(result.truncated.any());
}

// A character whose simulation is flagged, here as run away, ends its episode in the same frame, earns
// nothing for it and touches nobody else's bits. No distance ends an episode in this test.
TEST(TrackingEnvironment, ACharacterWhoseSimulationGoesWrongIsTerminatedAlone) {
  TrackingConfig config;
  config.terminate_distance = 100.0;
  config.simulation.max_speed = 1.0;  // m/s, and 6 rad/s of any joint
  const auto clip = make_tracking_clip(swaying_reference(90), config);
  TrackingEnvironment healthy({clip}, config, kLanes, kLanes, 16), ill({clip}, config, kLanes, kLanes, 16);
  StepResult fine(kLanes, kStateSize), wrong(kLanes, kStateSize);
  nn::Matrix<float> fine_states(kLanes, kStateSize), wrong_states(kLanes, kStateSize);
  const int victim = 2;
  for (int t = 0; t < 12; ++t) {
    nn::Matrix<float> actions = nn::Matrix<float>::Constant(kLanes, kDofs, 0.02F);
    healthy.step(0, actions, fine);
    actions.row(victim).setConstant(2.0F);
    ill.step(0, actions, wrong);
    EXPECT_FALSE(fine.terminated.any()) << t;
    EXPECT_TRUE(wrong.terminated[victim]) << t;
    EXPECT_FALSE(wrong.truncated[victim]) << t;
    EXPECT_EQ(wrong.reward[victim], 0.0F) << t;
    healthy.observe(0, fine_states);
    ill.observe(0, wrong_states);
    EXPECT_TRUE(wrong_states.allFinite()) << "the next episode starts from the reference";
    for (int n = 0; n < kLanes; ++n) {
      if (n == victim) continue;
      EXPECT_EQ(wrong.reward[n], fine.reward[n]) << t << " " << n;
      EXPECT_FALSE(wrong.terminated[n]) << t << " " << n;
      EXPECT_TRUE((wrong_states.row(n).array() == fine_states.row(n).array()).all()) << t << " " << n;
    }
  }
}

TEST(TrackingEnvironment, StartWeightsAreAProbabilityThatFavoursWhatLeadsToFalls) {
  const std::vector<double> even = start_weights({0, 0, 0, 0}, 0.4);
  for (double w : even) EXPECT_DOUBLE_EQ(w, 0.25);
  const std::vector<double> weights = start_weights({0, 0, 0, 0.1, 0, 0}, 0.4);
  double total = 0.0;
  for (double w : weights) total += w;
  EXPECT_NEAR(total, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(weights[0], 0.4 / 6.0);
  EXPECT_DOUBLE_EQ(weights[5], 0.4 / 6.0);
  EXPECT_GT(weights[3], weights[2]);
  EXPECT_GT(weights[2], weights[1]);
  EXPECT_GT(weights[1], weights[0]);
}

/// Frames that the characters of an environment, all of which fall at every step, reach with their next step:
/// one after those they have been set to. By bins.
std::vector<std::int64_t> first_frames_reached(TrackingEnvironment& environment) {
  StepResult result(environment.group_size(), kStateSize);
  for (int g = 0; g < environment.groups(); ++g)
    environment.step(g, nn::Matrix<float>::Zero(environment.group_size(), kDofs), result);
  environment.end_iteration();
  return environment.statistics().visits[0];
}

/// Σ (found − expected)² / expected of starts drawn by bin weights, evenly within a bin, in a clip of whole
/// bins.
double chi_squared(const std::vector<double>& weights, int bin_frames, int frames,
                   const std::vector<std::int64_t>& reached) {
  std::vector<double> expected(weights.size());
  std::int64_t all = 0;
  for (const std::int64_t n : reached) all += n;
  for (int frame = 0; frame < frames; ++frame)  // the last two frames are too late for a start
    expected[static_cast<std::size_t>((std::min(frame, frames - 2) + 1) / bin_frames)] +=
        static_cast<double>(all) * weights[static_cast<std::size_t>(frame / bin_frames)] / bin_frames;
  double sum = 0.0;
  for (std::size_t b = 0; b < weights.size(); ++b) {
    const double off = static_cast<double>(reached[b]) - expected[b];
    sum += off * off / expected[b];
  }
  return sum;
}

TEST(TrackingEnvironment, EpisodesStartAllOverTheClipAndMoreOftenWhereTheCharacterFell) {
  TrackingConfig config;
  config.terminate_distance =
      0.0;  // nobody is exactly on the reference: every step is a fall and a new start
  const int frames = 60;
  const auto clip = make_tracking_clip(swaying_reference(frames), config);
  TrackingEnvironment environment({clip}, config, 2048, 512, 17);
  constexpr double kUnlikely = 25.0;  // of 5 degrees of freedom: 1 in 7000
  EXPECT_LT(
      chi_squared(start_weights(std::vector<double>(6), 0.4), 10, frames, first_frames_reached(environment)),
      kUnlikely);

  const std::vector<double> rates = {0, 0, 0, 0.5, 0, 0};
  Npz state;
  environment.save(state, "e.");
  state.set("e.fall_rates0", NpyArray::from_double({6}, rates.data()));
  environment.load(state, "e.");
  first_frames_reached(environment);  // falls, and starts anew where the falls are said to be
  const std::vector<std::int64_t> reached = first_frames_reached(environment);
  EXPECT_LT(chi_squared(start_weights(rates, config.uniform_starts), 10, frames, reached), kUnlikely);
  EXPECT_GT(chi_squared(start_weights(std::vector<double>(6), 0.4), 10, frames, reached), 10.0 * kUnlikely);
}

TEST(TrackingEnvironment, LearnsWhereItFalls) {
  TrackingConfig config;
  config.terminate_distance = 0.02;  // holds for a few steps only, wherever the character starts
  const auto clip = make_tracking_clip(swaying_reference(100), config);
  TrackingEnvironment environment({clip}, config, 2 * kLanes, kLanes, 15);
  drive(environment, 32, 1);
  double fall_rate = 0.0;
  for (double rate : environment.fall_rates()[0]) fall_rate += rate;
  EXPECT_GT(fall_rate, 0.0);
  std::int64_t visits = 0;
  for (std::int64_t bin : environment.statistics().visits[0]) visits += bin;
  EXPECT_EQ(visits, environment.statistics().steps);
  EXPECT_EQ(environment.statistics().steps, 16 * 2 * kLanes);
}

TEST(TrackingRollout, FollowsAStandingReferenceAndReportsTheForcesThatCarryIt) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(16), config);
  const TrackingRollout rollout = roll_out(
      clip, config, [](int, const float*, float* action) { std::fill(action, action + kDofs, 0.0F); });
  ASSERT_EQ(rollout.poses.size(), 16U);
  EXPECT_FALSE(rollout.broken);
  EXPECT_LT(rollout.worst_distance, 0.15);
  double vertical = 0.0;  // mean over the last frames: the floor carries the weight
  for (std::size_t t = 8; t < 16; ++t)
    for (const Vector6d& wrench : rollout.forces[t].ground) vertical += wrench[5] / 8.0;
  const double weight = clip->reference.character.total_mass() * 9.81;
  EXPECT_NEAR(vertical, weight, 0.25 * weight);
}

}  // namespace
}  // namespace mimicx::rl
