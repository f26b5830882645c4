#include "rl/tracking/tracking_rollout.h"

#include <algorithm>
#include <cmath>

#include "motion/metrics.h"
#include "physics/lanes.h"
#include "rl/tracking/tracking_clip.h"

namespace mimicx::rl::tracking {
namespace {

using P = TrackingPack::P;

Vector3d first_lane(const physics::Vec3<P>& v, double scale) { return scale * physics::lane_of(v, 0); }
Vector6d first_lane(const physics::Wrench<P>& w, double scale) {
  Vector6d out;
  out.head<3>() = first_lane(w.n, scale);
  out.tail<3>() = first_lane(w.f, scale);
  return out;
}

/// A watcher that appends every step to `out`. @param scratch  for the forces of one step
TrackingPack::SubstepWatcher recorder(const physics::Model<float>& model, physics::Applied<P>& scratch,
                                      TrackingRollout& out) {
  return [&](const physics::State<P>& before, const physics::Target<P>& target,
             const physics::Data<P>& solved, const physics::State<P>& after) {
    physics::clear(scratch);
    physics::record_applied(model, solved, scratch);
    Substep step{frame_of_state(physics::lane_of(before, 0)), {}, {}, acting_forces(scratch)};
    for (int i = 0; i < kBodies; ++i) {
      step.target_q[i] = i == 0 ? Quaterniond::Identity() : physics::lane_of(target.q[i], 0);
      step.target_omega[i] = physics::lane_of(target.omega[i], 0);
    }
    out.substeps.push_back(step);
    out.last_state = frame_of_state(physics::lane_of(after, 0));
  };
}

double mean_distance(const Pose& a, const Pose& b) {
  double sum = 0.0;
  for (int i = 0; i < kBodies; ++i) sum += (a.p_WB[i] - b.p_WB[i]).norm();
  return sum / kBodies;
}

}  // namespace

ActingForces acting_forces(const physics::Applied<P>& applied) {
  const double scale = applied.steps > 0 ? 1.0 / applied.steps : 0.0;
  ActingForces forces;
  for (int i = 0; i < kBodies; ++i) {
    forces.joint_torque[i] = first_lane(applied.joint_torque[i], scale);
    forces.range_torque[i] = first_lane(applied.range_torque[i], scale);
    forces.ground[i] = first_lane(applied.ground[i], scale);
    forces.self_contact[i] = first_lane(applied.self[i], scale);
  }
  return forces;
}

MeanAction mean_action(const std::vector<Agent>& agents) {
  struct Actor {
    List<Agent> agents;
    nn::Matrix<float> state, normalised, mean;
    nn::Workspace<float> workspace;
  };
  auto actor = std::make_shared<Actor>(Actor{agents, {}, {}, {}, {}});
  return [actor](int option, const float* state, float* action) {
    const Agent& agent = actor->agents[option];
    actor->state = Eigen::Map<const nn::Matrix<float>>(state, 1, agent.actor.inputs());
    nn::normalise(agent.observations, actor->state, actor->normalised);
    nn::evaluate(agent.actor, actor->normalised, actor->workspace, actor->mean);
    std::copy(actor->mean.data(), actor->mean.data() + kDofs, action);
  };
}

TrackingRollout roll_out(std::shared_ptr<const TrackingClip> clip, const TrackingConfig& config,
                         const MeanAction& policy, bool substeps) {
  TrackingRollout out;
  out.gravity = config.simulation.gravity;
  TrackingPack pack(clip, config);  // every lane starts on frame 0; lane 0 is recorded
  physics::Data<P> scratch;
  physics::Applied<P> applied, of_step;
  const TrackingPack::SubstepWatcher watch =
      substeps ? recorder(clip->model, of_step, out) : TrackingPack::SubstepWatcher{};
  physics::clear(applied);
  out.poses.push_back(pack.pose(0));
  out.rewards.push_back(pack.reward(0));
  out.forces.push_back(acting_forces(applied));
  std::vector<float> state(static_cast<std::size_t>(clip->state_size()));
  std::array<float, kDofs> action;
  for (int t = 1; t < clip->size(); ++t) {
    pack.observe(0, state.data());
    policy(clip->option_at(pack.frame(0)), state.data(), action.data());
    for (int lane = 0; lane < physics::kLanes; ++lane) pack.act(lane, action.data());
    physics::clear(applied);
    pack.advance(scratch, &applied, watch);
    const double distance = pack.worst_distance(0);
    out.worst_distance = std::max(out.worst_distance, distance);
    if (!std::isfinite(distance)) {
      out.broken = true;
      break;
    }
    out.poses.push_back(pack.pose(0));
    out.rewards.push_back(pack.reward(0));
    out.forces.push_back(acting_forces(applied));
    out.mean_reward += out.rewards.back().total;
    out.mean_position_error += mean_distance(pack.pose(0), clip->poses[t]);
  }
  const double steps = static_cast<double>(std::max<std::size_t>(out.poses.size() - 1, 1));
  out.mean_reward /= steps;
  out.mean_position_error /= steps;
  return out;
}

bool stays_with_clip(const TrackingRollout& rollout) {
  return !rollout.broken && rollout.worst_distance <= motion::kMaxBodyDistance;
}

double distance_from_clip(const TrackingRollout& rollout) {
  constexpr double kBroken = 100.0;
  if (rollout.broken) return rollout.mean_position_error + kBroken;
  return rollout.mean_position_error + (stays_with_clip(rollout) ? 0.0 : rollout.worst_distance);
}

}  // namespace mimicx::rl::tracking
