#include "program/configurations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "core/file.h"
#include "core/setting_checks.h"
#include "fit/fit_config.h"
#include "record/json.h"

namespace mimicx::program {
namespace {

/// Of all configurations that train.
std::vector<pipeline::TrainingConfig> trainings() {
  return {imitate_configuration().training, adapt_configuration().training,
          pretrain_configuration("small").training, pretrain_configuration("large").training};
}

AdaptConfig printed_adaptation() {
  AdaptConfig config = adapt_configuration();
  use_printed_method(config);
  return config;
}

pipeline::PretrainConfig printed_pretraining() {
  pipeline::PretrainConfig config = pretrain_configuration("small");
  use_printed_method(config);
  return config;
}

/// {setting: value} that the second column has and the first has not, or has with another value.
std::map<std::string, double> settings_changed(const std::string& from, const std::string& to) {
  const auto column = [](const std::string& name) {
    return static_cast<int>(std::find(kConfigurationNames.begin(), kConfigurationNames.end(), name) -
                            kConfigurationNames.begin());
  };
  std::map<std::string, double> found;
  for (const ConfigurationRow& row : configuration_rows()) {
    const double value = row.values[column(to)];
    if (!std::isnan(value) && row.values[column(from)] != value) found[row.name] = value;
  }
  return found;
}

double value(const std::string& name, int column) {
  for (const ConfigurationRow& row : configuration_rows())
    if (row.name == name) return row.values[column];
  ADD_FAILURE() << "no row " << name;
  return 0.0;
}

TEST(Configurations, AllAreCompleteAndCanBeDone) {
  for (const pipeline::TrainingConfig& training : trainings()) EXPECT_NO_THROW(check(training));
  EXPECT_NO_THROW(check(printed_adaptation()));
  EXPECT_NO_THROW(check(printed_pretraining().training));
  EXPECT_NO_THROW(check(plan::plan_configuration().planning));
  EXPECT_NO_THROW(check(adapt_configuration()));
}

TEST(Configurations, EverySettingOfAMethodCanBeChangedByItsNameAndChangesNoOther) {
  for (const AdaptMethod method :
       {AdaptMethod::kAuto, AdaptMethod::kPlan, AdaptMethod::kOptions, AdaptMethod::kPrinted}) {
    AdaptConfig config = adapt_configuration();
    config.method = method;
    check_settings(config);
  }
  check_settings(teach_configuration());
}

TEST(Configurations, TheDefaultsTrainOneMotionFromScratch) {
  const pipeline::ImitateConfig imitate = imitate_configuration();
  EXPECT_EQ(manifest_settings(imitate), manifest_settings(pipeline::ImitateConfig{}));
  EXPECT_EQ(imitate.training.samples, 4000000);
}

TEST(Configurations, TheTaskIsOneForAllButTheMethodAsPrinted) {
  for (const pipeline::TrainingConfig& training : trainings())
    EXPECT_EQ(settings_of(training.tracking), settings_of(rl::tracking::TrackingConfig{}));
}

TEST(Configurations, NoSettingIsNamedTwice) {
  const std::vector<ConfigurationRow> rows = configuration_rows();
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(rows[i].name, rows[j].name);
}

TEST(Configurations, TableListsWhatManifestsRecord) {
  const auto has_all = [](int column, const NamedValues& settings, std::size_t more) {
    for (const auto& [name, set] : settings) EXPECT_EQ(value(name, column), set) << name;
    std::size_t rows = 0;
    for (const ConfigurationRow& row : configuration_rows()) rows += !std::isnan(row.values[column]);
    EXPECT_EQ(rows, settings.size() + more) << kConfigurationNames[column];
  };
  has_all(0, manifest_settings(plan::plan_configuration()), 0);
  has_all(1, manifest_settings(imitate_configuration()), 2);  // the samples and the seed besides
  has_all(2, manifest_settings(adapt_configuration()), 2);
  has_all(3, manifest_settings(printed_adaptation()), 2);
  has_all(4, manifest_settings(pretrain_configuration("small")), 2);
  has_all(5, manifest_settings(pretrain_configuration("large")), 2);
  has_all(6, manifest_settings(printed_pretraining()), 2);
  has_all(7, manifest_settings(teach_configuration()), 1);
  has_all(8, settings_of(fit::FitConfig{}), 0);
}

TEST(Configurations, PresetsDifferOnlyInTheirNetworks) {
  for (const ConfigurationRow& row : configuration_rows()) {
    const double small = row.values[4], large = row.values[5];
    if (row.name.starts_with("hidden_"))
      EXPECT_NE(small, large) << row.name;
    else
      EXPECT_TRUE(small == large || (std::isnan(small) && std::isnan(large))) << row.name;
  }
  EXPECT_EQ(pretrain_configuration("large").training.hidden, (std::vector<int>{1024, 1024, 1024, 256}));
  EXPECT_THROW(pretrain_configuration("huge"), std::invalid_argument);
}

TEST(Configurations, TheMethodAsPrintedDiffersInTheseSettingsAlone) {
  const rl::tracking::TrackingConfig task;
  std::map<std::string, double> printed = {{"fit", 0},
                                           {"as_is", 1},
                                           {"residual_actions", 0},
                                           {"velocity_feed_forward", 0},
                                           {"target_ramp", 0},
                                           {"reward_root_position", task.reward.root_rotation},
                                           {"reward_projection", 4},
                                           {"reward_target", 0},
                                           {"uniform_starts", 1},
                                           {"sigma_start", 0.11},
                                           {"sigma_end", 0.11},
                                           {"penalty_weight", 0.002}};
  EXPECT_EQ(settings_changed("pretrain small", "pretrain printed"), printed);
  printed.insert({{"selector", 0},
                  {"rescue_distance", 1000},
                  {"rescue_frames", 0},
                  {"stall_evaluations", 0},
                  {"stop_reward", 0.9}});
  EXPECT_EQ(settings_changed("adapt", "adapt printed"), printed);
  const NamedValues adapt = manifest_settings(printed_adaptation());
  EXPECT_EQ(value_of(adapt, "keypoints"), 1.0) << "Eq. 3 acts without a fit";
  EXPECT_EQ(value_of(adapt, "reward_root_position"), value_of(adapt, "reward_root_rotation"))
      << "w_r of Eq. 2";
}

TEST(Configurations, EverySettingOfTheMethodAsPrintedHasARowInTheDeviations) {
  std::istringstream page(read_file(std::filesystem::path(MIMICX_SOURCE_DIR) / "docs" / "deviations.md"));
  // The last cells of the rows: what makes our default the print's, and what keeps ours in it.
  std::string undo, keep;
  for (std::string line; std::getline(page, line);) {
    const std::size_t cell = line.rfind(" | ", line.size() - 3);
    if (!line.starts_with("| ") || cell == std::string::npos) continue;
    const std::string last = line.substr(cell);
    undo += last.substr(0, last.find(';'));
    if (last.find(';') != std::string::npos) keep += last.substr(last.find(';'));
  }
  /// The numbers that follow NAME= in a text.
  const auto set_in = [](const std::string& text, const std::string& name) {
    std::vector<double> numbers;
    for (std::size_t at = 0; (at = text.find(name + "=", at)) != std::string::npos; ++at)
      if (std::isdigit(text[at + name.size() + 1]))
        numbers.push_back(std::stod(text.substr(at + name.size() + 1)));
    return numbers;
  };
  for (const auto& [name, printed] : settings_changed("adapt", "adapt printed")) {
    std::string argument = name;
    std::replace(argument.begin(), argument.end(), '_', '-');
    const std::vector<double> undone = set_in(undo, name), kept = set_in(keep, name);
    EXPECT_TRUE(!undone.empty() || !kept.empty() || (undo + keep).find("--" + argument) != std::string::npos)
        << name;
    for (const double number : undone) EXPECT_EQ(number, printed) << name;
    for (const double number : kept) EXPECT_EQ(number, value(name, 2)) << name;  // of adapt
  }
}

TEST(Configurations, TrainingFromScratchHasItsOwnSettings) {
  const auto changed = settings_changed("imitate", "adapt");
  for (const char* name : {"sigma_start", "sigma_end", "epochs", "kl_target", "critic_step_size"})
    EXPECT_TRUE(changed.contains(name)) << name;
}

TEST(Configurations, TextAndJsonAgree) {
  const auto json = record::Json::parse(configurations_json());
  std::istringstream lines(format_configurations());
  std::string line;
  std::getline(lines, line);  // the head
  for (const ConfigurationRow& row : configuration_rows()) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream words(line);
    std::string word;
    words >> word;
    EXPECT_EQ(word, row.name);
    for (int column = 0; column < 7; ++column) {
      words >> word;
      const record::Json& settings = json.at(kConfigurationNames[column]);
      if (word == "-") {
        EXPECT_FALSE(settings.contains(row.name)) << row.name;
        continue;
      }
      EXPECT_EQ(std::stod(word), row.values[column]) << row.name;
      EXPECT_EQ(settings.at(row.name).get<double>(), row.values[column]) << row.name;
    }
    EXPECT_FALSE(row.meaning.empty()) << row.name;
    EXPECT_TRUE(line.ends_with("  " + row.meaning)) << line;
    EXPECT_EQ(json.at("meaning").at(row.name).get<std::string>(), row.meaning);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

}  // namespace
}  // namespace mimicx::program
