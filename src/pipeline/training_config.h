/// Everything that the result of a training depends on; its numbers have names.
///
/// Only the task has defaults here; those of trainings are the columns of configurations.h. The task (reward,
/// simulation, starts) is the same for all trainings; its values are documented in rl/tracking and physics.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/named_values.h"
#include "rl/ppo_config.h"
#include "rl/tracking/tracking_config.h"

namespace mimicx::pipeline {

struct TrainingConfig {
  std::int64_t samples = 0;     ///< budget: in character steps
  std::uint64_t seed = 0;       ///< the one root of every random number
  int characters = 0;           ///< simulated in parallel
  int group_size = 0;           ///< characters that one worker simulates in a roll-out
  std::vector<int> hidden;      ///< widths of the hidden layers of actor and critic
  double sigma_share = 0.0;     ///< share of the budget during which σ falls
  int evaluate_iterations = 0;  ///< iterations between two roll-outs of the mean actions
  double stop_reward = 0.0;     ///< mean reward of a roll-out that ends the training; 0: never
  /// The training ends after so many consecutive roll-outs that follow the motion to its end without
  /// improvement; 0: never.
  int stall_evaluations = 0;
  rl::PpoConfig ppo{};
  rl::tracking::TrackingConfig tracking;
};

/// Every number of the configuration but samples and seed, by the name it has in the manifest.
NamedValues settings_of(const TrainingConfig& config);
/// Those of the task alone.
NamedValues settings_of(const rl::tracking::TrackingConfig& config);

/// Changes one of them.
/// @throws std::invalid_argument for an unknown name or a fraction where a whole number is expected
void apply_setting(TrainingConfig& config, const std::string& name, double value);

/// @throws std::invalid_argument naming a setting that no training can have
void check(const TrainingConfig& config);

}  // namespace mimicx::pipeline
