#include "pipeline/training_config.h"

#include "core/setting.h"
#include "rl/tracking/tracking_environment.h"

namespace mimicx::pipeline {

void check(const TrainingConfig& config) {
  require_ranges(config);
  // What only the environment, the task and the simulator can judge, they judge themselves.
  rl::tracking::require_whole_groups(config.characters, config.group_size);
  rl::tracking::require_whole_steps(config.tracking.simulation.rate, motion::Reference{}.fps);
  physics::make_model<double>(make_character(), config.tracking.simulation);
}

}  // namespace mimicx::pipeline
