/// One deterministic roll-out of a policy over a whole clip, with the forces that acted on the character.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/units.h"
#include "rl/policy.h"
#include "rl/tracking/tracking_pack.h"

namespace mimicx::rl::tracking {

/// Mean action of a policy: s_t [state_size of the clip] → a_t [55].
using MeanAction = std::function<void(int option, const float* state, float* action)>;
/// The mean actions of agents, one per option; the agents are copied.
MeanAction mean_action(const std::vector<Agent>& agents);

/// Torques and forces on the character, as the implicit solver applied them.
struct ActingForces {
  PerBody<Vector3d> joint_torque;  ///< child's frame, N·m; entry 0 unused
  PerBody<Vector3d> range_torque;  ///< the part from the joint's range
  PerBody<Vector6d> ground;        ///< (moment, force) about the joint centre, world axes
  PerBody<Vector6d> self_contact;  ///< the same
};

/// Mean torques and forces on the first character of a pack over the summed steps; zero for no steps.
ActingForces acting_forces(const physics::Applied<TrackingPack::P>& applied);

/// One physics step: the state at its start with the simulator's own bits (quaternions are unit to float
/// rounding), the PD target, and the forces that acted.
struct Substep {
  motion::ReferenceFrame state;
  PerBody<Quaterniond> target_q;   ///< entry 0 unused
  PerBody<Vector3d> target_omega;  ///< child's frame, rad/s; entry 0 unused
  ActingForces forces;
};

/// One simulated motion; index 0 is the start on the reference's first frame. Forces are means over the
/// control interval that ends at the frame (zero at frame 0).
struct TrackingRollout {
  std::vector<Pose> poses;            ///< [frames]
  std::vector<Reward> rewards;        ///< [frames]
  std::vector<ActingForces> forces;   ///< [frames]
  std::vector<Substep> substeps;      ///< [physics steps], if requested
  motion::ReferenceFrame last_state;  ///< after the last physics step
  double gravity = kGravity;          ///< of the simulation, m/s²
  double worst_distance = 0;          ///< of any body from its reference, m
  double mean_reward = 0;             ///< over frames 1 …
  double mean_position_error = 0;     ///< all joints, world, frames 1 …, m
  bool broken = false;                ///< the simulation failed; frames end there
};

/// Follows the clip from its first frame to its last under the clip's arrangement. Falls do not end it, only
/// a numerical failure does.
/// @param substeps  also record every physics step; changes nothing else
TrackingRollout roll_out(std::shared_ptr<const TrackingClip> clip, const TrackingConfig& config,
                         const MeanAction& policy, bool substeps = false);

/// Whether it reached the clip's end and no body strayed beyond the limit of success (docs/metrics.md). A
/// mean reward counts with this alone: that of a broken roll-out is a mean over the frames before the
/// failure.
bool stays_with_clip(const TrackingRollout& rollout);

/// How far a roll-out is from its clip, m; smaller is better. The mean position error; where a body strayed
/// beyond the limit of success (docs/metrics.md), its largest distance on top, and where the simulation went
/// wrong, 100 m. So a roll-out that strayed is worse than any that did not.
double distance_from_clip(const TrackingRollout& rollout);

}  // namespace mimicx::rl::tracking
