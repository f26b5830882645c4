/// Everything that the tracking task can be told.
#pragma once

#include "physics/model.h"
#include "rl/tracking/reward.h"

namespace mimicx::rl::tracking {

/// What an action a_t ∈ R⁵⁵ means: a target pose as rotation vectors (angles for hinges).   docs/method.md §4
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
  int bin_frames = 10;              ///< starts and failures are counted in bins of this many frames
  double uniform_starts = 0.4;      ///< share of the starts drawn uniformly; the rest where it fails
  double reward_target = 0.5;       ///< mean reward under which the learner's reward is softened; 0: never
  double softest_reward = 0.1;      ///< least exponent of the softened reward
};

}  // namespace mimicx::rl::tracking
