#include "pipeline/training_config.h"

#include <stdexcept>

#include "core/setting.h"
#include "files/simulation_settings.h"
#include "rl/tracking/tracking_environment.h"

namespace mimicx::pipeline {

namespace {

/// Calls visit(name, field) for every number of the task.
template <class Config, class Visit>
void for_each_tracking_setting(Config& t, const Visit& visit) {
  visit("residual_actions", t.action_mode);
  visit("velocity_feed_forward", t.velocity_feed_forward);
  visit("max_action", t.max_action);
  visit("reward_root_position", t.reward.root_position);
  visit("reward_root_rotation", t.reward.root_rotation);
  visit("reward_pose", t.reward.pose);
  visit("reward_velocity", t.reward.velocity);
  visit("reward_end_effector", t.reward.end_effector);
  visit("reward_projection", t.reward.projection);
  visit("reward_target", t.reward_target);
  visit("softest_reward", t.softest_reward);
  visit("terminate_distance", t.terminate_distance);
  visit("bin_frames", t.bin_frames);
  visit("uniform_starts", t.uniform_starts);
  files::for_each_simulation_setting(t.simulation, visit);
}

/// Calls visit(name, field) for every number of the configuration but samples and seed.
template <class Config, class Visit>
void for_each_training_setting(Config& config, const Visit& visit) {
  visit("characters", config.characters);
  visit("group_size", config.group_size);
  int layer = 0;
  for (auto& width : config.hidden) visit("hidden_" + std::to_string(++layer), width);

  visit("sigma_share", config.sigma_share);
  visit("evaluate_iterations", config.evaluate_iterations);
  visit("stop_reward", config.stop_reward);
  visit("stall_evaluations", config.stall_evaluations);

  auto& p = config.ppo;
  visit("horizon", p.horizon);
  visit("gamma", p.gamma);
  visit("lambda", p.lambda);
  visit("sigma_start", p.sigma_start);
  visit("sigma_end", p.sigma_end);
  visit("epochs", p.epochs);
  visit("minibatch", p.minibatch);
  visit("clip", p.clip);
  visit("gradient_norm", p.gradient_norm);
  visit("critic_step_size", p.critic_step_size);
  visit("return_rate", p.return_rate);
  visit("step_size", p.step_size);
  visit("step_factor", p.step_factor);
  visit("step_min", p.step_min);
  visit("step_max", p.step_max);
  visit("kl_target", p.kl_target);
  visit("kl_stop", p.kl_stop);
  visit("penalty_weight", p.penalty_weight);
  visit("penalty_fraction", p.penalty_fraction);
  visit("gradient_slots", p.gradient_slots);
  visit("pass_rows", p.pass_rows);

  for_each_tracking_setting(config.tracking, visit);
}

/// What a setting may be, where that is not 0 to 1e9.
struct Range {
  std::string name;
  double least, most;
};
const std::vector<Range>& ranges() {
  static const std::vector<Range> all = {{"characters", 1, 1e6},
                                         {"group_size", 1, 1e6},
                                         {"hidden_1", 1, 1e4},
                                         {"hidden_2", 1, 1e4},
                                         {"hidden_3", 1, 1e4},
                                         {"sigma_share", 0, 1},
                                         {"evaluate_iterations", 1, 1e9},
                                         {"horizon", 1, 1e5},
                                         {"gamma", 0, 1},
                                         {"lambda", 0, 1},
                                         {"sigma_start", 1e-4, 10},
                                         {"sigma_end", 1e-4, 10},
                                         {"epochs", 1, 1e4},
                                         {"minibatch", 1, 1e9},
                                         {"return_rate", 0, 1},
                                         {"step_factor", 1, 1e3},
                                         {"penalty_fraction", 0, 1},
                                         {"gradient_slots", 1, 1024},
                                         {"pass_rows", 1, 1e9},
                                         {"softest_reward", 0, 1},
                                         {"residual_actions", 0, 1},
                                         {"velocity_feed_forward", 0, 1},
                                         {"bin_frames", 1, 1e9},
                                         {"uniform_starts", 0, 1},
                                         {"gravity", -1e9, 1e9}};
  return all;
}

}  // namespace

void check(const TrainingConfig& config) {
  for (const auto& [name, value] : settings_of(config)) {
    double least = 0.0, most = 1e9;
    for (const Range& range : ranges())
      if (range.name == name) least = range.least, most = range.most;
    require_range(name, value, least, most);
  }
  // What only the environment, the task and the simulator can judge, they judge themselves.
  rl::tracking::require_whole_groups(config.characters, config.group_size);
  rl::tracking::require_whole_steps(config.tracking.simulation.rate, motion::Reference{}.fps);
  physics::make_model<double>(make_character(), config.tracking.simulation);
}

NamedValues settings_of(const TrainingConfig& config) {
  return numbers_in([&](const auto& visit) { for_each_training_setting(config, visit); });
}

NamedValues settings_of(const rl::tracking::TrackingConfig& config) {
  return numbers_in([&](const auto& visit) { for_each_tracking_setting(config, visit); });
}

void apply_setting(TrainingConfig& config, const std::string& name, double value) {
  if (!change_one([&](const auto& visit) { for_each_training_setting(config, visit); }, name, value))
    throw std::invalid_argument("unknown setting '" + name + "': `mimicx config` lists them all");
}

}  // namespace mimicx::pipeline
