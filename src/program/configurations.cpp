#include "program/configurations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "fit/fit_settings.h"
#include "record/json.h"
#include "record/table.h"

namespace mimicx::program {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

enum Column { kImitate, kAdapt, kSmall, kPaper };

struct Row {
  std::string_view name;
  Array<double, 4> values;
};

// training_config.h and rl/ppo_config.h document each setting. The values come from docs/method.md §12 and
// docs/experiments.md. PPO for tracking takes many small iterations with a large KL, and a discount that
// looks 0.4 s ahead, because a pose error costs reward at once.
// clang-format off
constexpr Array<Row, 43> kTable = {{{
  //                      imitate    adapt      small      paper
  {"samples",            {4e6,       3e6,       80e6,      80e6}},    // per motion; of all options together
  {"seed",               {1,         1,         1,         1}},

  {"characters",         {256,       128,       512,       512}},
  {"group_size",         {64,        32,        64,        64}},
  {"hidden_1",           {128,       128,       128,       1024}},    // adapt: the options' own
  {"hidden_2",           {128,       128,       128,       1024}},
  {"hidden_3",           {kNone,     kNone,     kNone,     512}},
  {"sigma_share",        {0.75,      0.75,      0.75,      0.75}},
  {"evaluate_iterations", {20,       20,        100,       100}},
  {"stop_reward",        {0,         0.985,     0,         0}},
  {"stall_evaluations",  {0,         12,        0,         0}},

  {"horizon",            {16,        16,        16,        16}},
  {"gamma",              {0.92,      0.92,      0.92,      0.92}},
  {"lambda",             {0.9,       0.9,       0.9,       0.9}},
  {"sigma_start",        {0.07,      0.04,      0.07,      0.07}},    // options explore less
  {"sigma_end",          {0.04,      0.02,      0.05,      0.05}},
  {"epochs",             {2,         6,         2,         2}},
  {"minibatch",          {1024,      1024,      2048,      2048}},
  {"clip",               {0.2,       0.2,       0.2,       0.2}},
  {"gradient_norm",      {1,         1,         1,         1}},
  {"critic_step_size",   {5e-4,      1e-3,      5e-4,      5e-4}},
  {"return_rate",        {0.1,       0.1,       0.1,       0.1}},
  {"step_size",          {1e-4,      1e-4,      1e-4,      1e-4}},
  {"step_factor",        {1.5,       1.5,       1.5,       1.5}},
  {"step_min",           {1e-6,      1e-6,      1e-6,      1e-6}},
  {"step_max",           {2e-3,      2e-3,      2e-3,      2e-3}},
  {"kl_target",          {0.06,      0.16,      0.06,      0.06}},
  {"kl_stop",            {4,         4,         4,         4}},
  {"penalty_weight",     {0,         0,         0,         0}},
  {"penalty_fraction",   {0.125,     0.125,     0.125,     0.125}},
  {"gradient_slots",     {4,         4,         4,         4}},
  {"pass_rows",          {256,       256,       256,       256}},

  {"fit",                {0,         1,         1,         1}},
  {"switch_penalty",     {kNone,     -1,        kNone,     kNone}},
  {"rescue_reward",      {kNone,     0.1,       kNone,     kNone}},
  {"rescue_frames",      {kNone,     30,        kNone,     kNone}},
  {"beam_width",         {kNone,     64,        kNone,     kNone}},
  {"beam_stretch",       {kNone,     10,        kNone,     kNone}},
  {"beam_retries",       {kNone,     2,         kNone,     kNone}},
  {"selector",           {kNone,     1,         kNone,     kNone}},    // 0 dp, 1 beam, 2 single, 3 nearest
  {"cluster_radius",     {kNone,     kNone,     3,         3}},
}}};
// clang-format on

double value(Column column, const std::string& name) {
  const auto row = std::find_if(kTable.begin(), kTable.end(), [&](const Row& r) { return r.name == name; });
  if (row == kTable.end() || std::isnan(row->values[column]))
    throw std::logic_error("configurations: the table lacks " + name);
  return row->values[column];
}

pipeline::TrainingConfig training(Column column) {
  pipeline::TrainingConfig config;
  config.samples = static_cast<std::int64_t>(value(column, "samples"));
  config.seed = static_cast<std::uint64_t>(value(column, "seed"));
  for (const Row& row : kTable)
    if (row.name.starts_with("hidden_") && !std::isnan(row.values[column])) config.hidden.push_back(0);
  const NamedValues task = pipeline::settings_of(config.tracking);
  for (const auto& [name, unset] : settings_of(config))
    if (std::isnan(value_of(task, name))) apply_setting(config, name, value(column, name));
  return config;
}

NamedValues with_budget(const pipeline::TrainingConfig& config, const NamedValues& settings) {
  NamedValues values = {{"samples", static_cast<double>(config.samples)},
                        {"seed", static_cast<double>(config.seed)}};
  append(values, settings);
  return values;
}

/// All configurations, each in the order of its manifest.
Array<NamedValues, 7> columns() {
  const pipeline::ImitateConfig imitate = imitate_configuration();
  const AdaptConfig adapt = adapt_configuration();
  const pipeline::PretrainConfig small = pretrain_configuration("small"),
                                 paper = pretrain_configuration("paper");
  const teaching::TeachConfig teach = teach_configuration();
  NamedValues taught = {{"seed", static_cast<double>(teach.school.seed)}};
  append(taught, settings_of(teach));
  return {settings_of(plan::plan_configuration()),
          with_budget(imitate.training, settings_of(imitate)),
          with_budget(adapt.training, settings_of(adapt)),
          with_budget(small.training, settings_of(small)),
          with_budget(paper.training, settings_of(paper)),
          taught,
          fit::fit_settings({})};
}

std::string setting_cell(double value) { return std::isnan(value) ? "-" : record::format_number(value); }

}  // namespace

pipeline::ImitateConfig imitate_configuration() {
  pipeline::ImitateConfig config;
  config.training = training(kImitate);
  config.run.fit = value(kImitate, "fit") != 0.0;
  return config;
}

AdaptConfig adapt_configuration() {
  AdaptConfig config;
  config.training = training(kAdapt);
  config.run.fit = value(kAdapt, "fit") != 0.0;
  config.arrangement = {.switch_penalty = value(kAdapt, "switch_penalty"),
                        .rescue_reward = value(kAdapt, "rescue_reward"),
                        .selector = static_cast<pipeline::options::Selector>(value(kAdapt, "selector")),
                        .rescue_frames = static_cast<int>(value(kAdapt, "rescue_frames")),
                        .beam_width = static_cast<int>(value(kAdapt, "beam_width")),
                        .beam_stretch = static_cast<int>(value(kAdapt, "beam_stretch")),
                        .beam_retries = static_cast<int>(value(kAdapt, "beam_retries"))};
  return config;
}

teaching::TeachConfig teach_configuration() {
  teaching::TeachConfig config;
  config.planning = plan::plan_configuration();
  return config;
}

pipeline::PretrainConfig pretrain_configuration(const std::string& preset) {
  if (preset != "small" && preset != "paper")
    throw std::invalid_argument("unknown preset '" + preset + "': small or paper");
  const Column column = preset == "small" ? kSmall : kPaper;
  pipeline::PretrainConfig config;
  config.training = training(column);
  config.fit = value(column, "fit") != 0.0;
  config.clusters.radius = value(column, "cluster_radius");
  config.clusters.seed = config.training.seed;
  return config;
}

std::vector<ConfigurationRow> configuration_rows() {
  const Array<NamedValues, 7> all = columns();
  std::vector<ConfigurationRow> rows;
  for (int column = 0; column < static_cast<int>(all.size()); ++column) {
    std::size_t next = 0;  // behind the setting that came last, so that a new one stands beside its like
    for (const auto& [name, value] : all[column]) {
      std::size_t at = 0;
      while (at < rows.size() && rows[at].name != name) ++at;
      if (at == rows.size()) {
        at = next;
        ConfigurationRow row{name, {}};
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
  const auto padded = [](const std::string& text, std::size_t to) {
    return std::string(to > text.size() ? to - text.size() : 0, ' ') + text;
  };
  std::string text = "setting" + std::string(width - 7, ' ');
  for (const char* name : kConfigurationNames) text += "  " + padded(name, 14);
  for (const ConfigurationRow& row : rows) {
    text += "\n" + row.name + std::string(width - row.name.size(), ' ');
    for (const double v : row.values) text += "  " + padded(setting_cell(v), 14);
  }
  return text + "\n";
}

std::string configurations_json() {
  record::Json json = record::Json::object();
  for (std::size_t column = 0; column < kConfigurationNames.size(); ++column) {
    record::Json settings = record::Json::object();
    for (const ConfigurationRow& row : configuration_rows())
      if (!std::isnan(row.values[column])) settings[row.name] = row.values[column];
    json[kConfigurationNames[column]] = settings;
  }
  return json.dump(1) + "\n";
}

}  // namespace mimicx::program
