/// The front door: from a reference to a motion that the simulator carries out, with its controls.
///
///     System system = make_system(character, options, reference, fps);
///     Plan plan = make_plan(system, {}, {.threads = 2});
///
/// Replaying `plan.residuals` as actions of rl::TrackingPack (residual mode, velocity feed-forward, the same
/// reference) gives `plan.states`, byte for byte. Budgets count iterations, never seconds, and the result
/// does not depend on the number of threads.
#pragma once

#include <optional>

#include "control/receding_horizon.h"

namespace mimicx::control {

struct PlanConfig {
  CostWeights weights;
  std::vector<Certainty> certainty;  ///< [frames], or empty
  Linearisation linearisation;
  HorizonOptions horizon;
};

/// Where a reference was lost and what it would have taken to follow it there.
struct Loss {
  int frame = -1;       ///< first frame that no window reached
  int body = -1;        ///< the body that was farthest from its reference in the last attempt
  double distance = 0;  ///< of it, m
};

struct Plan {
  std::vector<State<double>> states;  ///< [frames planned], from frame 0; all of them unless it was lost
  std::vector<std::array<float, kDofs>> residuals;  ///< [frames planned − 1]
  std::vector<std::array<float, kHelp>> help;       ///< [frames planned − 1] of a soft system, else empty
  Ending ending = Ending::kFollowed;
  std::optional<Loss> loss;
  double cost = 0;            ///< of the frames planned
  double worst_distance = 0;  ///< of any body in them, m
  int iterations = 0;         ///< over all windows
  int linearised = 0;         ///< frames, over all iterations
  int backtracks = 0;
};

/// @throws std::invalid_argument as make_cost does
Plan make_plan(const System& system, const PlanConfig& config, const PlanControl& control = {});

}  // namespace mimicx::control
