/// `mimicx adapt`: cleans each motion, by a plan, by trained policies, or by policies if the plan fails.
///
/// *Plan*: optimal control on the simulator's derivatives (plan.h); seconds per motion. *Options*: trained
/// options are arranged over the motion, and those that act are fine-tuned jointly (fine_tune.h); minutes.
///                                                                     docs/method.md §8, §9
/// *Printed*: the same with the settings of the method as the paper prints it (configurations.h).
/// *Auto*: the plan and, on request, a policy that it teaches (teach_motion.h); if the plan's roll-out is no
/// success, the options with their whole budget. The better roll-out is written (choice.h), and the
/// manifest says which.
#pragma once

#include <filesystem>

#include "pipeline/options/arrangement.h"
#include "pipeline/training_loop.h"
#include "plan/plan_settings.h"
#include "run/sequence_run.h"
#include "teaching/teaching_settings.h"

namespace mimicx::program {

enum class AdaptMethod { kAuto, kPlan, kOptions, kPrinted };

struct AdaptConfig {
  AdaptMethod method = AdaptMethod::kAuto;
  run::RunConfig run;
  plan::MotionPlanConfig plan;  ///< simulated as `training` says
  teaching::TeachingConfig teaching;
  pipeline::TrainingConfig training;  ///< of the fine-tuning; the networks are those of the options
  pipeline::options::ArrangementConfig arrangement;
  pipeline::options::OptionSets options;  ///< to start from (option_set_choice.h); not used by the plan alone
};

/// core/setting.h; those that the method has.
void visit_settings(AdaptConfig& config, const auto& visit) {
  if (config.method == AdaptMethod::kAuto || config.method == AdaptMethod::kPlan)
    visit_settings(config.plan, visit);
  if (config.method == AdaptMethod::kPlan)
    return files::visit_settings(config.training.tracking.simulation, visit);
  visit_settings(config.training, visit);
  visit_settings(config.arrangement, visit);
  if (config.method == AdaptMethod::kAuto) visit_settings(config.teaching, visit);
}

/// The settings, as the manifest lists them.
NamedValues manifest_settings(const AdaptConfig& config);

/// @throws std::invalid_argument naming a setting that the method cannot have
void check(const AdaptConfig& config);

/// @throws std::invalid_argument as `run_sequences`, and for missing options or an impossible arrangement if
/// the method may need them
record::RunOutcome adapt(const AdaptConfig& config, const record::RunContext& context);

}  // namespace mimicx::program
