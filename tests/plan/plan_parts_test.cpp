// What is kept of a motion that is lost.
#include "plan/plan_parts.h"

#include <gtest/gtest.h>

#include "core/npz/npz.h"
#include "core/temporary_folder.h"
#include "judge/evaluate.h"
#include "motion/clip_file.h"
#include "motion/prepare/prepare.h"
#include "motion/standing_clip.h"
#include "plan/plan_command.h"
#include "plan/plan_motion.h"
#include "program/small_run.h"
#include "run/results.h"
#include "run/sequence_run.h"

namespace mimicx::plan {
namespace {

constexpr int kAll = 150, kJump = 60;

/// Stands, is somewhere else from a frame on, and stands there.
motion::Clip jumping(int frames = kAll, int jump = kJump) {
  motion::Clip clip = motion::standing_clip(frames);
  for (int t = jump; t < frames; ++t) clip.trans[t].x() += 3.0;
  return clip;
}

TEST(FollowedFrames, EndWhereTheMotionDeparts) {
  const motion::Reference reference = motion::prepare_reference(motion::standing_clip(30), {}, nullptr);
  rl::tracking::TrackingRollout rollout;
  for (int t = 0; t < 30; ++t) {
    rl::tracking::Pose pose;
    pose.p_WB = reference.poses[t].p_WB;
    // Slowly away from frame 10 on: 20 mm in a frame; beyond 60 mm from frame 13 on.
    for (Vector3d& p : pose.p_WB) p.x() += 0.02 * std::max(0, t - 10) + 0.001;
    rollout.poses.push_back(pose);
  }
  EXPECT_EQ(followed_frames(reference, rollout), 13);
  for (std::size_t t = 10; t < 30; ++t) rollout.poses[t].p_WB = reference.poses[t].p_WB;
  EXPECT_EQ(followed_frames(reference, rollout), 30);
  rollout.poses[20].p_WB[kLeftWrist].z() += 0.51;  // farther than any body may be
  EXPECT_EQ(followed_frames(reference, rollout), 20);
  rollout.poses.resize(7);
  EXPECT_EQ(followed_frames(reference, rollout), 7);
}

struct LostMotion : testing::Test {
  LostMotion() {
    motion::write_clip(folder.path / "jump.npz", jumping());
    config = plan_configuration();
    config.run.inputs = {(folder.path / "jump.npz").string()};
    config.run.out = out;
    config.run.correction.as_is = true;
    config.planning.plan.horizon.backtracks = 1;
    config.planning.plan.assisted_stages = false;
  }
  program::Outcome run() const {
    return program::run_in_context(
        [&](const record::RunContext& context) { return plan_motions(config, context); });
  }

  TemporaryFolder folder;
  std::filesystem::path out = folder.path / "run";
  PlanMotionsConfig config;
};

TEST_F(LostMotion, LeavesWhatWasFollowedBeforeAndAfterAsParts) {
  const program::Outcome outcome = run();
  EXPECT_EQ(outcome.value, record::RunOutcome::kSomeFailed) << "parts do not count as followed";
  const record::SequenceEntry entry = record::read_manifest(out / "manifest.json").sequences.at(0);
  EXPECT_FALSE(entry.ok);
  EXPECT_EQ(entry.output, "rejected/jump.npz");
  ASSERT_EQ(entry.parts.size(), 2u) << outcome.messages;
  EXPECT_EQ(entry.parts[0][0], 0);
  EXPECT_LT(entry.parts[0][1], kJump);
  EXPECT_GE(entry.parts[0][1], 29) << "a second at least";
  EXPECT_GE(entry.parts[1][0], kJump);
  EXPECT_EQ(entry.parts[1][1], kAll - 1);

  const motion::Clip reference = motion::read_clip(out / "references" / "jump.npz");
  for (std::size_t k = 0; k < 2; ++k) {
    const std::filesystem::path file = out / "motions" / ("jump.part" + std::to_string(k + 1) + ".npz");
    const motion::Clip part = motion::read_clip(file);
    const auto [first, last] = entry.parts[k];
    ASSERT_EQ(part.frames(), last - first + 1);
    for (int t = 0; t < part.frames(); ++t)
      EXPECT_LT((part.trans[t] - reference.trans[first + t]).norm(), 0.06) << k << ' ' << t;
    EXPECT_TRUE(read_npz(file).has("ground_wrenches"));
    EXPECT_TRUE(std::any_of(entry.files.begin(), entry.files.end(),
                            [&](const auto& f) { return f.first == "motions/" + file.filename().string(); }));
  }
  EXPECT_FALSE(std::filesystem::exists(out / "motions" / "jump.part3.npz"));

  const std::string told = "frames " + std::to_string(entry.parts[1][0]) + "-149 in motions/jump.part2.npz";
  EXPECT_NE(outcome.messages.find(told), std::string::npos) << outcome.messages;
  EXPECT_NE(read_file(out / "report.html").find(told), std::string::npos);
  EXPECT_TRUE(judge::evaluate_folders(folder.path / "jump.npz", out / "motions").motions.empty())
      << "parts are no motions of the truth";
}

// The method of this test says of a lost plan that the time limit ended it, so that no clock decides.
TEST_F(LostMotion, TimeLimitLeavesTheBeginningAsAPart) {
  motion::write_clip(folder.path / "jump.npz", jumping(40, 35));
  run::Method method;
  method.name = "plan";
  method.simulation = config.planning.simulation;
  method.simulate = [&](const motion::Reference& reference, const run::SequenceJob& job) {
    run::SequenceJob unlimited = job;
    unlimited.limit_seconds = 0.0;
    run::SimulatedSequence made = plan_sequence(reference, config.planning, unlimited);
    made.ending = record::SequenceEnding::kLimitSeconds;
    return made;
  };
  method.parts = [&](const motion::Reference& reference, const rl::tracking::TrackingRollout& lost,
                     const run::SequenceJob& job) {
    return followed_parts(reference, config.planning, lost, job);
  };
  config.run.limit_seconds = 1e-9;
  const program::Outcome stopped = program::run_in_context(
      [&](const record::RunContext& context) { return run::run_sequences(config.run, method, context); });
  const record::SequenceEntry entry = record::read_manifest(out / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.ending, record::SequenceEnding::kLimitSeconds);
  ASSERT_EQ(entry.parts.size(), 1u) << stopped.messages;
  EXPECT_EQ(entry.parts[0][0], 0);
  EXPECT_GE(entry.parts[0][1], 29);
  EXPECT_TRUE(std::filesystem::exists(out / "motions" / "jump.part1.npz"));
  EXPECT_NE(stopped.messages.find("motions/jump.part1.npz"), std::string::npos) << stopped.messages;
}

TEST_F(LostMotion, ChangedInputThatFailsLeavesNoFileOfTheOldOne) {
  motion::write_clip(folder.path / "jump.npz", jumping(40, 35));
  run();
  ASSERT_TRUE(std::filesystem::exists(out / "motions" / "jump.part1.npz"));
  motion::write_clip(folder.path / "jump.npz", motion::standing_clip(1));
  EXPECT_EQ(run().value, record::RunOutcome::kSomeFailed);
  for (const auto& [name, bytes] : run::results_of(out))
    EXPECT_EQ(name.find("jump"), std::string::npos) << name;
  const record::SequenceEntry entry = record::read_manifest(out / "manifest.json").sequences.at(0);
  EXPECT_TRUE(entry.output.empty() && entry.parts.empty());
  EXPECT_NE(entry.reason.find("at least 2 frames"), std::string::npos) << entry.reason;
}

TEST_F(LostMotion, PartsAreTheSameAgainAndGoWithASuccess) {
  run();
  const auto files = run::results_of(out);
  std::filesystem::remove(out / "rejected" / "jump.npz");
  run();
  EXPECT_TRUE(run::results_of(out) == files);
  motion::write_clip(folder.path / "jump.npz", motion::standing_clip(40));
  EXPECT_EQ(run().value, record::RunOutcome::kAllGood);
  for (const auto& [name, bytes] : run::results_of(out))
    EXPECT_EQ(name.find("part"), std::string::npos) << name;
}

}  // namespace
}  // namespace mimicx::plan
