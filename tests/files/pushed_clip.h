/// A moving body whose feet and one hand are pushed at known points of the floor by known forces.
#pragma once

#include <cmath>
#include <vector>

#include "files/archive_members.h"
#include "files/floor_forces.h"
#include "motion/clip.h"
#include "motion/standing_clip.h"

namespace mimicx::files {

/// Turns round more than once, with every joint in motion; no human could.
inline motion::Clip turning_clip(int frames) {
  motion::Clip clip = motion::standing_clip(frames);
  clip.betas[0] = 0.7;
  clip.betas[2] = -1.0;
  clip.fps = 25.0;
  for (int t = 0; t < frames; ++t) {
    const Quaterniond up = exp_map(clip.rotations[t][kPelvis]);
    clip.rotations[t][kPelvis] = log_map(rotation_z(0.4 * t) * up);
    clip.trans[t] += Vector3d(0.05 * t, -0.02 * t, 0.01 * std::sin(0.5 * t));
    for (int b = 1; b < kBodies; ++b)
      clip.rotations[t][b] +=
          0.3 * Vector3d(std::sin(0.3 * t + b), std::cos(0.2 * t - b), std::sin(0.1 * t * b));
  }
  return clip;
}

struct Push {
  int body;
  Vector3d point;  ///< on the floor, m
  Vector3d force;  ///< N
};

/// What pushes in the interval that ends at frame t. The left foot is in the air every third time.
inline std::vector<Push> pushes_at(int t) {
  std::vector<Push> pushes = {{kRightAnkle, {0.1, 0.2 + 0.01 * t, 0}, {20.0, -5.0, 300.0}},
                              {kRightAnkle, {0.05, 0.25, 0}, {-3.0, 8.0, 120.0}},
                              {kRightFoot, {0.2, 0.21, 0}, {1.0, 2.0, 80.0 + t}}};
  if (t % 3 != 0) pushes.push_back({kLeftFoot, {-0.3, 0.1, 0}, {-9.0, 4.0, 210.0}});
  if (t > 4) pushes.push_back({kLeftWrist, {0.6, -0.4, 0}, {0.0, 1.0, 30.0}});
  return pushes;
}

/// The torque in the interval that ends at frame t; along the axis of a hinge.
inline Vector3d torque_at(int t, int body) {
  return is_hinge(body) ? Vector3d((body - 0.5 * t) * hinge_axis(body))
                        : Vector3d(body + t, -2.0 * body, 0.25 * t);
}

/// The turning clip with these in its members, as the simulator records them.
inline motion::Clip pushed_clip(int frames) {
  motion::Clip clip = turning_clip(frames);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  WrenchRows ground(static_cast<std::size_t>(frames));
  VectorRows torques(static_cast<std::size_t>(frames));
  for (std::size_t t = 0; t < ground.size(); ++t) {
    ground[t].fill(Vector6d::Zero());
    torques[t].fill(Vector3d::Zero());
    if (t == 0) continue;
    for (const Push& push : pushes_at(static_cast<int>(t))) {
      const Vector3d joint = 0.5 * (poses[t - 1].p_WB[push.body] + poses[t].p_WB[push.body]);
      ground[t][push.body].head<3>() += (push.point - joint).cross(push.force);
      ground[t][push.body].tail<3>() += push.force;
    }
    for (int b = 1; b < kBodies; ++b) torques[t][b] = torque_at(static_cast<int>(t), b);
  }
  clip.passthrough.emplace_back("ground_wrenches", wrenches_member(ground, Precision::kFloat64));
  clip.passthrough.emplace_back("joint_torques", joints_member(torques, Precision::kFloat64));
  return clip;
}

/// What the pushes on a carrier come to, by the closed form for points on the floor: the centre of pressure
/// is their mean, weighted by the upward forces.
inline FloorForce sum_of_pushes(int t, Carrier carrier) {
  FloorForce sum;
  Vector3d weighted = Vector3d::Zero();
  for (const Push& push : pushes_at(t))
    if (carrier_of(push.body) == carrier) {
      sum.force += push.force;
      weighted += push.force.z() * push.point;
    }
  sum.loaded = sum.force.z() > 0.0;
  if (sum.loaded) sum.point = weighted / sum.force.z();
  for (const Push& push : pushes_at(t))
    if (carrier_of(push.body) == carrier) sum.free_moment += (push.point - sum.point).cross(push.force).z();
  return sum;
}

}  // namespace mimicx::files
