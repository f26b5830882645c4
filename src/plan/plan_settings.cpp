#include "plan/plan_settings.h"

#include <stdexcept>

#include "core/setting.h"
#include "files/simulation_settings.h"
#include "rl/tracking/tracking_pack.h"

namespace mimicx::plan {
namespace {

/// Calls add(name, field, least, most) for every number of the plan.
template <class Config, class Add>
void for_each_plan_setting(Config& config, const Add& add) {
  auto& w = config.weights;
  add("plan_position", w.position, 0, 1e9);
  add("plan_root_rotation", w.root_rotation, 0, 1e9);
  add("plan_joint_rotation", w.joint_rotation, 0, 1e9);
  add("plan_root_velocity", w.root_velocity, 0, 1e9);
  add("plan_root_spin", w.root_spin, 0, 1e9);
  add("plan_joint_velocity", w.joint_velocity, 0, 1e9);
  add("plan_residual", w.residual, 1e-9, 1e9);
  add("plan_change", w.change, 0, 1e9);
  add("plan_help", w.help, 0, 1e9);
  add("plan_help_spin", w.help_spin, 0, 1e9);
  add("plan_last", w.last, 1, 1e9);

  auto& h = config.horizon;
  add("plan_horizon", h.horizon, 1, 1000);
  add("plan_commit", h.commit, 1, 1000);
  add("plan_easy_cost", h.easy_cost, 0, 1e9);
  add("plan_iterations", h.iterations, 1, 1000);
  add("plan_hard_iterations", h.hard_iterations, 1, 1000);
  add("plan_hard_cost", h.hard_cost, 0, 1e9);
  add("plan_stop", h.stop, 0, 1);
  add("plan_trusted", h.trusted, 0, 10);
  add("plan_lost", h.lost, 1e-3, 10);
  add("plan_back", h.back, 1, 1000);
  add("plan_backtracks", h.backtracks, 0, 1000);
  add("plan_budget", h.budget, 0, 1e6);
  add("plan_soft_to_hard", config.soft_to_hard, 0, 1);
  add("plan_stiffening", config.stiffening, 1.1, 1e9);
  add("plan_plausible_acceleration", config.plausible_acceleration, 0, 1e9);
}

/// Those of the plan and of the simulation that it is made in.
template <class Config, class Add>
void for_each_planning_setting(Config& config, const Add& add) {
  for_each_plan_setting(config.plan, add);
  files::for_each_simulation_setting(config.simulation, add);
}

}  // namespace

NamedValues plan_settings(const MotionPlanConfig& plan) {
  return numbers_in([&](const auto& add) { for_each_plan_setting(plan, add); });
}

NamedValues planning_settings(const PlanningConfig& config) {
  return numbers_in([&](const auto& add) { for_each_planning_setting(config, add); });
}

bool change_setting(MotionPlanConfig& plan, const std::string& name, double value) {
  return change_one([&](const auto& add) { for_each_plan_setting(plan, add); }, name, value);
}

void apply_setting(PlanningConfig& config, const std::string& name, double value) {
  if (!change_one([&](const auto& add) { for_each_planning_setting(config, add); }, name, value))
    throw std::invalid_argument("unknown setting '" + name + "': `mimicx config` lists them all");
}

void check(const MotionPlanConfig& plan) {
  require_ranges([&](const auto& add) { for_each_plan_setting(plan, add); });
}

void check(const PlanningConfig& config) {
  check(config.plan);
  // What only the task and the simulator can judge, they judge themselves.
  rl::tracking::require_whole_steps(config.simulation.rate, motion::Reference{}.fps);
  physics::make_model<double>(make_character(), config.simulation);
}

}  // namespace mimicx::plan
