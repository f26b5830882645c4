/// An artificial reference for the tests of the tracking task: every joint moves, the body turns and travels.
#pragma once

#include <cmath>

#include "core/random.h"
#include "motion/reference.h"
#include "rl/policy.h"
#include "rl/tracking/tracking_pack.h"

namespace mimicx::rl::tracking {

inline motion::ReferenceFrame random_frame(Random& random, double size) {
  motion::ReferenceFrame f;
  const auto vec = [&](double scale) {
    return Vector3d(scale * random.normal(), scale * random.normal(), scale * random.normal());
  };
  f.p_root = vec(1.0) + Vector3d(0, 0, 0.9);
  f.v_root = vec(1.0);
  for (int body = 0; body < kBodies; ++body) {
    Vector3d r = vec(size), w = vec(1.0);
    if (is_hinge(body)) {
      r = hinge_axis(body) * std::abs(r.x());
      w = hinge_axis(body) * w.x();
    }
    f.q[body] = exp_map(r);
    f.omega[body] = w;
  }
  f.q[0] = exp_map(Vector3d(std::acos(0.0), 0, 0)) * f.q[0];
  return f;
}

inline Pose pose_of(const Character& character, const motion::ReferenceFrame& frame) {
  return {frame, forward_kinematics(character, frame.p_root, frame.q).p_WB};
}

/// The same pose, turned by `angle` about the vertical and moved by `offset` on the floor.
inline Pose moved(const Character& character, const Pose& pose, double angle, const Eigen::Vector2d& offset) {
  motion::ReferenceFrame f = pose.frame;
  const Quaterniond turn = rotation_z(angle);
  f.p_root = turn * f.p_root + Vector3d(offset.x(), offset.y(), 0.0);
  f.v_root = turn * f.v_root;
  f.q[0] = turn * f.q[0];
  return pose_of(character, f);
}

/// The same motion on a plate of 20 m around the origin, 0.25 m over the floor.
inline motion::Reference on_a_plate(motion::Reference reference) {
  reference.scene.plates.push_back({{0.1, 0.2}, 0.4, {20.0, 20.0}, 0.25});
  for (motion::ReferenceFrame& frame : reference.frames) frame.p_root.z() += 0.25;
  for (BodyPoses& pose : reference.poses)
    for (Vector3d& p : pose.p_WB) p.z() += 0.25;
  return reference;
}

/// A swaying stance: knees bent, arms down, the trunk over the middle of the feet; `frames` at 30 fps.
inline motion::Reference swaying_reference(int frames) {
  motion::Reference reference;
  reference.name = "sway";
  reference.character = make_character();
  const double knee = 0.3, bow = 0.08;
  for (int t = 0; t < frames; ++t) {
    motion::ReferenceFrame f;
    const double phase = 2.0 * 3.14159265358979 * t / 60.0;
    for (auto& q : f.q) q = Quaterniond::Identity();
    f.q[0] = exp_map(Vector3d(std::acos(0.0) + bow, 0, 0));
    f.p_root = {0, 0, 0.951 - 0.784 * (1.0 - std::cos(0.5 * knee))};
    for (int side = 0; side < 2; ++side) {
      f.q[kLeftHip + side] = exp_map(Vector3d(-0.5 * knee - bow, 0, 0));
      f.q[kLeftKnee + side] = exp_map(Vector3d(knee, 0, 0));
      f.q[kLeftAnkle + side] = exp_map(Vector3d(-0.5 * knee, 0, 0));
    }
    f.q[kLeftShoulder] = exp_map(Vector3d(0, 0, -1.2 + 0.3 * std::sin(phase)));
    f.q[kRightShoulder] = exp_map(Vector3d(0, 0, 1.2 - 0.3 * std::sin(phase)));
    reference.frames.push_back(f);
  }
  motion::differentiate(reference.frames, reference.fps);
  for (const auto& f : reference.frames)
    reference.poses.push_back(forward_kinematics(reference.character, f.p_root, f.q));
  reference.flagged.assign(static_cast<std::size_t>(frames), false);
  return reference;
}

/// An agent whose mean action is `action` in every degree of freedom, for every state.
inline Agent agent_that_does(float action, int state_size = kStateSize) {
  AgentShape shape;
  shape.observation_dim = state_size;
  shape.action_dim = kDofs;
  shape.hidden = {4};
  Agent agent = make_agent(shape, 1);
  agent.actor.weights.back().setZero();
  agent.actor.biases.back().setConstant(action);
  return agent;
}

}  // namespace mimicx::rl::tracking
