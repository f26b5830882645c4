// The paper's method as printed, from options to a cleaned motion.                       docs/deviations.md
#include <gtest/gtest.h>

#include <algorithm>

#include "core/setting_checks.h"
#include "motion/test_split.h"
#include "program/pretrained_options.h"
#include "record/table.h"
#include "run/results.h"

namespace mimicx::program {
namespace {

/// One motion with keypoints beside those of PretrainedOptions; options of the printed method in "options"
/// and a run of them in "run", made once for all tests.
struct PrintedMethod : PretrainedOptions {
  void SetUp() override {
    static const TemporaryFolder made;
    motions = made.path / "motions";
    seen = motions / "stand_1.npz";
    const bool first = std::filesystem::is_empty(made.path);
    if (first) {
      std::filesystem::copy(made_motions(), motions);
      motion::write_clip(seen, test::beginning_of_stand("noisy", 45));
      EXPECT_EQ(run(printed_options("options")), record::RunOutcome::kAllGood);
      run(printed("run", "options"));
    }
    for (const char* name : {"options", "run"})
      std::filesystem::copy(first ? out(name) : made.path / name, first ? made.path / name : out(name),
                            std::filesystem::copy_options::recursive);
  }
  pipeline::PretrainConfig printed_options(const std::string& name) const {
    pipeline::PretrainConfig config = pretraining(name);
    use_printed_method(config);
    return config;
  }
  AdaptConfig printed(const std::string& name, const std::string& options) const {
    AdaptConfig config = adapting(name, options);
    use_printed_method(config);
    config.run.inputs = {seen.string()};
    return config;
  }
  std::filesystem::path seen;
};

double lowest(const std::filesystem::path& log, const std::string& column) {
  const record::Table table = record::read_csv(log);
  double least = 1.0;
  for (const auto& row : table.rows) least = std::min(least, row[table.column(column)]);
  return least;
}

TEST_F(PrintedMethod, TrainsOptionsAndFineTunesThem) {
  const auto options = pipeline::options::read_options(out("options"));
  EXPECT_EQ(options->actions,
            (rl::tracking::ActionSettings{rl::tracking::ActionMode::kAbsolute, false, false}));
  EXPECT_TRUE(options->options[0].option.encoder.has_value());
  const record::Manifest manifest = record::read_manifest(out("run") / "manifest.json");
  EXPECT_EQ(manifest.method, "printed");
  EXPECT_EQ(manifest.settings, manifest_settings(printed("run", "options")));
  const record::SequenceEntry& entry = manifest.sequences.at(0);
  EXPECT_EQ(entry.method, "printed");
  EXPECT_EQ(entry.samples, small_training().samples);
  ASSERT_FALSE(entry.arrangement.empty());
  EXPECT_TRUE(entry.fit.empty());
  for (const char* correction : {"max_floor_shift_mm", "foot_level_deg", "arms_moved_mm", "pose_fit_max_mm"})
    EXPECT_EQ(value_of(entry.preparation, correction), 0.0) << correction;
}

TEST_F(PrintedMethod, Eq3ActsWithoutAFitInBothStages) {
  EXPECT_LT(std::min(lowest(out("options") / "training" / "option0.csv", "reward_term:projection"),
                     lowest(out("options") / "training" / "option1.csv", "reward_term:projection")),
            1.0);
  EXPECT_LT(lowest(out("run") / "training" / "stand_1.csv", "reward_term:projection"), 1.0);
  AdaptConfig without = printed("without", "options");
  without.run.inputs = {(motions / "sway.npz").string()};
  run(without);
  EXPECT_EQ(lowest(out("without") / "training" / "sway.csv", "reward_term:projection"), 1.0)
      << "without keypoints the factor is 1";
}

TEST_F(PrintedMethod, IsTheSameBytesForOneAndTwoThreadsAndAfterInterruptions) {
  pipeline::PretrainConfig again = printed_options("again");
  again.threads = 2;
  EXPECT_EQ(run(again, 2), record::RunOutcome::kInterrupted);
  run(again);
  EXPECT_EQ(run::results_of(out("options")), run::results_of(out("again")));
  AdaptConfig config = printed("two", "options");
  config.run.threads = 2;
  EXPECT_EQ(run(config, 3), record::RunOutcome::kInterrupted);
  run(config);
  EXPECT_EQ(run::results_of(out("run")), run::results_of(out("two")));
}

TEST_F(PrintedMethod, HasOneSetOfOptionsOfAbsoluteActions) {
  pipeline::PretrainConfig other = pretraining("residual");
  other.training.samples = 0;
  run(other);
  EXPECT_NE(refusal_of([&] {
              run(printed("other", "residual"));
            }).find("expected policies trained with residual_actions=0"),
            std::string::npos);
  AdaptConfig two = printed("other", "options");
  two.options.push_back(two.options.front());
  EXPECT_NE(refusal_of([&] { run(two); }).find("expected one set for --method printed, found 2"),
            std::string::npos);
}

}  // namespace
}  // namespace mimicx::program
