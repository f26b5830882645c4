#include "rl/tracking/tracking_pack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/number_text.h"
#include "physics/control_interval.h"
#include "physics/lanes.h"

namespace mimicx::rl::tracking {
namespace {

using P = TrackingPack::P;

template <class F>
void for_each_value(physics::State<P>& state, physics::Target<P>& target, F&& f) {
  const auto vec = [&](physics::Vec3<P>& v) {
    f(v.x);
    f(v.y);
    f(v.z);
  };
  const auto quat = [&](physics::Quat<P>& q) {
    f(q.w);
    f(q.x);
    f(q.y);
    f(q.z);
  };
  vec(state.p_root);
  vec(state.v_root);
  for (auto& q : state.q) quat(q);
  for (auto& w : state.omega) vec(w);
  for (auto& q : target.q) quat(q);
  for (auto& w : target.omega) vec(w);
}

}  // namespace

TrackingPack::TrackingPack(std::shared_ptr<const TrackingClip> clip, const TrackingConfig& config)
    : clip_(std::move(clip)), config_(config) {
  for (int lane = 0; lane < physics::kLanes; ++lane) reset(lane, 0);
}

void TrackingPack::reset(int lane, int frame) {
  const Pose& start = clip_->poses[frame];
  frames_[lane] = frame;
  broken_[lane] = false;
  fresh_[lane] = true;
  poses_[lane] = start;
  physics::set_lane(state_.p_root, lane, start.frame.p_root);
  physics::set_lane(state_.v_root, lane, start.frame.v_root);
  for (int i = 0; i < kBodies; ++i) {
    physics::set_lane(state_.q[i], lane, start.frame.q[i]);
    physics::set_lane(state_.omega[i], lane, start.frame.omega[i]);
    physics::set_lane(to_.q[i], lane, start.frame.q[i]);
    physics::set_lane(to_.omega[i], lane,
                      config_.actions.velocity_feed_forward ? start.frame.omega[i] : Vector3d::Zero());
    physics::set_lane(from_.q[i], lane, start.frame.q[i]);
    physics::set_lane(from_.omega[i], lane,
                      config_.actions.velocity_feed_forward ? start.frame.omega[i] : Vector3d::Zero());
  }
}

void TrackingPack::copy_lane(int lane, const TrackingPack& other, int from) {
  physics::copy_lane(state_, lane, other.state_, from);
  physics::copy_lane(to_, lane, other.to_, from);
  physics::copy_lane(from_, lane, other.from_, from);
  frames_[lane] = other.frames_[from];
  poses_[lane] = other.poses_[from];
  broken_[lane] = other.broken_[from];
  fresh_[lane] = other.fresh_[from];
  saturated_[lane] = other.saturated_[from];
}

void TrackingPack::push(int lane, const Vector3d& change) {
  const Vector3d v = physics::lane_of(state_.v_root, lane) + change;
  physics::set_lane(state_.v_root, lane, v);
  poses_[lane].frame.v_root = physics::lane_of(state_.v_root, lane);
}

void TrackingPack::observe(int lane, int option, float* out) const {
  const int next = frame(lane) + 1;
  const auto& betas = clip_->reference.character.betas;
  if (!clip_->encoded.empty()) {
    const EncodedReference& encoded = clip_->encoded[option];
    const auto size = static_cast<std::size_t>(encoded.code_size);
    const std::span<const float> code(encoded.codes.data() + next * encoded.code_size, size);
    encoded_state(code, encoded.decoded[next], clip_->poses[next], betas, pose(lane), out);
    return;
  }
  tracking_state(clip_->poses[next], clip_->joints[next], betas, pose(lane), out);
}

void TrackingPack::act(int lane, const float* action) {
  const motion::ReferenceFrame& next = clip_->poses[frame(lane) + 1].frame;
  const bool residual = config_.actions.mode == ActionMode::kResidual;
  for (int body = 1; body < kBodies; ++body) {
    const Vector3d rotation =
        physics::action_rotation(body, config_.actions.max_action, [&](int dof) { return action[dof]; });
    physics::set_lane(to_.q[body], lane,
                      residual ? physics::residual_target(next.q[body], rotation) : exp_map(rotation));
    physics::set_lane(to_.omega[body], lane,
                      config_.actions.velocity_feed_forward ? next.omega[body] : Vector3d::Zero());
  }
  if (!config_.actions.ramp) physics::copy_lane(from_, lane, to_, lane);
}

void TrackingPack::advance(physics::Data<P>& scratch, physics::Applied<P>* applied,
                           const SubstepWatcher& watch) {
  const int substeps = static_cast<int>(std::lround(config_.simulation.rate / clip_->reference.fps));
  const physics::MaskOf<P> wrong =
      physics::advance_interval(clip_->model, {from_, to_, substeps}, state_, scratch, applied, watch);
  for (int lane = 0; lane < physics::kLanes; ++lane)
    if (wrong[lane] != 0) broken_[lane] = true;
  saturated_.fill(0);
  for (int i = 1; i < kBodies; ++i)
    for (int lane = 0; lane < physics::kLanes; ++lane)
      if (scratch.saturated[i][lane] != 0) ++saturated_[lane];
  physics::update_kinematics(clip_->model, state_, scratch);
  from_ = to_;
  fresh_.fill(false);
  for (int lane = 0; lane < physics::kLanes; ++lane) {
    auto& frame = frames_[lane];
    frame = std::min(frame + 1, clip_->size() - 1);
    read_pose(scratch, lane);
  }
}

void TrackingPack::read_pose(const physics::Data<P>& d, int lane) {
  Pose& pose = poses_[lane];
  pose.frame.p_root = physics::lane_of(state_.p_root, lane);
  pose.frame.v_root = physics::lane_of(state_.v_root, lane);
  for (int i = 0; i < kBodies; ++i) {
    pose.frame.q[i] = physics::lane_of(state_.q[i], lane).normalized();
    pose.frame.omega[i] = physics::lane_of(state_.omega[i], lane);
    pose.p_WB[i] = physics::lane_of(d.p_WB[i], lane);
  }
}

Reward TrackingPack::reward(int lane) const {
  if (broken_[lane]) return {};
  const int t = frame(lane);
  const KeypointFrame* keypoints = clip_->keypoints.empty() ? nullptr : &clip_->keypoints[t];
  return tracking_reward(config_.reward, clip_->poses[t], pose(lane), keypoints);
}

double TrackingPack::worst_distance(int lane) const {
  if (broken_[lane]) return std::numeric_limits<double>::infinity();
  const auto& reference = clip_->poses[frame(lane)].p_WB;
  double worst = 0.0;
  for (int i = 0; i < kBodies; ++i) worst = std::max(worst, (pose(lane).p_WB[i] - reference[i]).norm());
  return worst;
}

std::vector<float> TrackingPack::save() const {
  std::vector<float> values;
  physics::State<P> state = state_;
  physics::Target<P> target = to_;
  for_each_value(state, target, [&](P& x) {
    for (int lane = 0; lane < physics::kLanes; ++lane) values.push_back(x[lane]);
  });
  for (int lane = 0; lane < physics::kLanes; ++lane) {
    values.push_back(static_cast<float>(frames_[lane]));
    values.push_back(fresh_[lane] ? 1.0f : 0.0f);
  }
  return values;
}

void TrackingPack::load(const std::vector<float>& values) {
  if (values.size() != save().size()) throw std::invalid_argument("a saved pack has another size");
  std::size_t k = 0;
  for_each_value(state_, to_, [&](P& x) {
    for (int lane = 0; lane < physics::kLanes; ++lane) x.set(lane, values[k++]);
  });
  from_ = to_;
  broken_.fill(false);
  physics::Data<P> d;
  physics::update_kinematics(clip_->model, state_, d);
  for (int lane = 0; lane < physics::kLanes; ++lane) {
    const float frame = values[k++];
    if (!(frame >= 0.0f && frame < static_cast<float>(clip_->size())))
      throw std::invalid_argument("frame " + text_of(frame) + " of " + std::to_string(clip_->size()));
    frames_[lane] = static_cast<int>(frame);
    fresh_[lane] = values[k++] != 0.0f;
    if (fresh_[lane])
      poses_[lane] = clip_->poses[frames_[lane]];
    else
      read_pose(d, lane);
  }
}

}  // namespace mimicx::rl::tracking
