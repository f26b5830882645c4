/// Everything that the result of a training depends on, and its numbers by name.
///
/// Nothing but the task itself has a default here: what people run are the columns of configurations.h. The
/// task (reward, simulation, starts) is one for all; its values stand beside their meaning in rl/tracking and
/// physics.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/named_values.h"
#include "rl/ppo_config.h"
#include "rl/tracking/tracking_config.h"

namespace mimicx::pipeline {

struct TrainingConfig {
  std::int64_t samples = 0;     ///< budget: character steps
  std::uint64_t seed = 0;       ///< the one root of every random number
  int characters = 0;           ///< simulated side by side
  int group_size = 0;           ///< characters that one worker carries through a roll-out
  std::vector<int> hidden;      ///< widths of the hidden layers of actor and critic
  double sigma_share = 0.0;     ///< share of the budget during which σ falls
  int evaluate_iterations = 0;  ///< every so many iterations the mean actions are rolled out
  double stop_reward = 0.0;     ///< a roll-out of this mean reward ends the training; 0: none does
  /// The training ends after this many roll-outs in a row that follow the motion to its end without being
  /// better than the best one before; 0: it does not end so.
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
