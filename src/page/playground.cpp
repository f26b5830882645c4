#include "page/playground.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "control/trajectory.h"
#include "physics/lanes.h"

namespace mimicx::page {
namespace {

using rl::tracking::TrackingPack;
using P = TrackingPack::P;

/// A state moved up.
physics::State<double> raised(physics::State<double> x, double up) {
  x.p_root.z += up;
  return x;
}

/// The reference of the plan, bit for bit.
motion::Reference reference_of(const Character& character, const files::StoredPlan& plan, double up) {
  motion::Reference reference;
  reference.fps = plan.fps;
  reference.character = character;
  for (const physics::State<double>& x : plan.reference) {
    const motion::ReferenceFrame& frame =
        reference.frames.emplace_back(rl::tracking::frame_of_state(raised(x, up)));
    reference.poses.push_back(forward_kinematics(character, frame.p_root, frame.q));
    reference.flagged.push_back(false);
  }
  return reference;
}

/// The character without motors.
Character limp(Character character) {
  for (JointParameters& joint : character.joint) joint.kp = joint.kd = 0.0;
  return character;
}

double lowest_of(const Character& character, const physics::State<double>& x) {
  const motion::ReferenceFrame frame = rl::tracking::frame_of_state(x);
  return lowest_contact(character, forward_kinematics(character, frame.p_root, frame.q));
}

bool same(const physics::Vec3<double>& a, const physics::Vec3<double>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
bool same(const physics::Quat<double>& a, const physics::Quat<double>& b) {
  return a.w == b.w && a.x == b.x && a.y == b.y && a.z == b.z;
}
bool same(physics::State<double> a, const physics::State<double>& b) {
  bool equal = true;
  physics::for_each_member(a, b, [&](const auto& x, const auto& y) { equal = equal && same(x, y); });
  return equal;
}

control::Control control_of(const control::Plan& plan, int frame) {
  control::Control u{};
  if (frame >= 0) std::copy(plan.residuals[frame].begin(), plan.residuals[frame].end(), u.begin());
  return u;
}

}  // namespace

Playground::Playground(const Character& character, files::StoredPlan plan, std::vector<Eigen::MatrixXf> gains)
    : plan_(std::move(plan)),
      gains_(std::move(gains)),
      planned_for_(character),
      character_(character),
      scratch_(std::make_unique<physics::Data<P>>()) {
  if (frames() < 2 || static_cast<int>(gains_.size()) != frames() - 1)
    throw std::invalid_argument("a plan of at least 2 frames has gains for all of them but the last");
  config_.simulation = plan_.simulation;
  rebuild(false);
}

void Playground::rebuild(bool keep_state) {
  const Character& body = controller_ == Controller::kNone ? limp(character_) : character_;
  auto pack = std::make_unique<TrackingPack>(
      rl::tracking::make_tracking_clip(reference_of(body, plan_, up_), config_), config_);
  if (keep_state) pack->load(pack_->save());
  pack_ = std::move(pack);
  if (!keep_state) restart();
}

void Playground::restart() {
  for (int lane = 0; lane < physics::kLanes; ++lane) pack_->reset(lane, 0);
  before_ = {};
  rl::tracking::ActingForces none;
  none.joint_torque.fill(Vector3d::Zero());
  none.range_torque.fill(Vector3d::Zero());
  none.ground.fill(Vector6d::Zero());
  none.self_contact.fill(Vector6d::Zero());
  look(none);
}

void Playground::look(const rl::tracking::ActingForces& forces) {
  now_.frame = pack_->frame(0);
  now_.state = pack_->pose(0).frame;
  for (Quaterniond& q : now_.state.q) q.normalize();
  now_.poses = forward_kinematics(character_, now_.state.p_root, now_.state.q);
  now_.forces = forces;
  now_.distance = pack_->worst_distance(0);
  now_.unexplained.setZero();
}

const PlayedFrame& Playground::step() {
  const int frame = pack_->frame(0);
  if (frame + 1 >= frames() || !std::isfinite(now_.distance)) {
    restart();
    return now_;
  }
  control::Control u = control_of(plan_.plan, frame);
  const control::Control planned_before = control_of(plan_.plan, frame - 1);
  const physics::State<double> planned = raised(plan_.plan.states[frame], up_);
  // Of two equal states the difference is a rounding, not always zero.
  const bool disturbed = !same(physics::lane_of(pack_->state(), 0), planned) || before_ != planned_before;
  if (controller_ == Controller::kFeedback && disturbed) {
    control::LaneControls before;
    for (int k = 0; k < control::kMaxControls; ++k) before.row(k).setConstant(before_[k]);
    const control::LaneMemory dz =
        control::memory_difference(pack_->state(), before, planned, planned_before);
    const Eigen::VectorXf correction = gains_[static_cast<std::size_t>(frame)] * dz.col(0);
    for (int k = 0; k < kDofs; ++k) u[k] += correction[k];
  }
  for (int lane = 0; lane < physics::kLanes; ++lane) pack_->act(lane, u.data());
  physics::Applied<P> applied;
  physics::clear(applied);
  pack_->advance(*scratch_, &applied);
  before_ = u;
  const PlayedFrame last = now_;
  look(rl::tracking::acting_forces(applied));
  if (!std::isfinite(now_.distance)) return now_;
  const audit::Audit audit = audit::audit_frames(
      {character_, plan_.fps, {last.state, now_.state}, {last.forces, now_.forces}}, config_.simulation);
  now_.unexplained = audit.rows.at(0).root;
  return now_;
}

void Playground::push(const Vector3d& change) {
  for (int lane = 0; lane < physics::kLanes; ++lane) pack_->push(lane, change);
}

void Playground::set_controller(Controller controller) {
  controller_ = controller;
  rebuild(true);
}

void Playground::set_friction(double friction) {
  rl::tracking::TrackingConfig config = config_;
  config.simulation.friction = friction;
  physics::make_model<float>(character_, config.simulation);  // throws for invalid values
  config_ = config;
  rebuild(true);
}

void Playground::set_shape(const std::array<double, kBetas>& betas) { set_body(make_character(betas)); }

void Playground::set_body(const Character& character) {
  const physics::State<double>& first = plan_.reference.at(0);
  up_ = lowest_of(planned_for_, first) - lowest_of(character, first);
  character_ = character;
  rebuild(false);
}

}  // namespace mimicx::page
