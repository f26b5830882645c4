#include "oracles/mujoco_audit.h"

#include <algorithm>
#include <stdexcept>

#include "oracles/mujoco_inverse.h"

namespace mimicx::test {
namespace {

physics::BodyWrenches external_of(const rl::tracking::ActingForces& forces) {
  physics::BodyWrenches sum;
  for (int i = 0; i < kBodies; ++i) sum[i] = forces.ground[i] + forces.self_contact[i];
  return sum;
}

double torque_gap(const physics::RequiredForces& required, const rl::tracking::ActingForces& forces) {
  double largest = 0.0;
  for (int i = 1; i < kBodies; ++i) {
    Vector3d gap = required.joint[i] - forces.joint_torque[i];
    if (is_hinge(i)) gap = gap.dot(hinge_axis(i)) * hinge_axis(i);
    largest = std::max(largest, gap.norm());
  }
  return largest;
}

/// (n; f) about `from` as it reads about `to`.
Vector6d about(const Vector3d& to, Vector6d wrench, const Vector3d& from) {
  const Vector3d force = wrench.tail<3>();
  wrench.head<3>() += (from - to).cross(force);
  return wrench;
}

physics::MotionState still(const motion::ReferenceFrame& frame) {
  physics::MotionState s{frame.p_root, frame.v_root, Vector3d::Zero(), frame.q, frame.omega, {}};
  for (auto& q : s.q) q.normalize();
  s.omega_d.fill(Vector3d::Zero());
  return s;
}

void put_hinges_on_their_axes(motion::ReferenceFrame& frame) {
  for (int body = 1; body < kBodies; ++body) {
    if (!is_hinge(body)) continue;
    const Vector3d axis = hinge_axis(body);
    frame.q[body] = exp_map(axis.dot(log_map(frame.q[body].normalized())) * axis);
    frame.omega[body] = axis.dot(frame.omega[body]) * axis;
  }
}

std::vector<audit::AuditRow> step_rows(const audit::SubstepMotion& motion,
                                       const std::vector<rl::tracking::Substep>& steps,
                                       const std::vector<motion::ReferenceFrame>& next) {
  MujocoCharacter mujoco(motion.character, motion.simulation);
  const double rate = motion.simulation.rate;
  std::vector<audit::AuditRow> rows(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    physics::MotionState state = still(steps[k].state);
    state.a_root = rate * (next[k].v_root - state.v_root);
    for (int i = 0; i < kBodies; ++i) state.omega_d[i] = rate * (next[k].omega[i] - state.omega[i]);
    const physics::RequiredForces required =
        mujoco_inverse_dynamics(mujoco, state, external_of(steps[k].forces));
    rows[k].index = static_cast<int>(k);
    rows[k].root = about(mujoco_momentum(mujoco, state).center, required.root, state.p_root);
    rows[k].torque_gap = torque_gap(required, steps[k].forces);
  }
  return rows;
}

}  // namespace

audit::SubstepMotion on_hinge_axes(audit::SubstepMotion motion) {
  for (rl::tracking::Substep& step : motion.steps) put_hinges_on_their_axes(step.state);
  put_hinges_on_their_axes(motion.last);
  return motion;
}

audit::SimulatedFrames on_hinge_axes(audit::SimulatedFrames motion) {
  for (motion::ReferenceFrame& frame : motion.frames) put_hinges_on_their_axes(frame);
  return motion;
}

std::vector<audit::AuditRow> mujoco_audit_steps(const audit::SubstepMotion& motion) {
  std::vector<motion::ReferenceFrame> next;
  for (std::size_t k = 1; k < motion.steps.size(); ++k) next.push_back(motion.steps[k].state);
  next.push_back(motion.last);
  return step_rows(motion, motion.steps, next);
}

std::vector<audit::AuditRow> mujoco_audit_replayed_steps(const audit::SubstepMotion& motion) {
  const audit::Replay replay = audit::replay_in_double(motion);
  return step_rows(motion, replay.steps, replay.next);
}

std::vector<audit::AuditRow> mujoco_audit_frames(const audit::SimulatedFrames& motion,
                                                 const physics::SimulationConfig& simulation) {
  MujocoCharacter mujoco(motion.character, simulation);
  const double weight = simulation.gravity * motion.character.total_mass();
  std::vector<audit::AuditRow> rows;
  for (std::size_t t = 1; t < motion.frames.size(); ++t) {
    const physics::MotionState a = still(motion.frames[t - 1]), b = still(motion.frames[t]);
    const MujocoMomentum before = mujoco_momentum(mujoco, a), after = mujoco_momentum(mujoco, b);
    const Vector3d point = 0.5 * (before.center + after.center);
    const physics::BodyWrenches external = external_of(motion.forces[t]);
    physics::MotionState middle = a;
    middle.p_root = 0.5 * (a.p_root + b.p_root);
    middle.v_root = 0.5 * (a.v_root + b.v_root);
    middle.a_root = motion.fps * (b.v_root - a.v_root);
    for (int i = 0; i < kBodies; ++i) {
      middle.q[i] = a.q[i] * exp_map(0.5 * log_map(a.q[i].conjugate() * b.q[i]));
      middle.omega[i] = 0.5 * (a.omega[i] + b.omega[i]);
      middle.omega_d[i] = motion.fps * (b.omega[i] - a.omega[i]);
    }
    // Γ of docs/physics.md §9, (11); mj_inverse adds the weight, which acts at the centre of mass.
    const auto product = [&](physics::MotionState pose, const physics::MotionState& velocity) {
      pose.v_root = velocity.v_root;
      pose.omega = velocity.omega;
      physics::BodyWrenches none;
      none.fill(Vector6d::Zero());
      Vector6d weight_about_center = Vector6d::Zero();
      weight_about_center[5] = weight;
      return Vector6d(about(point, mujoco_inverse_dynamics(mujoco, pose, none).root, pose.p_root) -
                      about(point, weight_about_center, mujoco_momentum(mujoco, pose).center));
    };
    audit::AuditRow row;
    row.index = static_cast<int>(t);
    row.root = motion.fps * (about(point, after.about_center, after.center) -
                             about(point, before.about_center, before.center));
    row.root[5] += weight;
    const BodyPoses from = forward_kinematics(motion.character, a.p_root, a.q),
                    to = forward_kinematics(motion.character, b.p_root, b.q);
    for (int i = 0; i < kBodies; ++i)
      row.root -= about(point, external[i], 0.5 * (from.p_WB[i] + to.p_WB[i]));
    row.root -= motion.fps / simulation.rate *
                (product(b, b) - product(a, a) - 0.5 * (product(b, middle) - product(a, middle)));
    row.torque_gap = torque_gap(mujoco_inverse_dynamics(mujoco, middle, external), motion.forces[t]);
    rows.push_back(row);
  }
  return rows;
}

double largest_difference(const audit::Audit& audit, const std::vector<audit::AuditRow>& rows) {
  if (rows.size() != audit.rows.size()) throw std::invalid_argument("audits of different lengths");
  double largest = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const audit::AuditRow& ours = audit.rows[k];
    const double scale = std::max(audit.weight, ours.normal);
    for (const double difference : {(ours.root - rows[k].root).norm() / scale,
                                    std::abs(ours.torque_gap - rows[k].torque_gap) / scale}) {
      if (std::isnan(difference)) return difference;  // comparisons would skip a NaN
      largest = std::max(largest, difference);
    }
  }
  return largest;
}

}  // namespace mimicx::test
