#include "program/adapt_command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/setting_checks.h"
#include "files/policy_file.h"
#include "judge/scores.h"
#include "motion/clip_file.h"
#include "motion/test_split.h"
#include "plan/plan_command.h"
#include "program/pretrained_options.h"
#include "report/glossary.h"
#include "run/results.h"

namespace mimicx::program {
namespace {

using Adapt = PretrainedOptions;

TEST_F(Adapt, RecordsArrangementEndingAndWhatTheOptionsDidBefore) {
  pretrain_once("options");
  adapt_once("budget", adapting("run", "options"));
  const record::Manifest manifest = record::read_manifest(out("run") / "manifest.json");
  EXPECT_EQ(manifest.options, pipeline::options::read_options(out("options"))->checksum);
  const record::SequenceEntry& entry = manifest.sequences.at(0);
  ASSERT_FALSE(entry.arrangement.empty());
  EXPECT_EQ(entry.arrangement.front()[0], 0);
  EXPECT_EQ(entry.ending, record::SequenceEnding::kBudget);
  EXPECT_FALSE(entry.metrics_before.empty());
  EXPECT_TRUE(entry.fit.empty()) << "no keypoints, no fit";
}

TEST_F(Adapt, KeepsTheClustersOfItsOptionsAndShowsThemInTheReport) {
  pretrain_once("options");
  AdaptConfig config = adapting("run", "options");
  config.training.samples = 0;
  run(config);
  EXPECT_EQ(read_file(out("run") / "clusters.json"), read_file(out("options") / "clusters.json"));
  const std::string page = read_file(out("run") / "report.html");
  EXPECT_NE(page.find("\"options\":[["), std::string::npos) << "the stretches of the arrangement";
}

/// The set, with policies that fall at once.
std::shared_ptr<const pipeline::options::OptionSet> falling(const pipeline::options::OptionSet& set) {
  const auto falls = std::make_shared<pipeline::options::OptionSet>(set);
  for (pipeline::options::TrainedOption& trained : falls->options)
    trained.option.agent.actor.biases.back().setConstant(2.0F);
  falls->checksum = "falls";
  return falls;
}

TEST_F(Adapt, TriesTheNextSetIfTheFirstDoesNotFollow) {
  pretrain_once("options");
  AdaptConfig config = adapting("second", "options");
  config.training.samples = 0;
  const auto follows = config.options.front();
  const auto falls = falling(*follows);
  config.options = {falls, follows};
  run(config);
  config.run.out = out("alone");
  config.options = {follows};
  run(config);
  config.run.out = out("first");
  config.options = {follows, falls};
  run(config);
  const auto manifest_in = [&](const char* name) {
    return record::read_manifest(out(name) / "manifest.json");
  };
  const record::SequenceEntry second = manifest_in("second").sequences.at(0),
                              alone = manifest_in("alone").sequences.at(0);
  EXPECT_EQ(second.metrics, alone.metrics);
  ASSERT_EQ(second.arrangement.size(), alone.arrangement.size());
  for (std::size_t i = 0; i < alone.arrangement.size(); ++i)
    EXPECT_EQ(second.arrangement[i],
              (std::array<int, 2>{alone.arrangement[i][0], alone.arrangement[i][1] + 2}));
  EXPECT_EQ(manifest_in("first").sequences.at(0).arrangement, alone.arrangement);
  const auto notes_of = [&](const char* name) {
    std::string all;
    const record::SequenceEntry entry = manifest_in(name).sequences.at(0);
    for (const std::string& note : entry.notes) all += note + "\n";
    return all;
  };
  EXPECT_NE(notes_of("second").find("options of set 2 of 2: "), std::string::npos) << notes_of("second");
  EXPECT_EQ(notes_of("first").find("options of set"), std::string::npos);
  EXPECT_EQ(manifest_in("second").options, "falls+" + follows->checksum);
  const pipeline::options::Clusters kept = pipeline::options::read_clusters(out("second") / "clusters.json");
  EXPECT_EQ(kept.clusters.size(), 4u) << "the map knows the options of both sets";
}

/// Names of the files that are not the same in both.
std::string differences(const std::map<std::string, std::string>& a,
                        const std::map<std::string, std::string>& b) {
  std::string names;
  for (const auto& [name, text] : a)
    if (!b.contains(name) || b.at(name) != text) names += name + " ";
  for (const auto& [name, text] : b)
    if (!a.contains(name)) names += name + " ";
  return names;
}

TEST_F(Adapt, TwoSetsGiveTheSameBytesAfterInterruptedSearches) {
  pretrain_once("options");
  AdaptConfig config = adapting("whole", "options");
  config.arrangement.selector = pipeline::options::Selector::kBeam;
  config.arrangement.beam_width = 3;
  const auto follows = config.options.front();
  config.options = {falling(*follows), follows};
  run(config);
  const auto whole = run::results_of(out("whole"));
  for (const int asked : {5, 40, 60}) {
    config.run.out = out("after " + std::to_string(asked));
    EXPECT_EQ(run(config, asked), record::RunOutcome::kInterrupted);
    run(config);
    EXPECT_EQ(differences(run::results_of(config.run.out), whole), "") << asked;
  }
}

/// Its search was cut, so it trained options that the whole search does not choose.
TEST_F(Adapt, DoesNotContinueATrainingOfOtherOptions) {
  pretrain_once("options");
  AdaptConfig config = adapting("hasty", "options");
  config.arrangement.selector = pipeline::options::Selector::kBeam;
  const auto follows = config.options.front();
  const auto falls = std::make_shared<pipeline::options::OptionSet>(*falling(*follows));
  falls->options.resize(1);
  config.options = {falls, follows};
  config.run.limit_seconds = 1e-9;
  run(config);
  EXPECT_TRUE(std::filesystem::exists(out("hasty") / "checkpoints" / "sway.npz"));
  config.run.limit_seconds = 0.0;
  run(config);
  config.run.out = out("fresh");
  run(config);
  EXPECT_EQ(differences(run::results_of(out("hasty")), run::results_of(out("fresh"))), "");
}

TEST_F(Adapt, UnreadableClustersOmitOnlyTheMap) {
  pretrain_once("options");
  AdaptConfig config = adapting("run", "options");
  config.training.samples = 0;
  const auto bad = std::make_shared<pipeline::options::OptionSet>(*config.options.front());
  bad->clusters = out("bad.json");
  write_file_atomically(bad->clusters, "{");
  config.options.push_back(bad);
  const Outcome outcome =
      run_in_context([&](const record::RunContext& context) { return adapt(config, context); });
  EXPECT_EQ(outcome.value, record::RunOutcome::kAllGood);
  EXPECT_NE(outcome.messages.find("bad.json"), std::string::npos) << outcome.messages;
  EXPECT_FALSE(std::filesystem::exists(out("run") / "clusters.json"));
}

TEST_F(Adapt, NamesTheSetTakenIfNoneFollows) {
  pretrain_once("options");
  AdaptConfig config = adapting("run", "options");
  config.training.samples = 0;
  const auto falls = falling(*config.options.front());
  config.options = {falls, falls};
  run(config);
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  const auto said = [&](const std::string& words) {
    return std::any_of(entry.notes.begin(), entry.notes.end(),
                       [&](const std::string& note) { return note.starts_with(words); });
  };
  EXPECT_FALSE(entry.ok);
  EXPECT_TRUE(said("options of set 1 of 2: none follows the motion"));
}

TEST_F(Adapt, SetWithoutClustersOmitsTheMap) {
  pretrain_once("options");
  AdaptConfig config = adapting("run", "options");
  config.training.samples = 0;
  const auto nameless = std::make_shared<pipeline::options::OptionSet>(*config.options.front());
  nameless->clusters.clear();
  config.options.push_back(nameless);
  run(config);
  EXPECT_FALSE(std::filesystem::exists(out("run") / "clusters.json"));
}

TEST_F(Adapt, ZeroBudgetLeavesTheOptionsUnchanged) {
  pretrain_once("options");
  AdaptConfig config = adapting("run", "options");
  config.training.samples = 0;
  run(config);
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.samples, 0);
  EXPECT_EQ(entry.reward_before, entry.reward_after);
  EXPECT_EQ(entry.output, "motions/sway.npz");
}

TEST_F(Adapt, IsTheSameBytesForOneAndTwoThreadsAndAfterInterruptions) {
  pretrain_once("options");
  AdaptConfig config = adapting("one", "options");
  adapt_once("budget", config);
  config.run.out = out("two");
  config.run.threads = 2;
  EXPECT_EQ(run(config, 3), record::RunOutcome::kInterrupted);
  run(config);
  EXPECT_EQ(run::results_of(out("one")), run::results_of(out("two")));
}

TEST_F(Adapt, MoreSamplesContinueTheSameTraining) {
  pretrain_once("options");
  AdaptConfig config = adapting("run", "options");
  adapt_once("budget", config);
  const std::string before = run::results_of(out("run")).at("training/sway.csv");
  config.training.samples *= 2;
  EXPECT_EQ(run(config), record::RunOutcome::kAllGood);
  const std::string after = run::results_of(out("run")).at("training/sway.csv");
  EXPECT_GT(after.size(), before.size());
  EXPECT_TRUE(after.starts_with(before)) << "its rows stay as they were";
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.samples, config.training.samples);
  config.training.seed += 1;
  EXPECT_THROW(run(config), std::invalid_argument) << "the budget alone may grow";
}

TEST_F(Adapt, NotesASmallerBudgetThatTheTrainingBeganWithAlsoIfItWasInterrupted) {
  pretrain_once("options");
  AdaptConfig config = adapting("run", "options");
  config.arrangement.selector = pipeline::options::Selector::kDp;  // it is not asked to stop
  EXPECT_EQ(run(config, 3), record::RunOutcome::kInterrupted);
  config.training.samples *= 2;
  EXPECT_EQ(run(config, 3), record::RunOutcome::kInterrupted);
  run(config);
  const auto notes_in = [&](const char* name) {
    return record::read_manifest(out(name) / "manifest.json").sequences.at(0).notes;
  };
  const auto tells = [](const std::string& note) {
    return note.starts_with("goes on from a training of 3072 samples");
  };
  const std::vector<std::string> notes = notes_in("run");
  EXPECT_EQ(std::count_if(notes.begin(), notes.end(), tells), 1);
  config.run.out = out("at once");
  EXPECT_EQ(run(config, 3), record::RunOutcome::kInterrupted);
  run(config);
  for (const std::string& note : notes_in("at once")) EXPECT_FALSE(note.starts_with("goes on")) << note;
}

// The search comes before the training: it must hear of an interrupt, and of the seconds that are over.
TEST_F(Adapt, BeamSearchIsInterruptibleAndCountsItsSeconds) {
  pretrain_once("options");
  AdaptConfig config = adapting("stopped", "options");
  config.arrangement.selector = pipeline::options::Selector::kBeam;
  config.arrangement.beam_width = 3;
  EXPECT_EQ(run(config, 2), record::RunOutcome::kInterrupted);
  EXPECT_FALSE(std::filesystem::exists(out("stopped") / "checkpoints" / "sway.npz")) << "no training yet";
  run(config);
  config.run.out = out("whole");
  run(config);
  EXPECT_EQ(run::results_of(out("stopped")), run::results_of(out("whole")));
  config.run.out = out("hasty");
  config.run.limit_seconds = 1e-9;
  run(config);
  const record::SequenceEntry entry = record::read_manifest(out("hasty") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.ending, record::SequenceEnding::kLimitSeconds);
  EXPECT_EQ(entry.arrangement, (std::vector<std::array<int, 2>>{{0, 0}}));
  bool said = false;
  for (const std::string& note : entry.notes)
    said = said || note.find("the search for options ended early, at frame 0 of 25: --limit-seconds") == 0;
  EXPECT_TRUE(said);
}

TEST_F(Adapt, RecordsThresholdAndStallEndings) {
  pretrain_once("options");
  AdaptConfig config = adapting("good", "options");
  config.training.stop_reward = 1e-9;  // whatever it does is good enough
  run(config);
  record::SequenceEntry entry = record::read_manifest(out("good") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.ending, record::SequenceEnding::kThreshold);
  EXPECT_EQ(entry.samples, 0) << "the options were good enough as they are";
  config = adapting("never", "options");
  config.training.stop_reward = 1.5;  // rewards are at most 1
  run(config);
  entry = record::read_manifest(out("never") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.ending, record::SequenceEnding::kBudget);
  EXPECT_GE(entry.samples, config.training.samples);
  config = adapting("stalled", "options");
  config.training.stall_evaluations = 1;
  config.training.ppo.step_size = config.training.ppo.step_max = config.training.ppo.step_min = 1e-30;
  run(config);
  EXPECT_EQ(record::read_manifest(out("stalled") / "manifest.json").sequences.at(0).ending,
            record::SequenceEnding::kStall);
}

TEST_F(Adapt, ResultDoesNotDependOnTheTruth) {
  for (const char* which : {"truth", "noisy"}) {
    std::filesystem::create_directories(out("data") / which);
    motion::write_clip(out("data") / which / "stand_1.npz", test::beginning_of_stand(which, 30));
  }
  pretrain_once("options");
  AdaptConfig config = adapting("with", "options");
  config.run.inputs = {(out("data") / "noisy" / "stand_1.npz").string()};
  run(config);
  std::filesystem::remove_all(out("data") / "truth");
  config.run.out = out("without");
  run(config);
  const auto with = run::results_of(out("with"));
  EXPECT_TRUE(with.contains("fits/stand_1.npz")) << "a clip with keypoints is fitted";
  EXPECT_EQ(with, run::results_of(out("without")));
}

TEST_F(Adapt, ResultDoesNotDependOnIgnoredKeypoints) {
  motion::Clip clip = test::beginning_of_stand("noisy", 30);
  for (const char* folder : {"seen", "blind"}) {
    std::filesystem::create_directories(out(folder));
    motion::write_clip(out(folder) / "stand_1.npz", clip);
    clip.keypoints.reset();
  }
  pretrain_once("options");
  const auto log_of = [&](const std::string& folder, const std::string& input, bool fit) {
    AdaptConfig config = adapting(folder, "options");
    config.run.correction.fit = fit;
    config.run.inputs = {(out(input) / "stand_1.npz").string()};
    run(config);
    return run::results_of(out(folder)).at("training/stand_1.csv");
  };
  const std::string unwanted = log_of("unwanted", "seen", false);
  EXPECT_EQ(unwanted, log_of("none", "blind", false));
  EXPECT_NE(unwanted, log_of("fitted", "seen", true));
}

TEST_F(Adapt, RejectsImpossibleArrangementSettings) {
  pretrain_once("options");
  for (const pipeline::options::ArrangementConfig& wrong :
       {pipeline::options::ArrangementConfig{0.1, {0.1}},
        pipeline::options::ArrangementConfig{std::nan(""), {0.1}},
        pipeline::options::ArrangementConfig{-1.0, {-0.1}}, pipeline::options::ArrangementConfig{-1.0, {1.1}},
        pipeline::options::ArrangementConfig{-1.0, {std::nan("")}}}) {
    AdaptConfig config = adapting("run", "options");
    config.arrangement = wrong;
    EXPECT_THROW(run(config), std::invalid_argument) << wrong.switch_penalty << ' ' << wrong.rescue.reward;
  }
  AdaptConfig config = adapting("run", "options");
  config.options = {};
  EXPECT_THROW(run(config), std::invalid_argument);
}

TEST_F(Adapt, RefusesOptionsOfTheOtherActions) {
  pipeline::PretrainConfig pretrained = pretraining("absolute");
  pretrained.training.tracking.actions.mode = rl::tracking::ActionMode::kAbsolute;
  pretrained.training.samples = 0;
  run(pretrained);
  AdaptConfig config = adapting("run", "absolute");
  EXPECT_NE(refusal_of([&] { run(config); })
                .find("expected policies trained with residual_actions=1, velocity_feed_forward=1, "
                      "target_ramp=1, found residual_actions=0"),
            std::string::npos);
  config.training.tracking.actions.mode = rl::tracking::ActionMode::kAbsolute;
  config.training.samples = 0;
  EXPECT_NE(run(config), record::RunOutcome::kInterrupted) << "these can be used";
  EXPECT_TRUE(std::filesystem::exists(out("run") / "manifest.json"));
  config = adapting("taught", "absolute");
  config.training.tracking.actions.mode = rl::tracking::ActionMode::kAbsolute;
  config.method = AdaptMethod::kAuto;
  config.teaching.teach = true;
  EXPECT_EQ(refusal_of([&] { run(config); }),
            "--policy: expected the actions of a plan, residual_actions=1, velocity_feed_forward=1, "
            "target_ramp=1, found residual_actions=0, velocity_feed_forward=1, target_ramp=1");
}

TEST_F(Adapt, MethodPlanNeedsNoOptionsAndMatchesPlan) {
  AdaptConfig config = adapt_configuration();
  config.method = AdaptMethod::kPlan;
  config.run.inputs = {(motions / "sway.npz").string()};
  config.run.out = out("run");
  EXPECT_EQ(run(config), record::RunOutcome::kAllGood);
  plan::PlanMotionsConfig planning{config.run, {config.plan, config.training.tracking.simulation}};
  planning.run.out = out("plan");
  run_in_context([&](const record::RunContext& context) { return plan::plan_motions(planning, context); });
  EXPECT_EQ(run::results_of(out("run")), run::results_of(out("plan")));
}

/// A plan that teaches a small student quickly.
AdaptConfig teaching_quickly(AdaptConfig config) {
  config.method = AdaptMethod::kAuto;
  config.teaching.teach = true;
  config.teaching.student.hidden = 32;
  config.teaching.student.rounds = 4;
  config.teaching.student.least_steps = 40;
  return config;
}

TEST_F(Adapt, FollowedPlanTeachesAPolicyWithoutOtherTraining) {
  pretrain_once("options");
  const AdaptConfig config = teaching_quickly(adapting("run", "options"));
  adapt_once("taught", config);
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.ending, record::SequenceEnding::kFollowed);
  EXPECT_TRUE(entry.arrangement.empty());
  EXPECT_FALSE(std::filesystem::exists(out("run") / "training")) << "no PPO where the student follows";
  EXPECT_EQ(value_of(entry.policy, "success"), 1.0);
  EXPECT_GT(value_of(entry.policy, "lessons"), 0.0);
  EXPECT_EQ(entry.samples, 0);
  EXPECT_EQ(read_file(out("run") / "report.html").find("cannot be shown"), std::string::npos);
  for (const auto& [name, value] : entry.policy) EXPECT_TRUE(report::has_words("policy", name)) << name;
  for (const auto& [name, value] : entry.fit) EXPECT_TRUE(report::has_words("fit", name)) << name;
  EXPECT_NE(entry.notes.back().find("; written: the "), std::string::npos) << entry.notes.back();
  EXPECT_TRUE(std::filesystem::exists(out("run") / "policies" / "sway.npz"));
}

TEST_F(Adapt, StoredPolicyReproducesTheManifestsNumbers) {
  pretrain_once("options");
  const AdaptConfig config = teaching_quickly(adapting("run", "options"));
  adapt_once("taught", config);
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  const files::StoredPolicy policy = files::read_policy(out("run") / "policies" / "sway.npz");
  const rl::tracking::TrackingConfig task = policy.task();
  const judge::Scores scores = judge::score_simulated(
      policy.motion, rl::tracking::roll_out(rl::tracking::make_tracking_clip(policy.motion, task), task,
                                            rl::tracking::mean_action({policy.agent})));
  EXPECT_NEAR(value_of(scores.values, "gMPJPE"), value_of(entry.policy, "gMPJPE"), 1e-9);
}

TEST_F(Adapt, TeachesAPolicyOnlyOnRequest) {
  pretrain_once("options");
  AdaptConfig config = adapting("run", "options");
  config.method = AdaptMethod::kAuto;
  EXPECT_EQ(run(config), record::RunOutcome::kAllGood);
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.method, "plan");
  EXPECT_EQ(entry.samples, 0);
  EXPECT_FALSE(std::filesystem::exists(out("run") / "policies"));
}

TEST_F(Adapt, TeachingIsTheSameBytesForOneAndTwoThreadsAndAfterInterruptions) {
  pretrain_once("options");
  AdaptConfig config = teaching_quickly(adapting("one", "options"));
  adapt_once("taught", config);
  config.run.out = out("two");
  config.run.threads = 2;
  EXPECT_EQ(run(config, 60), record::RunOutcome::kInterrupted);
  run(config);
  EXPECT_EQ(run::results_of(out("one")), run::results_of(out("two")));
}

TEST_F(Adapt, SeedAlsoControlsTheLessons) {
  pretrain_once("options");
  AdaptConfig config = teaching_quickly(adapting("one", "options"));
  adapt_once("taught", config);
  config.run.out = out("two");
  config.training.seed = 2;
  run(config);
  EXPECT_NE(run::results_of(out("one")).at("policies/sway.npz"),
            run::results_of(out("two")).at("policies/sway.npz"));
}

TEST_F(Adapt, RecordsTeachingStoppedByTheTimeLimit) {
  pretrain_once("options");
  AdaptConfig config = teaching_quickly(adapting("run", "options"));
  config.teaching.student.rounds = 100000;
  config.run.limit_seconds = 2.0;  // the plan takes a twentieth of that
  run(config);
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.ending, record::SequenceEnding::kLimitSeconds);
  EXPECT_TRUE(entry.ok) << "the plan's motion is there all the same";
  EXPECT_NE(entry.notes.back().find("--limit-seconds"), std::string::npos) << entry.notes.back();
  EXPECT_FALSE(std::filesystem::exists(out("run") / "policies" / "sway.npz"));
}

/// A student that learns nonsense from one round of lessons.
AdaptConfig teaching_nonsense(AdaptConfig config) {
  config.teaching.student.rounds = 1;
  config.teaching.student.stages = 1;
  config.teaching.student.step_size = config.teaching.student.last_step_size = 1.0;
  return config;
}

TEST_F(Adapt, RecordsPolishingStoppedByTheTimeLimit) {
  pretrain_once("options");
  AdaptConfig config = teaching_nonsense(teaching_quickly(adapting("run", "options")));
  config.run.inputs = {(motions / "walk.npz").string()};
  config.teaching.polish_samples = 1000000000;
  config.run.limit_seconds = 2.0;
  run(config);
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.ending, record::SequenceEnding::kLimitSeconds);
  EXPECT_TRUE(entry.ok) << "the plan's motion is there all the same";
  const auto told = [](const std::string& note) { return note.find("--limit-seconds") != std::string::npos; };
  EXPECT_TRUE(std::any_of(entry.notes.begin(), entry.notes.end(), told));
}

TEST_F(Adapt, FallingStudentIsPolishedByPpo) {
  pretrain_once("options");
  AdaptConfig config = teaching_nonsense(teaching_quickly(adapting("run", "options")));
  config.run.inputs = {(motions / "walk.npz").string()};
  config.teaching.polish_samples = 3 * 64 * 8;
  run(config);
  const record::SequenceEntry entry = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(value_of(entry.policy, "polish_samples"), 3 * 64 * 8);
  EXPECT_EQ(value_of(entry.policy, "success"), 0.0);
  EXPECT_EQ(entry.method, "plan") << "the plan is followed all the same";
  EXPECT_TRUE(entry.ok);
  EXPECT_TRUE(std::filesystem::exists(out("run") / "training" / "walk.csv"));
}

/// Plans that are given up at once.
AdaptConfig hopeless(AdaptConfig config) {
  config.method = AdaptMethod::kAuto;
  config.plan.horizon.failure_distance = 1e-9;
  config.plan.horizon.backtracks = 0;
  return config;
}

TEST_F(Adapt, TrainsAfterAFailedPlanAndWritesTheBetterResult) {
  pretrain_once("options");
  AdaptConfig config = hopeless(adapting("auto", "options"));
  config.run.inputs = {(motions / "walk.npz").string()};
  run(config);
  config.run.out = out("options-alone");
  config.method = AdaptMethod::kOptions;
  run(config);
  config.run.out = out("plan");
  config.method = AdaptMethod::kPlan;
  run(config);
  const auto entry_of = [&](const std::string& name) {
    return record::read_manifest(out(name) / "manifest.json").sequences.at(0);
  };
  const record::SequenceEntry chosen = entry_of("auto"), trained = entry_of("options-alone"),
                              planned = entry_of("plan");
  ASSERT_FALSE(planned.ok);
  EXPECT_EQ(chosen.samples, config.training.samples);
  const bool plan_is_nearer =
      !trained.ok && value_of(planned.metrics, "MPJPE") < value_of(trained.metrics, "MPJPE");
  EXPECT_EQ(chosen.method, plan_is_nearer ? "plan" : "options");
  const record::SequenceEntry& expected = plan_is_nearer ? planned : trained;
  EXPECT_EQ(chosen.ok, expected.ok);
  EXPECT_EQ(chosen.metrics, expected.metrics);
  EXPECT_EQ(chosen.ending, expected.ending);
  EXPECT_EQ(read_file(out("auto") / chosen.output),
            read_file(out(plan_is_nearer ? "plan" : "options-alone") / expected.output));
  EXPECT_NE(chosen.notes.back().find("; written: the "), std::string::npos) << chosen.notes.back();
}

TEST_F(Adapt, TrainingAfterAPlanIsTheSameBytesAfterInterruptions) {
  pretrain_once("options");
  AdaptConfig config = hopeless(adapting("whole", "options"));
  config.run.inputs = {(motions / "walk.npz").string()};
  config.arrangement.selector =
      pipeline::options::Selector::kDp;  // a beam would ask in every frame whether to stop
  run(config);
  config.run.out = out("halves");
  config.run.threads = 2;
  EXPECT_EQ(run(config, 6), record::RunOutcome::kInterrupted);
  EXPECT_TRUE(std::filesystem::exists(out("halves") / "checkpoints" / "walk.npz")) << "not in the training";
  run(config);
  EXPECT_EQ(run::results_of(out("whole")), run::results_of(out("halves")));
}

}  // namespace
}  // namespace mimicx::program
