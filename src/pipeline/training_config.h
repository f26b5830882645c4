/// Everything that the result of a training depends on.
///
/// The defaults train one motion from scratch; what other trainings change is in program/configurations.cpp.
/// The task (reward, simulation, starts) is one for all; its defaults stand beside their meaning in
/// rl/tracking and physics.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files/simulation_settings.h"
#include "rl/ppo_config.h"
#include "rl/tracking/tracking_config.h"

namespace mimicx::pipeline {

struct TrainingConfig {
  std::int64_t samples = 4000000;     ///< budget: character steps
  std::uint64_t seed = 1;             ///< the one root of every random number
  int characters = 256;               ///< simulated side by side
  int group_size = 64;                ///< characters that one worker carries through a roll-out
  std::vector<int> hidden{128, 128};  ///< widths of the hidden layers of actor and critic
  double sigma_share = 0.75;          ///< share of the budget during which σ falls
  int evaluate_iterations = 20;       ///< every so many iterations the mean actions are rolled out
  /// A roll-out of the mean actions that stays with the motion to its end and has this mean reward, not
  /// softened, ends the training; 0: none does.
  double stop_reward = 0.0;
  /// The training ends after this many roll-outs in a row that follow the motion to its end without being
  /// better than the best one before; 0: it does not end so.
  int stall_evaluations = 0;
  rl::PpoConfig ppo;
  rl::tracking::TrackingConfig tracking;
};

/// core/setting.h; all but samples and seed.
void visit_settings(TrainingConfig& config, const auto& visit) {
  visit("characters", config.characters, 1, 1e6, "characters simulated side by side");
  visit("group_size", config.group_size, 1, 1e6, "characters that one worker simulates");
  for (std::size_t layer = 0; layer < config.hidden.size(); ++layer)
    visit("hidden_" + std::to_string(layer + 1), config.hidden[layer], 1, 1e4,
          "units of that hidden layer of actor and critic");
  visit("sigma_share", config.sigma_share, 0, 1, "share of the budget during which exploration falls");
  visit("evaluate_iterations", config.evaluate_iterations, 1, 1e9, "iterations between two evaluations");
  visit("stop_reward", config.stop_reward, 0, 1e9,
        "mean reward of a mean-action roll-out, not softened, that ends the training; 0: none does");
  visit("stall_evaluations", config.stall_evaluations, 0, 1e9,
        "evaluations in a row without progress that end the training; 0: never");
  visit_settings(config.ppo, visit);
  visit_settings(config.tracking, visit);
  files::visit_settings(config.tracking.simulation, visit);
}

/// @throws std::invalid_argument naming a setting that no training can have
void check(const TrainingConfig& config);

}  // namespace mimicx::pipeline
