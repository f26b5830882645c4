/// The configuration of the tracking task.
#pragma once

#include "physics/model.h"
#include "rl/tracking/reward.h"

namespace mimicx::rl::tracking {

/// Meaning of an action a_t ∈ R⁵⁵, a target pose as rotation vectors (angles for hinges).   docs/method.md §4
enum class ActionMode {
  kAbsolute,  ///< the paper's: the target itself
  kResidual,  ///< a rotation applied on top of the reference pose of frame t+1
};

/// Defaults: docs/method.md §12 and docs/experiments.md.
struct TrackingConfig {
  ActionMode action_mode = ActionMode::kResidual;
  bool velocity_feed_forward = true;  ///< PD damps towards the reference's joint velocity, not towards 0
  double max_action = 2.5;            ///< each entry of an action is clamped to ± this, rad
  RewardWeights reward;
  physics::SimulationConfig simulation;
  double terminate_distance = 0.4;  ///< a body farther than this from its reference ends the episode, m
  int bin_frames = 10;              ///< frames per bin of starts and falls
  double uniform_starts = 0.4;      ///< share of starts drawn uniformly; the others before falls
  double reward_target = 0.5;       ///< below this mean reward the learner's reward is softened; 0: never
  double softest_reward = 0.1;      ///< smallest exponent of the softened reward
};

}  // namespace mimicx::rl::tracking
