/// The configurations that people run, and all settings in a table with a column for each of them.
///
///     plan            optimal control, without any training (plan.h)                    docs/control.md
///     imitate         one policy per motion, trained from scratch
///     adapt           the plan, and if it fails trained options, fine-tuned jointly   docs/method.md §9
///     adapt printed   trained options by the paper's method as printed                docs/deviations.md
///     pretrain small  an option per cluster; networks that two cores fine-tune fast      docs/method.md §7
///     pretrain large  the same with networks of the paper's size
///     pretrain printed  the same by the paper's method as printed                     docs/deviations.md
///     teach           options taught by plans                                           docs/teaching.md §5
///     fit             the keypoint fit, which all of them begin with          docs/method.md, "Keypoint fit"
///
/// The default of a setting stands beside its member in the struct that has it. The functions here change
/// what a configuration does not take from there. `mimicx config` prints the table.
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
/// @param preset  "small" or "large" @throws std::invalid_argument for another one
pipeline::PretrainConfig pretrain_configuration(const std::string& preset);

/// Sets what the paper prints instead of what we do, as far as settings differ (docs/deviations.md). What the
/// paper leaves open stays.
void use_printed_method(AdaptConfig& config);
void use_printed_method(pipeline::PretrainConfig& config);

inline constexpr int kConfigurations = 9;
inline constexpr Array<const char*, kConfigurations> kConfigurationNames = {
    "plan",  "imitate", "adapt", "adapt printed", "pretrain small", "pretrain large", "pretrain printed",
    "teach", "fit"};

/// A setting by its name in manifests, with its value in every configuration; NaN if one has no such setting.
struct ConfigurationRow {
  std::string name;
  Array<double, kConfigurations> values;  ///< in the order of kConfigurationNames
  std::string meaning;  ///< in a few words, with the unit; (--ARGUMENT) where `--set` does not take it
};
std::vector<ConfigurationRow> configuration_rows();

/// A line per setting, columns aligned, the meaning last; "-" where there is none.
std::string format_configurations();
/// {"plan": {name: value, …}, …, "meaning": {name: text, …}}, the settings in the order of the table.
std::string configurations_json();

}  // namespace mimicx::program
