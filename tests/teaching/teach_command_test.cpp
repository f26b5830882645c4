// Options taught by plans: from motions, or from plans that are there.
#include "teaching/teach_command.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "pipeline/options/option_set.h"
#include "program/small_run.h"
#include "record/manifest.h"
#include "rl/tracking/tracking_rollout.h"
#include "run/results.h"
#include "teaching/plan_teachers.h"

namespace mimicx::teaching {
namespace {

/// What the message of its exception says.
template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

struct Teach : testing::Test {
  /// The motions of all tests, made once.
  static std::filesystem::path made_motion(int frames) {
    static const TemporaryFolder made;
    const std::filesystem::path file = made.path / ("stand" + std::to_string(frames) + ".npz");
    if (!std::filesystem::exists(file)) motion::write_clip(file, motion::standing_clip(frames));
    return file;
  }
  TeachConfig teaching(const std::string& out) const {
    TeachConfig config = program::teach_configuration();
    for (int frames : {20, 24, 28}) config.planning.run.inputs.push_back(made_motion(frames).string());
    config.out = folder.path / out;
    config.school.hidden = {16, 16};
    config.visits = 2;  // three rounds of two motions
    config.school.packs = 2;
    config.school.regression.minibatch = 64;
    config.planning.run.threads = 1;
    return config;
  }
  static program::Outcome run(const TeachConfig& config, int asked = -1) {
    return program::run_in_context(
        [&](const record::RunContext& context) { return teach_options(config, context); }, asked);
  }
  /// What `run(teaching(name))` leaves; taught once for all tests.
  void teach_once(const std::string& name) const {
    static const TemporaryFolder made;
    if (std::filesystem::is_empty(made.path)) {
      TeachConfig config = teaching(name);
      config.out = made.path;
      EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
    }
    std::filesystem::copy(made.path, out(name), std::filesystem::copy_options::recursive);
  }
  std::filesystem::path out(const std::string& name) const { return folder.path / name; }

  TemporaryFolder folder;
};

TEST_F(Teach, LeavesEveryFileTheDocumentationNamesAndOptionsThatAdaptReads) {
  teach_once("run");
  const auto files = run::results_of(out("run"));
  for (const char* name : {"options.npz", "clusters.json", "manifest.json", "training/option0.csv",
                           "checkpoints/option0.npz", "plans/manifest.json", "plans/gains/stand20.npz"})
    EXPECT_TRUE(files.contains(name)) << name;
  const auto set = pipeline::options::read_options(out("run"));
  ASSERT_EQ(set->options.size(), 1u);
  EXPECT_EQ(set->options[0].motions, 3);
  EXPECT_FALSE(set->options[0].option.encoder.has_value());
  EXPECT_GT(set->options[0].samples, 3 * 2 * 8 * 19);
}

TEST_F(Teach, IsTheSameBytesForOneAndTwoThreadsAndAfterInterruptions) {
  teach_once("one");
  TeachConfig config = teaching("two");
  config.planning.run.threads = 2;
  int interruptions = 0;
  for (int asked : {1, 3, 7, 60, 100})
    interruptions += run(config, asked).value == record::RunOutcome::kInterrupted ? 1 : 0;
  EXPECT_GT(interruptions, 2);
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  for (const auto& [name, bytes] : run::results_of(out("one")))
    if (!name.starts_with("plans/")) {
      EXPECT_TRUE(run::results_of(out("two")).at(name) == bytes) << name;
    }
}

TEST_F(Teach, ExistingPlansGiveTheSameOptions) {
  teach_once("run");
  TeachConfig config = teaching("again");
  config.plans = {(out("run") / "plans").string()};
  config.planning.run.inputs.clear();
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  EXPECT_EQ(read_file(out("again") / "options.npz"), read_file(out("run") / "options.npz"));
}

TEST_F(Teach, KeepsAFinishedRunAndRejectsOtherSettings) {
  teach_once("run");
  const auto written = std::filesystem::last_write_time(out("run") / "options.npz");
  EXPECT_NE(run(teaching("run")).messages.find("taught already"), std::string::npos);
  EXPECT_EQ(std::filesystem::last_write_time(out("run") / "options.npz"), written);
  TeachConfig config = teaching("run");
  config.visits = 3;
  EXPECT_NE(refusal([&] { run(config); }).find("school_visits"), std::string::npos);
}

TEST_F(Teach, CheckpointsOfOtherSettingsAreNotContinued) {
  teach_once("run");
  for (const char* file : {"manifest.json", "options.npz"}) std::filesystem::remove(out("run") / file);
  TeachConfig config = teaching("run");
  config.school.seed += 1;
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  config.out = out("fresh");
  config.plans = {(out("run") / "plans").string()};
  config.planning.run.inputs.clear();
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  EXPECT_TRUE(read_file(out("run") / "options.npz") == read_file(out("fresh") / "options.npz"));
}

TEST_F(Teach, SeedAlsoControlsTheClusters) {
  teach_once("run");
  using pipeline::options::read_clusters;
  EXPECT_EQ(read_clusters(out("run") / "clusters.json").settings.seed, 0u) << "as of the shipped options";
  TeachConfig config = teaching("seeded");
  config.plans = {(out("run") / "plans").string()};
  config.planning.run.inputs.clear();
  config.school.seed = 7;
  run(config);
  EXPECT_EQ(read_clusters(out("seeded") / "clusters.json").settings.seed, 7u);
}

TEST_F(Teach, FolderWithoutPlansErrorNamesTheCommand) {
  TeachConfig config = teaching("run");
  config.planning.run.inputs.clear();
  plan::PlanMotionsConfig plan = plan::plan_configuration();
  plan.run.inputs = {made_motion(20).string()};
  plan.run.out = out("plans");
  program::run_in_context(
      [&](const record::RunContext& context) { return plan::plan_motions(plan, context); });
  config.plans = {out("plans").string()};
  EXPECT_NE(refusal([&] { run(config); }).find("--gains"), std::string::npos);
}

TEST_F(Teach, SaysWhichPlansItLeavesOutAndWhy) {
  teach_once("run");
  const record::RunFolder plans{out("run") / "plans"};
  std::filesystem::remove(plans.gains("stand20"));
  record::Manifest manifest = record::read_manifest(plans.manifest());
  for (record::SequenceEntry& entry : manifest.sequences)
    if (entry.name == "stand24") entry.ending = record::SequenceEnding::kLost;
  write_file_atomically(plans.manifest(), record::format_manifest(manifest));
  TeachConfig config = teaching("again");
  config.plans = {plans.root.string()};
  config.planning.run.inputs.clear();
  const program::Outcome taught = run(config);
  EXPECT_EQ(taught.value, record::RunOutcome::kAllGood);
  const auto said = [&](const std::string& line) {
    return taught.messages.find(line + '\n') != std::string::npos;
  };
  EXPECT_TRUE(said(plans.plan("stand20").string() + ": left out: it has no feedback gains"));
  EXPECT_TRUE(said(plans.plan("stand24").string() + ": left out: it was not followed to the end"));
  EXPECT_EQ(taught.messages.find("stand28.npz: left out"), std::string::npos);
}

TEST_F(Teach, TeacherOnTheReferenceRepeatsThePlan) {
  teach_once("run");
  const std::vector<PlannedMotion> motions = followed_plans({out("run") / "plans"});
  ASSERT_EQ(motions.size(), 3u);
  const Teacher teacher = read_teacher(motions[1], {});
  std::size_t t = 0;
  const auto made = rl::tracking::roll_out(teacher.clip, {}, [&](int, const float*, float* action) {
    std::copy_n(teacher.motion.u[static_cast<int>(t)].begin(), kDofs, action);
    ++t;
  });
  ASSERT_EQ(static_cast<int>(made.poses.size()), teacher.motion.x.count());
  for (std::size_t k = 0; k < made.poses.size(); ++k)
    EXPECT_EQ(made.poses[k].frame.p_root.cast<float>(),
              physics::to_eigen(teacher.motion.x[static_cast<int>(k)].p_root).cast<float>());
  EXPECT_NEAR(teacher.importance.front().trace(), kDofs, 1e-2);
}

TEST_F(Teach, TeacherOnThePlannedMotionRepeatsIt) {
  teach_once("run");
  const PlannedMotion motion = followed_plans({out("run") / "plans"})[1];
  const Teacher teacher = read_teacher(motion, {}, Followed::kPlan);
  const motion::Reference planned = reference_of(motion, Followed::kPlan);
  ASSERT_EQ(planned.frames.count(), teacher.motion.x.count());
  for (int t = 0; t < planned.frames.count(); ++t) {
    EXPECT_EQ(planned.frames[t].p_root, physics::to_eigen(teacher.motion.x[t].p_root)) << t;
    EXPECT_EQ(teacher.clip->reference.frames[t].p_root, planned.frames[t].p_root) << t;
  }
  int t = 0;
  const auto made = rl::tracking::roll_out(teacher.clip, {}, [&](int, const float*, float* action) {
    std::copy_n(teacher.motion.u[t++].begin(), kDofs, action);
  });
  EXPECT_LT(made.worst_distance, 0.003);  // targets differ from the plan's in their last bits
  EXPECT_GT((reference_of(motion).frames[t].p_root - planned.frames[t].p_root).norm(), 0.0);
}

TEST_F(Teach, FollowPlanShowsThePupilThePlannedMotions) {
  teach_once("run");
  TeachConfig config = teaching("behind");
  apply_setting(config, "school_follow_plan", 1);
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  EXPECT_NE(read_file(out("behind") / "options.npz"), read_file(out("run") / "options.npz"));
}

TEST_F(Teach, RejectsAPlanOfAnotherSimulation) {
  teach_once("run");
  rl::tracking::TrackingConfig task;
  task.simulation.friction *= 0.5;
  EXPECT_THROW(read_teacher(followed_plans({out("run") / "plans"}).front(), task), DataError);
}

}  // namespace
}  // namespace mimicx::teaching
