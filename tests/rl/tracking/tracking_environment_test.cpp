#include "rl/tracking/tracking_environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::rl::tracking {
namespace {

/// Steps an environment with fixed actions. @return all rewards
std::vector<float> drive(TrackingEnvironment& environment, int steps, int threads, int first_step = 0) {
  List<StepResult> results(static_cast<std::size_t>(environment.groups()),
                           StepResult(environment.group_size(), environment.observation_dim()));
  std::vector<float> rewards;
  for (int t = first_step; t < first_step + steps; ++t) {
    parallel_for(environment.groups(), threads, [&](int g) {
      nn::Matrix<float> actions(environment.group_size(), kDofs);
      Random random(9, {static_cast<std::uint64_t>(t), static_cast<std::uint64_t>(g)});
      for (int k = 0; k < actions.size(); ++k) actions.data()[k] = static_cast<float>(0.3 * random.normal());
      environment.step(g, actions, results[g]);
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
  TrackingEnvironment one({clip}, config, 4 * physics::kLanes, 2 * physics::kLanes, 11),
      two({clip}, config, 4 * physics::kLanes, 2 * physics::kLanes, 11);
  EXPECT_EQ(drive(one, 48, 1), drive(two, 48, 2));
}

TEST(TrackingEnvironment, ContinuesBitIdenticallyAfterSaveAndLoad) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(90), config);
  TrackingEnvironment first({clip}, config, 2 * physics::kLanes, physics::kLanes, 12),
      second({clip}, config, 2 * physics::kLanes, physics::kLanes, 13);
  drive(first, 32, 1);
  Npz archive;
  first.save(archive, "e.");
  second = TrackingEnvironment({clip}, config, 2 * physics::kLanes, physics::kLanes, 12);
  second.load(archive, "e.");
  EXPECT_EQ(drive(first, 32, 1, 32), drive(second, 32, 1, 32));
}

TEST(TrackingEnvironment, RejectsTheStateOfOtherClipsOrCharacters) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(90), config);
  const auto longer = make_tracking_clip(swaying_reference(120), config);
  TrackingEnvironment saved({clip}, config, 2 * physics::kLanes, physics::kLanes, 12);
  Npz archive;
  saved.save(archive, "e.");
  TrackingEnvironment of_more_frames({longer}, config, 2 * physics::kLanes, physics::kLanes, 12),
      in_one_group({clip}, config, 2 * physics::kLanes, 2 * physics::kLanes, 12),
      of_more({clip}, config, 3 * physics::kLanes, physics::kLanes, 12);
  for (TrackingEnvironment* other : {&of_more_frames, &in_one_group, &of_more})
    EXPECT_THROW(other->load(archive, "e."), DataError);
  archive.set("e.next_clip", NpyArray::scalar_int(7));
  EXPECT_THROW(saved.load(archive, "e."), DataError);
}

TEST(TrackingEnvironment, RejectsFramesOutsideTheClip) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(90), config);
  TrackingEnvironment environment({clip}, config, physics::kLanes, physics::kLanes, 12);
  Npz archive;
  environment.save(archive, "e.");
  const std::string key = "e.group0.pack0";
  const std::vector<double> sound = archive.at(key).to_double();
  const std::size_t frame = sound.size() - 2;  // that of the last lane
  const int frames = clip->size();             // the pose behind them, at rest, is a target alone
  // As a float, the number next to `frames` is `frames` itself.
  for (const double bad : {-1.0, 1.0 * frames, frames - 1e-9, 1e300, std::nan("")}) {
    std::vector<double> values = sound;
    values[frame] = bad;
    archive.set(key, NpyArray::from_double({values.size()}, values.data()));
    EXPECT_THROW(environment.load(archive, "e."), DataError) << bad;
  }
  archive.set(key, NpyArray::from_double({sound.size()}, sound.data()));
  EXPECT_NO_THROW(environment.load(archive, "e."));
}

TEST(TrackingEnvironment, EndsEpisodesAtFallsAndAtTheClipsEnd) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(12), config);
  TrackingEnvironment environment({clip}, config, physics::kLanes, physics::kLanes, 14);
  StepResult result(physics::kLanes, kStateSize);
  bool truncated = false;
  for (int t = 0; t < 12; ++t) {
    environment.step(0, nn::Matrix<float>::Zero(physics::kLanes, kDofs), result);
    EXPECT_FALSE(result.terminated.any()) << "standing on the reference for 0.4 s is no fall";
    truncated = truncated || result.truncated.any();
  }
  EXPECT_TRUE(truncated);

  config.terminate_distance = 0.02;
  TrackingEnvironment strict({clip}, config, physics::kLanes, physics::kLanes, 14);
  strict.step(0, nn::Matrix<float>::Constant(physics::kLanes, kDofs, 2.0F), result);
  EXPECT_TRUE(result.terminated.all());
  EXPECT_FALSE(result.truncated.any());
}

// A character whose simulation is flagged, here as a runaway, terminates in the same frame with reward 0, and
// changes no bits of others. No distance ends an episode in this test.
TEST(TrackingEnvironment, TerminatesAFailedCharacterAndNoOther) {
  TrackingConfig config;
  config.terminate_distance = 100.0;
  config.simulation.max_speed = 1.0;
  config.simulation.max_joint_speed = 6.0;
  const auto clip = make_tracking_clip(swaying_reference(90), config);
  TrackingEnvironment healthy({clip}, config, physics::kLanes, physics::kLanes, 16),
      ill({clip}, config, physics::kLanes, physics::kLanes, 16);
  StepResult fine(physics::kLanes, kStateSize), wrong(physics::kLanes, kStateSize);
  nn::Matrix<float> fine_states(physics::kLanes, kStateSize), wrong_states(physics::kLanes, kStateSize);
  const int victim = 2;
  for (int t = 0; t < 12; ++t) {
    nn::Matrix<float> actions = nn::Matrix<float>::Constant(physics::kLanes, kDofs, 0.02F);
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
    for (int n = 0; n < physics::kLanes; ++n) {
      if (n == victim) continue;
      EXPECT_EQ(wrong.reward[n], fine.reward[n]) << t << " " << n;
      EXPECT_FALSE(wrong.terminated[n]) << t << " " << n;
      EXPECT_TRUE((wrong_states.row(n).array() == fine_states.row(n).array()).all()) << t << " " << n;
    }
  }
}

/// [bin] counts of the frames that the characters of an environment reach with their next step, one frame
/// after their start; all of them fall at every step.
List<std::int64_t> first_frames_reached(TrackingEnvironment& environment) {
  StepResult result(environment.group_size(), kStateSize);
  for (int g = 0; g < environment.groups(); ++g)
    environment.step(g, nn::Matrix<float>::Zero(environment.group_size(), kDofs), result);
  environment.end_iteration();
  return environment.statistics().visits[0];
}

/// Σ (found − expected)² / expected of starts drawn by bin weights, evenly over the frames of a bin in which
/// an episode can start: all of the clip but the last.
double chi_squared(const List<double>& weights, int bin_frames, int frames,
                   const List<std::int64_t>& reached) {
  List<double> expected(weights.size());
  std::int64_t all = 0;
  for (const std::int64_t n : reached) all += n;
  for (int frame = 0; frame < frames - 1; ++frame) {
    const int bin = frame / bin_frames, starts = std::min(frames - 1 - bin * bin_frames, bin_frames);
    expected[(frame + 1) / bin_frames] += static_cast<double>(all) * weights[bin] / starts;
  }
  double sum = 0.0;
  for (int b = 0; b < weights.count(); ++b) {
    const double off = static_cast<double>(reached[b]) - expected[b];
    sum += off * off / expected[b];
  }
  return sum;
}

TEST(TrackingEnvironment, EpisodesStartEverywhereAndMoreOftenBeforeFalls) {
  TrackingConfig config;
  config.terminate_distance = 0.0;  // every step is a fall and a new start
  const int frames = 60;
  const auto clip = make_tracking_clip(swaying_reference(frames), config);
  TrackingEnvironment environment({clip}, config, 2048, 512, 17);
  List<double> evenly(6, 10.0 / 59);
  evenly[5] = 9.0 / 59;
  constexpr double kUnlikely = 25.0;  // of 5 degrees of freedom: 1 in 7000
  EXPECT_LT(chi_squared(evenly, 10, frames, first_frames_reached(environment)), kUnlikely);

  const List<double> rates = {0, 0, 0, 0.5, 0, 0};
  Npz state;
  environment.save(state, "e.");
  state.set("e.fall_rates0", NpyArray::from_double({6}, rates.data()));
  environment.load(state, "e.");
  first_frames_reached(environment);  // all fall and restart by the given fall rates
  const List<std::int64_t> reached = first_frames_reached(environment);
  // Two fifths start anywhere; the rest in the bin of the falls and the two before it, as 10 : 7 : 4
  // (docs/method.md §7, "Episodes").
  const double even = 0.4 / 59, hard = 0.6 / 21;
  EXPECT_LT(chi_squared({10 * even, 10 * even + 4 * hard, 10 * even + 7 * hard, 10 * even + 10 * hard,
                         10 * even, 9 * even},
                        10, frames, reached),
            kUnlikely);
  EXPECT_GT(chi_squared(evenly, 10, frames, reached), 10.0 * kUnlikely);
}

// A bin of starts that only the clip's last frames are in would otherwise take its whole share there: of 41
// frames a fifth began one step before the end.
TEST(TrackingEnvironment, EpisodesStartEverywhereInAClipOfPartsOfBins) {
  TrackingConfig config;
  config.terminate_distance = 0.0;
  constexpr double kUnlikely = 25.0;
  for (const int frames : {41, 43}) {
    TrackingEnvironment environment({make_tracking_clip(swaying_reference(frames), config)}, config, 2048,
                                    512, 17);
    List<double> evenly;
    for (int first = 0; first < frames; first += 10)
      evenly.push_back(std::min(frames - 1 - first, 10) / (frames - 1.0));
    EXPECT_LT(chi_squared(evenly, 10, frames, first_frames_reached(environment)), kUnlikely) << frames;
  }
}

TEST(TrackingEnvironment, RecordsWhereCharactersFall) {
  TrackingConfig config;
  config.terminate_distance = 0.02;  // a character stays within it for a few steps only
  const auto clip = make_tracking_clip(swaying_reference(100), config);
  TrackingEnvironment environment({clip}, config, 2 * physics::kLanes, physics::kLanes, 15);
  drive(environment, 32, 1);
  double fall_rate = 0.0;
  for (double rate : environment.fall_rates()[0]) fall_rate += rate;
  EXPECT_GT(fall_rate, 0.0);
  std::int64_t visits = 0;
  for (std::int64_t bin : environment.statistics().visits[0]) visits += bin;
  EXPECT_EQ(visits, environment.statistics().steps);
  EXPECT_EQ(environment.statistics().steps, 16 * 2 * physics::kLanes);
}

/// `count` clips of 20 frames and more.
std::vector<std::shared_ptr<const TrackingClip>> short_clips(int count) {
  std::vector<std::shared_ptr<const TrackingClip>> clips;
  for (int k = 0; k < count; ++k) clips.push_back(make_tracking_clip(swaying_reference(20 + k), {}));
  return clips;
}

/// [clip] steps of characters on it, in iterations of one step.
List<std::int64_t> visits_after(int iterations, TrackingEnvironment& environment) {
  List<std::int64_t> visits;
  StepResult result(environment.group_size(), kStateSize);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    for (int g = 0; g < environment.groups(); ++g)
      environment.step(g, nn::Matrix<float>::Zero(environment.group_size(), kDofs), result);
    environment.end_iteration();
    const List<List<std::int64_t>>& bins = environment.statistics().visits;
    visits.resize(bins.size(), 0);
    for (int c = 0; c < bins.count(); ++c)
      for (const std::int64_t n : bins[c]) visits[c] += n;
  }
  return visits;
}

/// Episodes that each character has begun. [group][character]
std::vector<std::vector<double>> episodes_begun(const TrackingEnvironment& environment) {
  Npz state;
  environment.save(state, "");
  std::vector<std::vector<double>> episodes;
  for (int g = 0; g < environment.groups(); ++g)
    episodes.push_back(state.at("group" + std::to_string(g) + ".episodes").to_double());
  return episodes;
}

TEST(TrackingEnvironment, ReportsTheCharactersThatSwitchClips) {
  TrackingConfig config;
  TrackingEnvironment environment(short_clips(5), config, 4 * physics::kLanes, 2 * physics::kLanes, 3);
  std::size_t moved = 0;
  for (int iteration = 0; iteration < 32; ++iteration) {
    auto expected = episodes_begun(environment);
    const std::vector<CharacterPlace> named = environment.end_iteration();
    for (const auto& [group, character] : named)
      expected[static_cast<std::size_t>(group)][static_cast<std::size_t>(character)] += 1.0;
    EXPECT_EQ(episodes_begun(environment), expected) << iteration;
    moved += named.size();
  }
  EXPECT_EQ(moved, 2U * 4U * physics::kLanes) << "every pack has its turn once in 16 iterations";
}

TEST(TrackingEnvironment, RejectsIncompleteStates) {
  const auto clip = make_tracking_clip(swaying_reference(30), {});
  TrackingEnvironment environment({clip}, {}, physics::kLanes, physics::kLanes, 12);
  Npz whole;
  environment.save(whole, "e.");
  for (const auto& [key, array] : whole.members()) {
    Npz damaged = whole;
    NpyArray nothing;
    nothing.type = array.type;
    nothing.shape = {0};
    damaged.set(key, nothing);
    EXPECT_THROW(environment.load(damaged, "e."), DataError) << key;
  }
}

TEST(TrackingEnvironment, RejectsTextAndFractionsInStates) {
  const auto clip = make_tracking_clip(swaying_reference(30), {});
  TrackingEnvironment environment({clip}, {}, physics::kLanes, physics::kLanes, 12);
  Npz whole;
  environment.save(whole, "e.");
  const auto with = [&](const std::string& key, const NpyArray& array) {
    Npz damaged = whole;
    damaged.set(key, array);
    return damaged;
  };
  std::vector<double> episodes = whole.at("e.group0.episodes").to_double();
  EXPECT_THROW(environment.load(with("e.group0.episodes",
                                     NpyArray::from_text(std::vector<std::string>(episodes.size(), "1"))),
                                "e."),
               DataError);
  for (const double wrong : {0.5, 1e300, std::nan("")}) {
    episodes[1] = wrong;
    EXPECT_THROW(
        environment.load(with("e.group0.episodes", NpyArray::from_double({episodes.size()}, episodes.data())),
                         "e."),
        DataError)
        << wrong;
  }
  EXPECT_NO_THROW(environment.load(whole, "e."));
}

TEST(TrackingEnvironment, HasAsManyAgentsAsTheArrangementNames) {
  auto clip = std::make_shared<TrackingClip>(*make_tracking_clip(swaying_reference(24), {}));
  EXPECT_EQ(TrackingEnvironment({clip}, {}, physics::kLanes, physics::kLanes, 5).agents(), 1);
  clip->arrangement.assign(24, 0);
  clip->arrangement.back() = 2;
  EXPECT_EQ(TrackingEnvironment({clip}, {}, physics::kLanes, physics::kLanes, 5).agents(), 3);
}

TEST(TrackingEnvironment, PacksTakeTurnsOverMoreClipsThanPacks) {
  TrackingConfig config;
  TrackingEnvironment environment(short_clips(5), config, 2 * physics::kLanes, physics::kLanes, 3);
  const List<std::int64_t> visits = visits_after(64, environment);
  for (int c = 0; c < 5; ++c) EXPECT_GE(visits[c], 16 * physics::kLanes) << "clip " << c;
}

TEST(TrackingEnvironment, FewerClipsThanPacksHaveEqualShares) {
  TrackingConfig config;
  TrackingEnvironment environment(short_clips(3), config, 4 * physics::kLanes, 2 * physics::kLanes, 3);
  constexpr int kIterations = 3 * 16;  // every pack has followed every clip for as many
  const List<std::int64_t> visits = visits_after(kIterations, environment);
  for (const std::int64_t n : visits)
    EXPECT_NEAR(static_cast<double>(n), 64.0 * physics::kLanes, 4.0 * physics::kLanes);
}

TEST(TrackingEnvironment, SoftensTheRewardOfAHardMotionAndRestoresIt) {
  TrackingConfig config;
  config.reward_target = 0.999;  // a target that no reward reaches
  TrackingEnvironment hard({make_tracking_clip(swaying_reference(24), config)}, config, physics::kLanes,
                           physics::kLanes, 5);
  StepResult result(physics::kLanes, kStateSize);
  for (int k = 0; k < 20; ++k) {
    hard.step(0, nn::Matrix<float>::Constant(physics::kLanes, kDofs, 0.05F), result);
    hard.end_iteration();
  }
  EXPECT_NEAR(hard.sharpness(), std::pow(1.01, -20), 1e-12);
  EXPECT_GT(hard.statistics().learned_reward, hard.statistics().reward);
  config.reward_target = 0.01;  // a target that every reward exceeds
  TrackingEnvironment easy({make_tracking_clip(swaying_reference(24), config)}, config, physics::kLanes,
                           physics::kLanes, 5);
  Npz archive;
  hard.save(archive, "e.");
  easy.load(archive, "e.");
  for (int k = 0; k < 30; ++k) {
    easy.step(0, nn::Matrix<float>::Zero(physics::kLanes, kDofs), result);
    easy.end_iteration();
  }
  EXPECT_EQ(easy.sharpness(), 1.0);
}

}  // namespace
}  // namespace mimicx::rl::tracking
