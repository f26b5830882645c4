/// Settings of planning; every number has a name, for manifests and `--set`.
#pragma once

#include <string>

#include "control/plan.h"
#include "core/named_values.h"

namespace mimicx::plan {

/// Settings for a reference that may have errors. Its certainty is computed from the reference
/// (plan_motion.h).
struct MotionPlanConfig : control::PlanConfig {
  double plausible_acceleration =
      300.0;  ///< a₀ of the certainty, m/s²; 0: the reference is certain everywhere
};

/// Everything that a plan depends on.
struct PlanningConfig {
  MotionPlanConfig plan;
  physics::SimulationConfig simulation;
};

/// The numbers of the plan by name; all begin with "plan_". Factors of single bodies are not included.
NamedValues plan_settings(const MotionPlanConfig& plan);
/// Those, and the numbers of the simulation.
NamedValues planning_settings(const PlanningConfig& config);

/// Changes one of them. @return whether there is one of that name
/// @throws std::invalid_argument for a fraction where a whole number is expected
bool change_setting(MotionPlanConfig& plan, const std::string& name, double value);
/// @throws std::invalid_argument as above, and for an unknown name
void apply_setting(PlanningConfig& config, const std::string& name, double value);

/// @throws std::invalid_argument naming a setting that no plan can have
void check(const MotionPlanConfig& plan);
void check(const PlanningConfig& config);

}  // namespace mimicx::plan
