/// Plans a motion: from a reference to a motion that the simulator performs, with its controls.
///
///     System system = make_system(character, simulation, reference, fps);
///     Plan plan = make_plan(system, {}, {.threads = 2});
///
/// Replaying `plan.residuals` as actions of rl::tracking::TrackingPack (residual mode, velocity feed-forward,
/// the same reference) gives `plan.states`, byte for byte. Budgets count iterations, never seconds, and the
/// result does not depend on the number of threads.
///
/// If planning fails, assisted stages follow: assistive forces on the pelvis are added (assisted system,
/// system.h) and reduced to zero in stages:
///  1. a plan with assistive forces follows the reference;
///  2. each further stage raises the cost of these forces and follows the previous stage, so that the motion
///     approaches what the body can do unaided; a stage that fails is tried again with a smaller increase;
///  3. the last plan follows the last stage and has no assistive forces: it is a plain simulation.
/// If that fails, too, the reference is planned once more with lower weights on distances. For an assisted
/// system step 1 is the result, which is no plain simulation.
#pragma once

#include <optional>

#include "control/receding_horizon.h"

namespace mimicx::control {

struct PlanConfig {
  CostWeights weights;
  List<FrameFactors> factors;  ///< [frames], or empty (make_cost)
  HorizonConfig horizon;
  bool assisted_stages = true;  ///< if planning fails, plan again with assistive forces
  double stiffening = 8.0;      ///< factor on the cost of assistive forces per stage, initially
};

/// The failure of a plan.
struct Failure {
  int frame = -1;  ///< first frame that no window reached
  int body = -1;   ///< farthest from its goal there, or one frame before if the window was cut there; -1:
                   ///< nothing was reached
  double distance = 0;  ///< its distance, m
};

struct Plan {
  List<State<double>> states;           ///< [frames planned], from frame 0; all frames unless it failed
  List<Array<float, kDofs>> residuals;  ///< [frames planned − 1]
  List<Array<float, kAssistance>> assistance;  ///< [frames planned − 1] of an assisted system; else empty
  /// Assistive accelerations of the first stage of an unassisted plan, [frames that it reached − 1]: the
  /// external forces that the reference would need. Empty if no stage was needed.
  List<Array<float, kAssistance>> stage_assistance;
  Ending ending = Ending::kFollowed;
  std::optional<Failure> failure;
  bool by_assisted_stages = false;  ///< followed after stages with assistive forces
  double cost = 0;                  ///< of the planned frames
  double worst_distance = 0;        ///< largest distance of a body, m
  int iterations = 0;               ///< over all windows
  int linearised = 0;               ///< frames, over all iterations
  int backtracks = 0;
};

/// @throws std::invalid_argument as make_cost does
Plan make_plan(const System& system, const PlanConfig& config, const PlanControl& control = {});

/// Assistive moments and forces on the pelvis, N·m, N, world axes.
/// @param assistance  accelerations
/// @param mass  kg
List<Vector6d> wrenches_of(const List<Array<float, kAssistance>>& assistance, double mass);

/// The plan as a trajectory, for feedback_gains and test_pushes.
Trajectory trajectory_of(const Plan& plan);

}  // namespace mimicx::control
