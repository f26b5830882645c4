#include "program/configurations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/setting.h"
#include "fit/fit_config.h"
#include "record/json.h"
#include "record/table.h"

namespace mimicx::program {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kMeaning = "meaning";  ///< of the texts beside the values

using Meanings = std::vector<std::pair<std::string, std::string>>;

NamedValues with_budget(const pipeline::TrainingConfig& config, const NamedValues& settings) {
  NamedValues values = {{"samples", static_cast<double>(config.samples)},
                        {"seed", static_cast<double>(config.seed)}};
  append(values, settings);
  return values;
}

/// All configurations, each in the order of its manifest.
Array<NamedValues, kConfigurations> columns() {
  const pipeline::ImitateConfig imitate = imitate_configuration();
  const AdaptConfig adapt = adapt_configuration();
  AdaptConfig adapt_printed = adapt;
  use_printed_method(adapt_printed);
  const pipeline::PretrainConfig small = pretrain_configuration("small"),
                                 large = pretrain_configuration("large");
  pipeline::PretrainConfig printed = small;
  use_printed_method(printed);
  const teaching::TeachConfig teach = teach_configuration();
  NamedValues taught = {{"seed", static_cast<double>(teach.school.seed)}};
  append(taught, manifest_settings(teach));
  return {manifest_settings(plan::plan_configuration()),
          with_budget(imitate.training, manifest_settings(imitate)),
          with_budget(adapt.training, manifest_settings(adapt)),
          with_budget(adapt_printed.training, manifest_settings(adapt_printed)),
          with_budget(small.training, manifest_settings(small)),
          with_budget(large.training, manifest_settings(large)),
          with_budget(printed.training, manifest_settings(printed)),
          taught,
          settings_of(fit::FitConfig{})};
}

/// What the settings mean that have arguments of their own, and then all others.
Meanings all_meanings() {
  Meanings all = {
      {"samples",
       "training budget of a motion, or of all options together, character steps (--samples; "
       "adapt: --budget-samples)"},
      {"seed", "root of every random number (--seed)"},
      {"fit", "1: motions are moved onto their keypoints first (--fit)"},
      {"as_is", "1: nothing is corrected (--as-is)"},
      {"keypoints", "1: Eq. 3 rewards agreement with keypoints (--fit, --unfitted-keypoints)"},
      {"encoder", "1: policies see their reference through an encoder (--encoder)"},
      {"encoder_steps", "minibatches that train an encoder, at most (fixed)"},
      {"cluster_radius", "largest distance within a cluster; ignored where clusters is not 0 (--radius)"},
      {"clusters", "number of options; 0: as cluster_radius gives (--clusters)"}};
  for (const Meanings& more :
       {meanings_of(adapt_configuration()), meanings_of(pretrain_configuration("large").training),
        meanings_of(teach_configuration()), meanings_of(fit::FitConfig{})})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// @throws std::logic_error where there is none
std::string meaning_of(const Meanings& meanings, const std::string& name) {
  for (const auto& [known, meaning] : meanings)
    if (known == name) return meaning;
  throw std::logic_error("configurations: " + name + " has no meaning");
}

constexpr double kFarAway = 1000.0;  ///< m; no body gets there

/// The paper follows motions as they are.
constexpr run::CorrectionConfig kAsPrinted = {.as_is = true, .unfitted_keypoints = true};

/// What the paper prints of the task, the policy and its exploration.
void use_printed_training(pipeline::TrainingConfig& training) {
  rl::tracking::TrackingConfig& task = training.tracking;
  task.actions = {rl::tracking::ActionMode::kAbsolute, false, false};  // a_t is the target pose, and no more
  task.reward.root_position = task.reward.root_rotation;               // Eq. 2: one w_r for both
  task.reward.projection =
      4.0;  // estimates are 8 % of the box off their keypoints: 100 would be half the reward
  task.reward_target = 0.0;
  task.uniform_starts = 1.0;
  // Σ is fixed. Its value is that of ASE (Peng et al. 2022), 0.055 of 1.2 times the largest angle of a joint,
  // 0.7 times the range of a hinge: of our ranges 1.95 rad in the mean.
  training.ppo.sigma_start = training.ppo.sigma_end = 0.11;
  training.ppo.penalty_weight = 0.002;  // value: Chen et al. 2024
}

std::string setting_cell(double value) { return std::isnan(value) ? "-" : record::format_number(value); }

}  // namespace

pipeline::ImitateConfig imitate_configuration() { return {}; }

AdaptConfig adapt_configuration() {
  AdaptConfig config;
  config.run.correction.fit = true;
  pipeline::TrainingConfig& training = config.training;
  training.samples = 3000000;
  training.characters = 128;
  training.group_size = 32;
  training.stop_reward = 0.985;
  training.stall_evaluations = 12;
  training.ppo.sigma_start = 0.04;  // trained options explore less
  training.ppo.sigma_end = 0.02;
  training.ppo.epochs = 6;
  training.ppo.critic_step_size = 1e-3;
  training.ppo.kl_target = 0.16;
  return config;
}

teaching::TeachConfig teach_configuration() {
  teaching::TeachConfig config;
  config.planning = plan::plan_configuration();
  return config;
}

pipeline::PretrainConfig pretrain_configuration(const std::string& preset) {
  if (preset != "small" && preset != "large")
    throw std::invalid_argument("unknown preset '" + preset + "': small or large");
  pipeline::PretrainConfig config;
  config.correction.fit = true;
  pipeline::TrainingConfig& training = config.training;
  training.samples = 80000000;
  training.characters = 512;
  if (preset == "large") training.hidden = {1024, 1024, 1024, 256};
  training.evaluate_iterations = 100;
  training.ppo.sigma_end = 0.05;
  training.ppo.minibatch = 2048;
  return config;
}

void use_printed_method(AdaptConfig& config) {
  config.method = AdaptMethod::kPrinted;
  config.run.correction = kAsPrinted;
  use_printed_training(config.training);
  config.training.stall_evaluations = 0;  // the threshold ends the fine-tuning
  config.training.stop_reward = 0.9;      // keypoints leave 0.975 at most, at the median of the estimates
  config.arrangement.selector = pipeline::options::Selector::kDp;
  config.arrangement.rescue.distance = kFarAway;
  config.arrangement.rescue_frames = 0;
}

void use_printed_method(pipeline::PretrainConfig& config) {
  config.correction = kAsPrinted;
  use_printed_training(config.training);
}

std::vector<ConfigurationRow> configuration_rows() {
  const Array<NamedValues, kConfigurations> all = columns();
  const Meanings meanings = all_meanings();
  std::vector<ConfigurationRow> rows;
  for (int column = 0; column < static_cast<int>(all.size()); ++column) {
    std::size_t next = rows.size();  // behind the setting that came last: a new one stands beside its like
    for (const auto& [name, value] : all[column]) {
      std::size_t at = 0;
      while (at < rows.size() && rows[at].name != name) ++at;
      if (at == rows.size()) {
        at = next;
        ConfigurationRow row{name, {}, meaning_of(meanings, name)};
        row.values.fill(kNone);
        rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(at), row);
      }
      rows[at].values[column] = value;
      next = at + 1;
    }
  }
  return rows;
}

std::string format_configurations() {
  const std::vector<ConfigurationRow> rows = configuration_rows();
  std::size_t width = 0;
  for (const ConfigurationRow& row : rows) width = std::max(width, row.name.size());
  constexpr std::size_t kColumn = 16;
  const auto padded = [](const std::string& text) {
    return std::string(kColumn > text.size() ? kColumn - text.size() : 0, ' ') + text;
  };
  std::string text = "setting" + std::string(width - 7, ' ');
  for (const char* name : kConfigurationNames) text += "  " + padded(name);
  text += std::string("  ") + kMeaning;
  for (const ConfigurationRow& row : rows) {
    text += "\n" + row.name + std::string(width - row.name.size(), ' ');
    for (const double v : row.values) text += "  " + padded(setting_cell(v));
    text += "  " + row.meaning;
  }
  return text + "\n";
}

std::string configurations_json() {
  const std::vector<ConfigurationRow> rows = configuration_rows();
  record::Json json = record::Json::object(), meanings = record::Json::object();
  for (std::size_t column = 0; column < kConfigurationNames.size(); ++column) {
    record::Json settings = record::Json::object();
    for (const ConfigurationRow& row : rows)
      if (!std::isnan(row.values[column])) settings[row.name] = row.values[column];
    json[kConfigurationNames[column]] = settings;
  }
  for (const ConfigurationRow& row : rows) meanings[row.name] = row.meaning;
  json[kMeaning] = meanings;
  return json.dump(1) + "\n";
}

}  // namespace mimicx::program
