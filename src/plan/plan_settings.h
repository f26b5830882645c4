/// How motions are planned, with the settings by their names: for manifests and `--set`.
#pragma once

#include "control/plan.h"
#include "files/simulation_settings.h"

namespace mimicx::plan {

/// Settings for a reference that may have errors. Its certainty is computed from the reference
/// (plan_motion.h).
struct MotionPlanConfig : control::PlanConfig {
  double plausible_acceleration =
      300.0;                   ///< a₀ of the certainty, m/s²; 0: the reference is certain everywhere
  double feasible_need = 0.3;  ///< f₀ of the momentum's factor, body weights
};

/// Everything that a plan depends on.
struct PlanningConfig {
  MotionPlanConfig plan;
  physics::SimulationConfig simulation;
};

/// core/setting.h. Constants of the method and no settings: the factors of single bodies, the weights of
/// assistive forces, the limits of closing gaps and of backtracks.
void visit_settings(MotionPlanConfig& config, const auto& visit) {
  auto& w = config.weights;
  visit("plan_position", w.position, 0, 1e9, "weight of a body's distance, 1/m²");
  visit("plan_root_rotation", w.root_rotation, 0, 1e9, "weight of the pelvis' rotation, 1/rad²");
  visit("plan_joint_rotation", w.joint_rotation, 0, 1e9, "weight of a joint's rotation, 1/rad²");
  visit("plan_root_velocity", w.root_velocity, 0, 1e9, "weight of the pelvis' velocity, s²/m²");
  visit("plan_root_spin", w.root_spin, 0, 1e9, "weight of the pelvis' angular velocity, s²/rad²");
  visit("plan_joint_velocity", w.joint_velocity, 0, 1e9, "weight of a joint's velocity, s²/rad²");
  visit("plan_com_velocity", w.com_velocity, 0, 1e9, "weight of the centre of mass' velocity, s²/m²");
  visit("plan_angular_momentum", w.angular_momentum, 0, 1e9,
        "weight of the angular momentum about the centre of mass, per mass, s²/m⁴");
  visit("plan_slip", w.slip, 0, 1e9, "weight of the mean square slip of a sole, s²/m²");
  visit("plan_box_sides", w.box_sides, 0, 1e9, "weight of the legs' depth in the sides of boxes, 1/m²");
  visit("plan_torque", w.torque, 0, 1e9, "weight of the joints' elastic torques per mass, s⁴/m⁴");
  visit("plan_feasible_need", config.feasible_need, 1e-6, 1e9,
        "external force of a frame, in body weights, at which its momentum counts a quarter");
  visit("plan_residual", w.residual, 1e-9, 1e9, "weight of a control, 1/rad²");
  visit("plan_change", w.change, 0, 1e9, "weight of a control's change per frame, 1/rad²");
  visit("plan_last", w.last, 1, 1e9, "factor on the state's cost in a window's last frame");
  auto& h = config.horizon;
  visit("plan_horizon", h.horizon, 1, 1000, "frames of a window");
  visit("plan_commit", h.commit, 1, 1000, "frames that a window settles");
  visit("plan_easy_cost", h.easy_cost, 0, 1e9, "cost per frame below which a window gets one iteration");
  visit("plan_iterations", h.iterations, 1, 1000, "iLQR iterations of a window, at most");
  visit("plan_hard_iterations", h.hard_iterations, 1, 1000,
        "the same of the first window and of those above plan_hard_cost");
  visit("plan_hard_cost", h.hard_cost, 0, 1e9, "cost per frame above which a window gets more iterations");
  visit("plan_stop", h.stop, 0, 1, "relative decrease of the cost under which iterations end");
  visit("plan_lost", h.failure_distance, 1e-3, 10, "distance of a body at which a window fails, m");
  visit("plan_back", h.back, 1, 1000, "frames to go back after a window that failed");
  visit("plan_budget", h.budget, 0, 1e6, "linearised frames per frame of the motion, at most");
  visit("plan_soft_to_hard", config.assisted_stages, 0, 1,
        "1: where the plan fails, plan with assistive forces first");
  visit("plan_stiffening", config.stiffening, 1.1, 1e9,
        "factor on the price of assistive forces from stage to stage");
  visit("plan_plausible_acceleration", config.plausible_acceleration, 0, 1e9,
        "acceleration above which the reference is trusted less, m/s²; 0: never");
}

void visit_settings(PlanningConfig& config, const auto& visit) {
  visit_settings(config.plan, visit);
  files::visit_settings(config.simulation, visit);
}

/// @throws std::invalid_argument naming a setting that no plan can have
void check(const PlanningConfig& config);

}  // namespace mimicx::plan
