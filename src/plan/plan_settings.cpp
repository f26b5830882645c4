#include "plan/plan_settings.h"

#include "core/setting.h"
#include "rl/tracking/tracking_pack.h"

namespace mimicx::plan {

void check(const PlanningConfig& config) {
  require_ranges(config);
  // What only the task and the simulator can judge, they judge themselves.
  rl::tracking::require_whole_steps(config.simulation.rate, motion::Reference{}.fps);
  physics::make_model<double>(make_character(), config.simulation);
}

}  // namespace mimicx::plan
