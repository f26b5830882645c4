/// The default configurations, as the columns of one table. `mimicx config` prints it.
///
///     plan            optimal control, without any training (plan.h)                    docs/control.md
///     imitate         one policy per motion, trained from scratch
///     adapt           the plan, and if it fails trained options, fine-tuned jointly   docs/method.md §9
///     pretrain small  an option per cluster; networks that two cores fine-tune fast      docs/method.md §7
///     pretrain paper  the same with the paper's networks
///     teach           options taught by plans                                           docs/teaching.md §5
///     fit             the keypoint fit, which all of them begin with          docs/method.md, "Keypoint fit"
///
/// This is the only place with defaults of a training, an arrangement or a clustering. The task (reward,
/// starts, simulation), the encoder, the plan and the fit have one default for all configurations, which is
/// in their headers (rl/tracking/tracking_config.h, rl/tracking/reward.h, physics/model.h, nn/autoencoder.h,
/// control/plan.h, fit/fit_config.h). The printed table includes them.
#pragma once

#include <string>
#include <vector>

#include "core/containers.h"
#include "pipeline/imitate_command.h"
#include "pipeline/pretrain.h"
#include "plan/plan_command.h"
#include "program/adapt_command.h"
#include "teaching/teach_command.h"

namespace mimicx::program {

pipeline::ImitateConfig imitate_configuration();
AdaptConfig adapt_configuration();
teaching::TeachConfig teach_configuration();
/// @param preset  "small" or "paper" @throws std::invalid_argument for another one
pipeline::PretrainConfig pretrain_configuration(const std::string& preset);

inline constexpr Array<const char*, 7> kConfigurationNames = {
    "plan", "imitate", "adapt", "pretrain small", "pretrain paper", "teach", "fit"};

/// A setting by its name in manifests, with its value in every configuration; NaN if one has no such setting.
struct ConfigurationRow {
  std::string name;
  Array<double, 7> values;  ///< in the order of kConfigurationNames
};
std::vector<ConfigurationRow> configuration_rows();

/// A line per setting, columns aligned; "-" for NaN.
std::string format_configurations();
/// {"plan": {name: value, …}, …}, the settings in the order of the table.
std::string configurations_json();

}  // namespace mimicx::program
