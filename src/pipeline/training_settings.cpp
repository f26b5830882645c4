#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "pipeline/output/simulation_settings.h"
#include "pipeline/training.h"

namespace mimicx {

namespace {

/// Calls visit(name, field) for every number of the configuration but samples and seed.
template <class Config, class Visit>
void for_each_setting(Config& config, const Visit& add) {
  add("characters", config.characters);
  add("group_size", config.group_size);
  for (std::size_t i = 0; i < config.hidden.size(); ++i)
    add("hidden_" + std::to_string(i + 1), config.hidden[i]);

  add("sigma_share", config.sigma_share);
  add("evaluate_iterations", config.evaluate_iterations);
  add("stop_reward", config.stop_reward);
  add("stall_evaluations", config.stall_evaluations);

  auto& p = config.ppo;
  add("horizon", p.horizon);
  add("gamma", p.gamma);
  add("lambda", p.lambda);
  add("sigma_start", p.sigma_start);
  add("sigma_end", p.sigma_end);
  add("epochs", p.epochs);
  add("minibatch", p.minibatch);
  add("clip", p.clip);
  add("gradient_norm", p.gradient_norm);
  add("critic_step_size", p.critic_step_size);
  add("return_rate", p.return_rate);
  add("step_size", p.step_size);
  add("step_factor", p.step_factor);
  add("step_min", p.step_min);
  add("step_max", p.step_max);
  add("kl_target", p.kl_target);
  add("kl_stop", p.kl_stop);
  add("penalty_weight", p.penalty_weight);
  add("penalty_fraction", p.penalty_fraction);
  add("bound_weight", p.bound_weight);
  add("mean_bound", p.mean_bound);
  add("gradient_slots", p.gradient_slots);
  add("pass_rows", p.pass_rows);

  auto& t = config.tracking;
  add("residual_actions", t.action_mode);
  add("velocity_feed_forward", t.velocity_feed_forward);
  add("max_action", t.max_action);
  add("reward_root_position", t.reward.root_position);
  add("reward_root_rotation", t.reward.root_rotation);
  add("reward_pose", t.reward.pose);
  add("reward_velocity", t.reward.velocity);
  add("reward_end_effector", t.reward.end_effector);
  add("reward_projection", t.reward.projection);
  add("reward_target", t.reward_target);
  add("softest_reward", t.softest_reward);
  add("terminate_distance", t.terminate_distance);
  add("bin_frames", t.bin_frames);
  add("uniform_starts", t.uniform_starts);

  for_each_simulation_setting(t.simulation, add);
}

double value_of(rl::ActionMode mode) { return mode == rl::ActionMode::kResidual ? 1.0 : 0.0; }
template <class T>
double value_of(T value) {
  return static_cast<double>(value);
}

void assign(rl::ActionMode& mode, double value) {
  mode = value != 0.0 ? rl::ActionMode::kResidual : rl::ActionMode::kAbsolute;
}
template <class T>
void assign(T& field, double value) {
  if (!(std::abs(value) <= 1e9)) throw std::invalid_argument("at most 1e9 expected");
  field = static_cast<T>(value);
  if (static_cast<double>(field) != value)
    throw std::invalid_argument("a fraction where a whole number is expected");
}

/// What a setting may be, beyond not being negative.
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
    if (!(value >= least && value <= most)) {
      char text[120];
      std::snprintf(text, sizeof text, "%s: expected %g to %g, found %g", name.c_str(), least, most, value);
      throw std::invalid_argument(text);
    }
  }
  if (config.group_size % kLanes != 0 || config.characters % config.group_size != 0)
    throw std::invalid_argument("characters must be a multiple of group_size, and that of " +
                                std::to_string(kLanes) + ", the lanes of this build");
  if (std::fmod(config.tracking.simulation.rate, 30.0) != 0.0)
    throw std::invalid_argument("physics_rate must be a multiple of 30");
  make_model<double>(make_character(), config.tracking.simulation);  // checks its own
}

NamedValues settings_of(const TrainingConfig& config) {
  NamedValues values;
  for_each_setting(config, [&](const std::string& name, const auto& field) {
    values.emplace_back(name, value_of(field));
  });
  return values;
}

void apply_setting(TrainingConfig& config, const std::string& name, double value) {
  bool found = false;
  for_each_setting(config, [&](const std::string& known, auto& field) {
    if (known != name) return;
    assign(field, value);
    found = true;
  });
  if (!found)
    throw std::invalid_argument("unknown setting '" + name + "': the manifest of a run lists them all");
}

}  // namespace mimicx
