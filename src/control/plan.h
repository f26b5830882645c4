/// The front door: from a reference to a motion that the simulator carries out, with its controls.
///
///     System system = make_system(character, simulation, reference, fps);
///     Plan plan = make_plan(system, {}, {.threads = 2});
///
/// Replaying `plan.residuals` as actions of rl::tracking::TrackingPack (residual mode, velocity feed-forward,
/// the same reference) gives `plan.states`, byte for byte. Budgets count iterations, never seconds, and the
/// result does not depend on the number of threads.
///
/// A reference that is lost goes from soft to hard: a plan with help (system.h) follows it; help gets dearer
/// from stage to stage, each stage following the one before, and so draws the motion to what the body can do
/// by itself (a stage that is lost is tried by a shorter step); the last plan follows that and has no help.
/// What it comes to is a true simulation. If that is lost, too, the reference is planned once more from
/// farther away: distances cost less beside the rest. A soft system is planned with help alone; its result is
/// no simulation.
#pragma once

#include <optional>

#include "control/receding_horizon.h"

namespace mimicx::control {

struct PlanConfig {
  CostWeights weights;
  List<Certainty> certainty;  ///< [frames], or empty
  HorizonConfig horizon;
  bool soft_to_hard = true;  ///< where the reference is lost, plan again by way of help
  double stiffening = 8.0;   ///< factor on the price of help from stage to stage, at first
};

/// Where a reference was lost.
struct Loss {
  int frame = -1;       ///< first frame that no window reached
  int body = -1;        ///< the body that was farthest from its reference in the longest try
  double distance = 0;  ///< of it, m
};

struct Plan {
  List<State<double>> states;           ///< [frames planned], from frame 0; all of them unless it was lost
  List<Array<float, kDofs>> residuals;  ///< [frames planned − 1]
  List<Array<float, kHelp>> help;       ///< [frames planned − 1] of a soft system, else empty
  /// Help that was left in the soft stage of a hard plan, [frames that it reached − 1]: what somebody outside
  /// of the body would have to do. Empty where no soft stage was needed.
  List<Array<float, kHelp>> soft_help;
  Ending ending = Ending::kFollowed;
  std::optional<Loss> loss;
  bool by_way_of_help = false;  ///< followed only after a plan with help had shown how
  double cost = 0;              ///< of the frames planned
  double worst_distance = 0;    ///< of any body in them, m
  int iterations = 0;           ///< over all windows
  int linearised = 0;           ///< frames, over all iterations
  int backtracks = 0;
};

/// @throws std::invalid_argument as make_cost does
Plan make_plan(const System& system, const PlanConfig& config, const PlanControl& control = {});

/// Moments and forces on the pelvis that numbers of help stand for, N·m, N, world axes. @param mass  kg
List<Vector6d> wrenches_of(const List<Array<float, kHelp>>& help, double mass);

/// The plan as a trajectory, for feedback_gains and test_pushes.
Trajectory trajectory_of(const Plan& plan);

}  // namespace mimicx::control
