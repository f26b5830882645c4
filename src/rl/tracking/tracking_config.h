/// The configuration of the tracking task.
#pragma once

#include <numbers>

#include "physics/model.h"
#include "rl/tracking/reward.h"

namespace mimicx::rl::tracking {

/// Meaning of an action a_t ∈ R⁵⁵, a target pose as rotation vectors (angles for hinges).   docs/method.md §4
enum class ActionMode {
  kAbsolute,  ///< the paper's: the target itself
  kResidual,  ///< a rotation applied on top of the reference pose of frame t+1
};

/// What the PD controllers make of an action. Policies are right for the settings that they were trained with
/// alone.
struct ActionSettings {
  ActionMode mode = ActionMode::kResidual;
  bool velocity_feed_forward = true;  ///< PD damps towards the reference's joint velocity, not towards 0
  bool ramp = true;  ///< the target moves from the last action to this one during the frame, not at its start
  double max_action = std::numbers::pi;  ///< each entry is clamped to ± this, rad; π allows every rotation

  bool operator==(const ActionSettings&) const = default;
};

/// core/setting.h.
void visit_settings(ActionSettings& a, const auto& visit) {
  visit("residual_actions", a.mode, 0, 1, "1: actions are added to the reference; 0: absolute");
  visit("velocity_feed_forward", a.velocity_feed_forward, 0, 1,
        "1: PD damps towards the reference's velocity");
  visit("target_ramp", a.ramp, 0, 1, "1: PD's target moves to the action during the frame; 0: at its start");
  visit("max_action", a.max_action, 0, 1e9, "bound of each entry of an action, rad");
}

/// Defaults: docs/method.md §12 and docs/experiments.md.
struct TrackingConfig {
  ActionSettings actions;
  RewardWeights reward;
  physics::SimulationConfig simulation;
  double terminate_distance = 0.4;  ///< a body farther than this from its reference ends the episode, m
  int bin_frames = 10;              ///< frames per bin of starts and falls
  double uniform_starts = 0.4;      ///< share of starts drawn uniformly; the others before falls
  double reward_target = 0.5;       ///< mean of the learner's rewards below which they soften; 0: never
  double softest_reward = 0.1;      ///< smallest exponent of the softened reward
};

/// core/setting.h; those of the simulation apart (src/files/simulation_settings.h).
void visit_settings(TrackingConfig& t, const auto& visit) {
  visit_settings(t.actions, visit);
  visit("reward_root_position", t.reward.root_position, 0, 1e9, "sharpness for the pelvis' position, 1/m²");
  visit("reward_root_rotation", t.reward.root_rotation, 0, 1e9, "sharpness for the pelvis' rotation, 1/rad²");
  visit("reward_pose", t.reward.pose, 0, 1e9, "sharpness for joint rotations, 1/rad²");
  visit("reward_velocity", t.reward.velocity, 0, 1e9, "sharpness for joint velocities, s²/rad²");
  visit("reward_end_effector", t.reward.end_effector, 0, 1e9, "sharpness for hands and feet, 1/m²");
  visit("reward_projection", t.reward.projection, 0, 1e9, "sharpness for keypoints, 1/(box height)²");
  visit("reward_target", t.reward_target, 0, 1e9,
        "mean softened reward of an iteration below which rewards soften further; 0: never");
  visit("terminate_distance", t.terminate_distance, 0, 1e9, "distance of a body that ends an episode, m");
  visit("uniform_starts", t.uniform_starts, 0, 1,
        "share of episode starts drawn uniformly; the others where it fails");
}

}  // namespace mimicx::rl::tracking
