#include "rl/tracking/pack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "physics/lanes.h"
#include "physics/pd_target.h"

namespace mimicx::rl {
namespace {

using P = TrackingPack::P;

template <class F>
void for_each_value(State<P>& state, Target<P>& target, F&& f) {
  const auto vec = [&](Vec3<P>& v) {
    f(v.x);
    f(v.y);
    f(v.z);
  };
  const auto quat = [&](Quat<P>& q) {
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

void require_whole_steps(double physics_rate, double fps) {
  const double substeps = physics_rate / fps;
  if (!(substeps >= 1.0) || std::abs(substeps - std::round(substeps)) > 1e-9)
    throw std::invalid_argument("the physics rate must be a multiple of the reference's frame rate");
}

std::shared_ptr<const TrackingClip> make_tracking_clip(const Reference& reference,
                                                       const TrackingConfig& config) {
  if (reference.size() < 2) throw std::invalid_argument("a reference needs at least 2 frames");
  require_whole_steps(config.simulation.rate, reference.fps);
  auto clip = std::make_shared<TrackingClip>();
  clip->reference = reference;
  clip->model = make_model<float>(reference.character, config.simulation);
  for (std::size_t t = 0; t < reference.frames.size(); ++t)
    clip->poses.push_back({reference.frames[t], reference.poses[t].p_WB});
  Pose rest = clip->poses.back();
  rest.frame.v_root.setZero();
  for (auto& omega : rest.frame.omega) omega.setZero();
  clip->poses.push_back(rest);
  for (const Pose& pose : clip->poses) clip->joints.push_back(joint_features(pose.frame));
  if (reference.keypoints) clip->keypoints = match_keypoints(*reference.keypoints);
  return clip;
}

TrackingPack::TrackingPack(std::shared_ptr<const TrackingClip> clip, const TrackingConfig& config)
    : clip_(std::move(clip)), config_(config) {
  for (int lane = 0; lane < kLanes; ++lane) reset(lane, 0);
}

void TrackingPack::reset(int lane, int frame) {
  const auto n = static_cast<std::size_t>(lane);
  const Pose& start = clip_->poses[static_cast<std::size_t>(frame)];
  frames_[n] = frame;
  broken_[n] = false;
  fresh_[n] = true;
  poses_[n] = start;
  set_lane(state_.p_root, lane, start.frame.p_root);
  set_lane(state_.v_root, lane, start.frame.v_root);
  for (std::size_t i = 0; i < kBodies; ++i) {
    set_lane(state_.q[i], lane, start.frame.q[i]);
    set_lane(state_.omega[i], lane, start.frame.omega[i]);
    set_lane(to_.q[i], lane, start.frame.q[i]);
    set_lane(to_.omega[i], lane, config_.velocity_feed_forward ? start.frame.omega[i] : Vector3d::Zero());
    set_lane(from_.q[i], lane, start.frame.q[i]);
    set_lane(from_.omega[i], lane, config_.velocity_feed_forward ? start.frame.omega[i] : Vector3d::Zero());
  }
}

void TrackingPack::copy_lane(int lane, const TrackingPack& other, int from) {
  const auto to = static_cast<std::size_t>(lane), at = static_cast<std::size_t>(from);
  mimicx::copy_lane(state_, lane, other.state_, from);
  mimicx::copy_lane(to_, lane, other.to_, from);
  mimicx::copy_lane(from_, lane, other.from_, from);
  frames_[to] = other.frames_[at];
  poses_[to] = other.poses_[at];
  broken_[to] = other.broken_[at];
  fresh_[to] = other.fresh_[at];
  saturated_[to] = other.saturated_[at];
}

void TrackingPack::observe(int lane, int option, float* out) const {
  const auto next = static_cast<std::size_t>(frame(lane) + 1);
  const auto& betas = clip_->reference.character.betas;
  if (!clip_->encoded.empty()) {
    const EncodedReference& encoded = clip_->encoded[static_cast<std::size_t>(option)];
    const float* code = encoded.codes.data() + next * static_cast<std::size_t>(encoded.code_size);
    encoded_state(code, encoded.code_size, encoded.decoded[next], clip_->poses[next], betas, pose(lane), out);
    return;
  }
  tracking_state(clip_->poses[next], clip_->joints[next], betas, pose(lane), out);
}

void TrackingPack::act(int lane, const float* action) {
  const ReferenceFrame& next = clip_->poses[static_cast<std::size_t>(frame(lane) + 1)].frame;
  const bool residual = config_.action_mode == ActionMode::kResidual;
  for (int body = 1; body < kBodies; ++body) {
    const auto i = static_cast<std::size_t>(body);
    const Vector3d rotation = action_rotation(body, config_.max_action, [&](int dof) { return action[dof]; });
    set_lane(to_.q[i], lane, residual ? residual_target(next.q[i], rotation) : exp_map(rotation));
    set_lane(to_.omega[i], lane, config_.velocity_feed_forward ? next.omega[i] : Vector3d::Zero());
  }
}

void TrackingPack::advance(Data<P>& scratch, Applied<P>* applied, const SubstepWatcher& watch) {
  const int substeps = static_cast<int>(std::lround(config_.simulation.rate / clip_->reference.fps));
  const MaskOf<P> wrong =
      advance_interval(clip_->model, from_, to_, substeps, state_, scratch, applied, watch);
  for (int lane = 0; lane < kLanes; ++lane)
    if (wrong[lane] != 0) broken_[static_cast<std::size_t>(lane)] = true;
  saturated_.fill(0);
  for (std::size_t i = 1; i < kBodies; ++i)
    for (int lane = 0; lane < kLanes; ++lane)
      if (scratch.saturated[i][lane] != 0) ++saturated_[static_cast<std::size_t>(lane)];
  update_kinematics(clip_->model, state_, scratch);
  from_ = to_;
  fresh_.reset();
  for (int lane = 0; lane < kLanes; ++lane) {
    auto& frame = frames_[static_cast<std::size_t>(lane)];
    frame = std::min(frame + 1, clip_->size() - 1);
    read_pose(scratch, lane);
  }
}

void TrackingPack::read_pose(const Data<P>& d, int lane) {
  Pose& pose = poses_[static_cast<std::size_t>(lane)];
  pose.frame.p_root = lane_of(state_.p_root, lane);
  pose.frame.v_root = lane_of(state_.v_root, lane);
  for (std::size_t i = 0; i < kBodies; ++i) {
    pose.frame.q[i] = lane_of(state_.q[i], lane).normalized();
    pose.frame.omega[i] = lane_of(state_.omega[i], lane);
    pose.p_WB[i] = lane_of(d.p_WB[i], lane);
  }
}

Reward TrackingPack::reward(int lane) const {
  if (broken_[static_cast<std::size_t>(lane)]) return {};
  const auto t = static_cast<std::size_t>(frame(lane));
  const KeypointFrame* keypoints = clip_->keypoints.empty() ? nullptr : &clip_->keypoints[t];
  return tracking_reward(config_.reward, clip_->poses[t], pose(lane), keypoints);
}

double TrackingPack::worst_distance(int lane) const {
  if (broken_[static_cast<std::size_t>(lane)]) return std::numeric_limits<double>::infinity();
  const auto& reference = clip_->poses[static_cast<std::size_t>(frame(lane))].p_WB;
  double worst = 0.0;
  for (std::size_t i = 0; i < kBodies; ++i)
    worst = std::max(worst, (pose(lane).p_WB[i] - reference[i]).norm());
  return worst;
}

std::vector<float> TrackingPack::save() const {
  std::vector<float> values;
  State<P> state = state_;
  Target<P> target = to_;
  for_each_value(state, target, [&](P& x) {
    for (int lane = 0; lane < kLanes; ++lane) values.push_back(x[lane]);
  });
  for (std::size_t n = 0; n < kLanes; ++n) {
    values.push_back(static_cast<float>(frames_[n]));
    values.push_back(fresh_[n] ? 1.0f : 0.0f);
  }
  return values;
}

void TrackingPack::load(const std::vector<float>& values) {
  if (values.size() != save().size()) throw std::invalid_argument("a saved pack has another size");
  std::size_t k = 0;
  for_each_value(state_, to_, [&](P& x) {
    for (int lane = 0; lane < kLanes; ++lane) x.set(lane, values[k++]);
  });
  from_ = to_;
  broken_.reset();
  Data<P> d;
  update_kinematics(clip_->model, state_, d);
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto n = static_cast<std::size_t>(lane);
    frames_[n] = static_cast<int>(values[k++]);
    fresh_[n] = values[k++] != 0.0f;
    if (fresh_[n])
      poses_[n] = clip_->poses[static_cast<std::size_t>(frames_[n])];
    else
      read_pose(d, lane);
  }
}

}  // namespace mimicx::rl
