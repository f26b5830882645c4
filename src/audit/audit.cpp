#include "audit/audit.h"

#include <algorithm>
#include <cmath>

#include "audit/audit_summary.h"
#include "audit/body_loads.h"
#include "audit/feasibility.h"
#include "core/elementary.h"
#include "motion/resample.h"
#include "physics/inverse_dynamics.h"

namespace mimicx::audit {
namespace {

constexpr double kAir = 0.02;        ///< a body whose lowest contact point is higher is in the air, m
constexpr double kPosesRate = 30.0;  ///< to which poses are resampled for their accelerations, frames/s

/// World poses and velocities of all bodies.
struct Kinematics {
  BodyPoses poses;
  PerBody<Vector3d> w, v_com, p_com;
  Vector3d center;  ///< of mass
};

Kinematics kinematics_of(const Character& c, const motion::ReferenceFrame& s) {
  Kinematics k;
  k.poses = forward_kinematics(c, s.p_root, s.q);
  PerBody<Vector3d> v;
  k.center.setZero();
  for (std::size_t i = 0; i < kBodies; ++i) {
    const Vector3d w_J = k.poses.q_WB[i] * s.omega[i];
    if (i == 0) {
      k.w[i] = w_J;
      v[i] = s.v_root;
    } else {
      const int lambda = kParents[i];
      k.w[i] = k.w[lambda] + w_J;
      v[i] = v[lambda] + k.w[lambda].cross(k.poses.p_WB[i] - k.poses.p_WB[lambda]);
    }
    const Vector3d arm = k.poses.q_WB[i] * c.com_B[i];
    k.v_com[i] = v[i] + k.w[i].cross(arm);
    k.p_com[i] = k.poses.p_WB[i] + arm;
    k.center += c.mass[i] / c.total_mass() * k.p_com[i];
  }
  return k;
}

/// (angular about `point`; linear)
Vector6d momentum_of(const Character& c, const Kinematics& k, const Vector3d& point) {
  Vector6d h = Vector6d::Zero();
  for (std::size_t i = 0; i < kBodies; ++i) {
    const Quaterniond& q = k.poses.q_WB[i];
    const Vector3d p = c.mass[i] * k.v_com[i];
    h.head<3>() += q * (c.inertia_B[i] * (q.conjugate() * k.w[i])) + (k.p_com[i] - point).cross(p);
    h.tail<3>() += p;
  }
  return h;
}

/// A wrench (n; f) about `from`, moved to `to`.
Vector6d shifted(Vector6d wrench, const Vector3d& from, const Vector3d& to) {
  const Vector3d force = wrench.tail<3>();
  wrench.head<3>() += (from - to).cross(force);
  return wrench;
}

/// Height of a body's lowest contact point over the ground; infinite for one without any.
double height_of(const Character& c, const BodyPoses& poses, int body, const Scene& scene) {
  double lowest = HUGE_VAL;
  for (const ContactPoint& point : c.contact_points)
    if (point.body == body) lowest = std::min(lowest, scene.clearance(lowest_position(point, poses)));
  return lowest;
}

/// docs/physics.md §9, (12): how far the centre of mass went beyond the mean of its velocities, in parts of
/// what forces of the recorded impulse can do by their timing.
double travel_share(const Kinematics& before, const Kinematics& after, const Vector3d& v_before,
                    const Vector3d& v_after, double rate, double acceleration) {
  const Vector3d beyond = after.center - before.center - 0.5 / rate * (v_before + v_after);
  return beyond.norm() / (0.5 / (rate * rate) * acceleration);
}

/// Push, pull and friction of the ground's forces, into the row.
void judge_ground(const PerBody<Vector6d>& ground, double friction, AuditRow& row) {
  for (const Vector6d& wrench : ground) {
    const Vector3d f = wrench.tail<3>();
    row.normal += std::max(f.z(), 0.0);
    row.pull += std::max(-f.z(), 0.0);
    row.beyond_cone += std::max(f.head<2>().norm() - friction * std::max(f.z(), 0.0), 0.0);
  }
}

/// Forces of the ground on bodies that are in the air in both poses, N.
double force_in_air(const Character& c, const Scene& scene, const PerBody<Vector6d>& ground,
                    const BodyPoses& before, const BodyPoses& after) {
  double force = 0.0;
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d f = ground[i].tail<3>();
    if (f.isZero()) continue;
    if (std::min(height_of(c, before, i, scene), height_of(c, after, i, scene)) > kAir) force += f.norm();
  }
  return force;
}

/// Torques compared with their bounds and with the required ones, and their power, into the row.
/// @param speed  of the joints, child's frame, rad/s
void judge_joints(const Character& c, const rl::tracking::ActingForces& forces,
                  const PerBody<Vector3d>& required, const PerBody<Vector3d>& speed, AuditRow& row) {
  PerBody<Vector3d> by_controller;
  by_controller.fill(Vector3d::Zero());
  for (std::size_t i = 1; i < kBodies; ++i) {
    const int body = static_cast<int>(i);
    const auto along = [&](const Vector3d& v) {  // of a hinge only the part about its axis
      return is_hinge(body) ? Vector3d(v.dot(hinge_axis(body)) * hinge_axis(body)) : v;
    };
    const Vector3d torque = along(forces.joint_torque[i]), range = along(forces.range_torque[i]);
    row.torque_gap = std::max(row.torque_gap, (required[i] - torque).norm());
    by_controller[i] = torque - range;
    const double power = torque.dot(speed[i]);
    row.power += power;
    row.positive += std::max(power, 0.0);
    row.total += std::abs(power);
  }
  for (const double share : torque_shares(c, by_controller))
    row.torque_share = std::max(row.torque_share, share);
}

physics::BodyWrenches external_of(const rl::tracking::ActingForces& forces) {
  physics::BodyWrenches wrenches;
  for (std::size_t i = 0; i < kBodies; ++i) wrenches[i] = forces.ground[i] + forces.self_contact[i];
  return wrenches;
}

Vector3d ground_force(const rl::tracking::ActingForces& forces) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector6d& wrench : forces.ground) sum += wrench.tail<3>();
  return sum;
}

/// The state between two frames, and the mean acceleration.
physics::MotionState between(const motion::ReferenceFrame& a, const motion::ReferenceFrame& b, double rate,
                             double share) {
  physics::MotionState s;
  s.p_root = (1.0 - share) * a.p_root + share * b.p_root;
  s.v_root = (1.0 - share) * a.v_root + share * b.v_root;
  s.a_root = rate * (b.v_root - a.v_root);
  for (std::size_t i = 0; i < kBodies; ++i) {
    s.q[i] = share == 0.0 ? a.q[i] : slerp(a.q[i], share, b.q[i]);
    s.omega[i] = (1.0 - share) * a.omega[i] + share * b.omega[i];
    s.omega_d[i] = rate * (b.omega[i] - a.omega[i]);
  }
  return s;
}

/// Γ(q, v): the wrench about `point` that bodies need to move with constant velocity coordinates.
/// @param pose, velocity  the states that give q and v
Vector6d velocity_products(const Character& c, const physics::MotionState& pose,
                           const physics::MotionState& velocity, const Vector3d& point) {
  physics::MotionState s = pose;
  s.v_root = velocity.v_root;
  s.omega = velocity.omega;
  s.a_root.setZero();
  s.omega_d.fill(Vector3d::Zero());
  physics::BodyWrenches none;
  none.fill(Vector6d::Zero());
  return shifted(physics::inverse_dynamics(c, 0.0, s, none).root, s.p_root, point);
}

/// docs/physics.md §9, (11): the rate at which semi-implicit steps of `dt` change momentum beside the forces.
Vector6d integrator_share(const Character& c, double dt, double fps, const motion::ReferenceFrame& a,
                          const motion::ReferenceFrame& b, const Vector3d& point) {
  const physics::MotionState from = between(a, b, fps, 0.0), middle = between(a, b, fps, 0.5),
                             to = between(a, b, fps, 1.0);
  const auto change = [&](const physics::MotionState& v_to, const physics::MotionState& v_from) {
    return Vector6d(velocity_products(c, to, v_to, point) - velocity_products(c, from, v_from, point));
  };
  return dt * fps * (change(to, from) - 0.5 * change(middle, middle));
}

/// Two frames and what acted between them.
struct FrameInterval {
  const Kinematics &before, &after;
  const physics::BodyWrenches& external;  ///< mean wrenches about the joint centres
  double fps;
};

/// docs/physics.md §9, (10): change of momentum = weight and mean wrenches, about `point`.
Vector6d momentum_gap(const Character& c, double gravity, const FrameInterval& interval,
                      const Vector3d& point) {
  const Kinematics &before = interval.before, &after = interval.after;
  Vector6d gap = interval.fps * (momentum_of(c, after, point) - momentum_of(c, before, point));
  gap[5] += c.total_mass() * gravity;
  for (std::size_t i = 0; i < kBodies; ++i)
    gap -= shifted(interval.external[i], 0.5 * (before.poses.p_WB[i] + after.poses.p_WB[i]), point);
  return gap;
}

/// One physics step: velocities change by dt·a with a taken at the state before.
AuditRow step_row(const SubstepMotion& motion, const rl::tracking::Substep& step,
                  motion::ReferenceFrame next) {
  const Character& c = motion.character;
  const physics::SimulationConfig& o = motion.simulation;
  rl::tracking::Substep s = step;
  for (auto& q : s.state.q) q.normalize();
  for (auto& q : next.q) q.normalize();
  const physics::MotionState state = between(s.state, next, o.rate, 0.0);
  const physics::RequiredForces required =
      physics::inverse_dynamics(c, o.gravity, state, external_of(s.forces));
  const Kinematics before = kinematics_of(c, s.state);
  AuditRow row;
  row.root = shifted(required.root, s.state.p_root, before.center);
  judge_joints(c, s.forces, required.joint, next.omega, row);
  judge_ground(s.forces.ground, o.friction, row);
  row.in_air = force_in_air(c, motion.scene, s.forces.ground, before.poses, before.poses);
  return row;
}

}  // namespace

Audit audit_frames(const SimulatedFrames& motion, const physics::SimulationConfig& simulation) {
  const Character& c = motion.character;
  Audit audit;
  audit.evidence = Evidence::kFrames;
  audit.rate = motion.fps;
  audit.weight = simulation.gravity * c.total_mass();
  Kinematics before = motion.frames.empty() ? Kinematics{} : kinematics_of(c, motion.frames[0]);
  for (std::size_t t = 1; t < motion.frames.size(); ++t) {
    const motion::ReferenceFrame &a = motion.frames[t - 1], &b = motion.frames[t];
    const Kinematics after = kinematics_of(c, b);
    const physics::BodyWrenches external = external_of(motion.forces[t]);
    AuditRow row;
    row.index = static_cast<int>(t);
    const Vector3d point = 0.5 * (before.center + after.center);  // middle of the centre of mass' way
    row.root = momentum_gap(c, simulation.gravity, {before, after, external, motion.fps}, point) -
               integrator_share(c, 1.0 / simulation.rate, motion.fps, a, b, point);
    const physics::RequiredForces required =
        physics::inverse_dynamics(c, simulation.gravity, between(a, b, motion.fps, 0.5), external);
    PerBody<Vector3d> speed;
    for (std::size_t i = 0; i < kBodies; ++i) speed[i] = motion.fps * log_map(a.q[i].conjugate() * b.q[i]);
    judge_joints(c, motion.forces[t], required.joint, speed, row);
    judge_ground(motion.forces[t].ground, simulation.friction, row);
    row.in_air = force_in_air(c, motion.scene, motion.forces[t].ground, before.poses, after.poses);
    const Vector6d h_a = momentum_of(c, before, before.center), h_b = momentum_of(c, after, after.center);
    const double mass = c.total_mass();
    row.travel = travel_share(before, after, h_a.tail<3>() / mass, h_b.tail<3>() / mass, motion.fps,
                              hypot(1.0, simulation.friction) * row.normal / mass + simulation.gravity);
    row.lowest = lowest_contact(c, after.poses, motion.scene);
    audit.rows.push_back(row);
    before = after;
  }
  audit.failures = failures_of(audit);
  return audit;
}

Audit audit_steps(const SubstepMotion& motion) {
  Audit audit;
  audit.evidence = Evidence::kSteps;
  audit.rate = motion.simulation.rate;
  audit.weight = motion.simulation.gravity * motion.character.total_mass();
  for (std::size_t k = 0; k < motion.steps.size(); ++k) {
    const motion::ReferenceFrame& next =
        k + 1 < motion.steps.size() ? motion.steps[k + 1].state : motion.last;
    audit.rows.push_back(step_row(motion, motion.steps[k], next));
    audit.rows.back().index = static_cast<int>(k);
  }
  audit.failures = failures_of(audit);
  return audit;
}

Audit audit_replayed_steps(const SubstepMotion& motion) {
  const Replay replay = replay_in_double(motion);
  Audit audit;
  audit.evidence = Evidence::kReplayedSteps;
  audit.rate = motion.simulation.rate;
  audit.weight = motion.simulation.gravity * motion.character.total_mass();
  for (std::size_t k = 0; k < replay.steps.size(); ++k) {
    AuditRow row = step_row(motion, replay.steps[k], replay.next[k]);
    row.index = static_cast<int>(k);
    row.replay_gap = (ground_force(replay.steps[k].forces) - ground_force(motion.steps[k].forces)).norm();
    audit.rows.push_back(row);
  }
  audit.failures = failures_of(audit);
  return audit;
}

Audit audit_poses(const motion::Clip& clip) {
  const motion::Clip sampled = motion::resampled(clip, kPosesRate);
  Audit audit;
  const Character character = motion::character_of(sampled);
  const auto poses = motion::poses_of(sampled);
  audit.weight = physics::SimulationConfig{}.gravity * character.total_mass();
  int frame = 0;
  for (const FrameDemand& demand : motion_demands(sampled, {kFloorReach, kFloorReach, true})) {
    AuditRow row;
    row.index = ++frame;
    row.root.head<3>() = demand.residual_moment;
    row.root.tail<3>() = demand.residual_force;
    row.lowest = lowest_contact(character, poses[frame], sampled.scene);
    audit.rows.push_back(row);
  }
  audit.failures = failures_of(audit);
  return audit;
}

}  // namespace mimicx::audit
