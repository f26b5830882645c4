#include "physics/standing_state.h"

#include <numbers>

#include "physics/lanes.h"

namespace mimicx::physics {

State<double> standing_state(const Character& character) {
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  q[0] = exp_map(Vector3d(std::numbers::pi / 2, 0, 0));
  const double bend = 0.3;  // hip and ankle undo what the knee flexes: trunk upright, soles flat
  for (const int hip : {kLeftHip, kRightHip}) q[hip] = exp_map(Vector3d(-0.5 * bend, 0, 0));
  for (const int knee : {kLeftKnee, kRightKnee}) q[knee] = exp_map(Vector3d(bend, 0, 0));
  for (const int ankle : {kLeftAnkle, kRightAnkle}) q[ankle] = exp_map(Vector3d(-0.5 * bend, 0, 0));
  q[kLeftShoulder] = exp_map(Vector3d(0, 0, -1.25));
  q[kRightShoulder] = exp_map(Vector3d(0, 0, 1.25));
  q[kLeftElbow] = exp_map(0.3 * hinge_axis(kLeftElbow));
  q[kRightElbow] = exp_map(0.3 * hinge_axis(kRightElbow));
  State<double> state;
  for (int i = 0; i < kBodies; ++i) state.q[i] = from_eigen(q[i]);
  state.p_root.z = -lowest_contact(character, forward_kinematics(character, Vector3d::Zero(), q));
  return state;
}

Target<double> target_at(const State<double>& state) {
  Target<double> target;
  target.q = state.q;
  return target;
}

}  // namespace mimicx::physics
