/// States for the tests: one character in plain doubles, and conversions to and from the simulator's lanes
/// and the tree of src/trees.
#pragma once

#include <initializer_list>

#include "core/random.h"
#include "physics/inverse_dynamics.h"
#include "physics/lanes.h"
#include "physics/step.h"
#include "trees/tree_dynamics.h"

namespace mimicx::physics {

/// One character's state and PD target in doubles; conventions of physics/data.h.
struct Snapshot {
  Vector3d p_root = Vector3d::Zero(), v_root = Vector3d::Zero();
  PerBody<Quaterniond> q;
  PerBody<Vector3d> omega;
  PerBody<Quaterniond> target_q;
  PerBody<Vector3d> target_omega;
};

/// Upright with bent knees and arms down, at rest, PD target = pose; soles on the floor.
Snapshot standing(const Character& character);
/// Leans the whole body over its ankles until the centre of mass is above the middle of the soles of `feet`
/// (kLeftFoot, kRightFoot), these soles flat on the floor; PD target = pose.
void balance(const Character& character, std::initializer_list<int> feet, Snapshot& s);
/// The character with joints stiff enough to stand without a policy (with the true gains the ankles are
/// softer than m g h, and a passive stance tips over).
Character stiffened(Character character);
/// Any orientation, joints up to `angle` rad from the T-pose, speeds of about `speed` m/s and rad/s;
/// targets another such pose. Pelvis at `height`.
Snapshot random_snapshot(Random& random, double angle, double speed, double height);
std::array<double, kBetas> random_betas(Random& random);
Vector3d random_vector(Random& random);

/// The snapshot's positions and velocities with random accelerations; wrenches on every body.
MotionState random_motion(const Snapshot& s, Random& random);
BodyWrenches random_wrenches(Random& random);

/// Height of the lowest contact point (its sphere's lowest point), m.
double lowest_point(const Character& character, const Snapshot& s);

/// Degrees of freedom of the character as a tree: 6 of the pelvis and 55 of the joints.
inline constexpr int kTreeDofs = 6 + kDofs;
trees::TreeState tree_state(const Snapshot& s);
/// The tree's coordinates of six numbers of the root and one vector per joint (entry 0 unused), child's
/// frame.
Eigen::VectorXd tree_vector(const Vector3d& angular, const Vector3d& linear, const PerBody<Vector3d>& joints);
Eigen::VectorXd tree_velocity(const Snapshot& s);
/// Generalised acceleration that the simulator found, in the tree's coordinates.
Eigen::VectorXd tree_acceleration(const Snapshot& s, const Data<double>& d);
/// Torques of the joints (entry 0 unused, child's frame) as the tree's generalised forces.
Eigen::VectorXd tree_torque(const PerBody<Vec3<double>>& tau);

template <class T>
void set_lane(const Snapshot& s, int lane, State<T>& state, Target<T>& target) {
  set_lane(state.p_root, lane, s.p_root);
  set_lane(state.v_root, lane, s.v_root);
  for (int i = 0; i < kBodies; ++i) {
    set_lane(state.q[i], lane, s.q[i]);
    set_lane(state.omega[i], lane, s.omega[i]);
    set_lane(target.q[i], lane, s.target_q[i]);
    set_lane(target.omega[i], lane, s.target_omega[i]);
  }
}
/// The state of a lane; the targets are left as they are.
template <class T>
void read_lane(const State<T>& state, int lane, Snapshot& s) {
  s.p_root = lane_of(state.p_root, lane);
  s.v_root = lane_of(state.v_root, lane);
  for (int i = 0; i < kBodies; ++i) {
    s.q[i] = lane_of(state.q[i], lane);
    s.omega[i] = lane_of(state.omega[i], lane);
  }
}

/// State, target and scratch of one simulated character or pack, on the heap (a pack of 16 is large).
template <class T>
struct Simulation {
  Model<RealOf<T>> model;
  State<T> state{};
  Target<T> target{};
  Data<T> data{};
  Applied<T> applied{};

  Simulation(const Character& character, const SimulationConfig& config)
      : model(make_model<RealOf<T>>(character, config)) {}
  Simulation(const Character& character, const SimulationConfig& config, const Snapshot& s)
      : Simulation(character, config) {
    for (int lane = 0; lane < ScalarTraits<T>::kSize; ++lane) set_lane(s, lane, state, target);
  }
  /// One step; `applied` has its torques and forces alone.
  MaskOf<T> advance() {
    clear(applied);
    return step(model, target, state, data, &applied);
  }
};

}  // namespace mimicx::physics
