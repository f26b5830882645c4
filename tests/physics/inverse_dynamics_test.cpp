// The audit's inverse dynamics against the dense oracle, a hand calculation and the simulator.
#include "physics/inverse_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

/// Forces in the coordinates of the oracle.
Eigen::VectorXd tree_forces(const MotionState& m, const RequiredForces& forces) {
  const Quaterniond to_pelvis = m.q[0].conjugate();
  return tree_vector(to_pelvis * forces.root.head<3>(), to_pelvis * forces.root.tail<3>(), forces.joint);
}

/// The snapshot's pose at rest.
MotionState at_rest(const Snapshot& s) {
  MotionState m;
  m.p_root = s.p_root;
  m.v_root = m.a_root = Vector3d::Zero();
  m.q = s.q;
  m.omega.fill(Vector3d::Zero());
  m.omega_d.fill(Vector3d::Zero());
  return m;
}

TEST(InverseDynamics, EqualsTheDenseOracleOnRandomShapesStatesAndWrenches) {
  for (std::uint64_t n = 0; n < 60; ++n) {
    Random random(61, {n});
    const Character c = make_character(random_betas(random));
    const Snapshot s = random_snapshot(random, 2.5, 5.0, 1.0);
    const MotionState m = random_motion(s, random);
    const BodyWrenches wrenches = random_wrenches(random);
    const Quaterniond to_pelvis = s.q[0].conjugate();
    const Eigen::VectorXd qdd =
        tree_vector(m.omega_d[0], to_pelvis * m.a_root - s.omega[0].cross(to_pelvis * s.v_root), m.omega_d);
    const Eigen::VectorXd expected =
        trees::inverse_dynamics(trees::humanoid(c, kGravity), tree_state(s), qdd,
                                trees::TreeForces(wrenches.begin(), wrenches.end()));
    const Eigen::VectorXd found = tree_forces(m, inverse_dynamics(c, kGravity, m, wrenches));
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-11 * expected.cwiseAbs().maxCoeff());
  }
}

// Worked by hand: a two-link arm in the horizontal plane, no gravity. Only two bodies weigh: upper arm and
// forearm, 2 kg and 1 kg, points at the ends of links of 0.3 m and 0.2 m; the shoulder is held (a_root = 0).
// Both links lie along x at the start, elbow bent by 90° towards −z about its axis −y … so that with θ the
// angle about +y from x to the link: upper arm θ₁ = 0, forearm θ₁ + θ₂ = 90° (direction −z).
// With θ̇₁ = 2, θ̇₂ = 1, θ̈₁ = 3, θ̈₂ = −1 about +y and links e₁ = x, e₂ = −z; a point at the end of a link r
// has acceleration θ̈ (ŷ × r) − θ̇² r, ŷ × x = −z, ŷ × (−z) = −x:
//   elbow      0.3·3·(−z) − 4·0.3·x                    = (−1.2, 0, −0.9)
//   hand       elbow + 0.2·2·(−x) − 9·0.2·(−z)         = (−1.2 − 0.4, 0, −0.9 + 1.8) = (−1.6, 0, 0.9)
//   forces     upper 2·(−1.2, 0, −0.9) = (−2.4, 0, −1.8);  fore 1·(−1.6, 0, 0.9)
//   τ elbow    (0.2·(−z)) × (−1.6, 0, 0.9)   about y: r_z f_x − r_x f_z = (−0.2)(−1.6) = 0.32
//   τ shoulder 0.3 x × (−2.4, 0, −1.8) + (0.3, 0, −0.2) × (−1.6, 0, 0.9)
//              about y: −0.3·(−1.8) + [(−0.2)(−1.6) − 0.3·0.9] = 0.54 + 0.32 − 0.27 = 0.59
//   root force (−2.4 − 1.6, 0, −1.8 + 0.9) = (−4, 0, −0.9)
TEST(InverseDynamics, ReproducesTheTwoLinkArmWorkedByHand) {
  Character c = make_character();
  c.mass.fill(0.0);
  c.com_B.fill(Vector3d::Zero());
  c.inertia_B.fill(Matrix3d::Zero());
  for (JointParameters& j : c.joint) j.armature = 0.0;
  for (const int i : {kSpine1, kSpine2, kSpine3, kLeftCollar, kLeftShoulder}) c.joint_offset[i].setZero();
  c.joint_offset[kLeftElbow] = {0.3, 0, 0};
  c.mass[kLeftShoulder] = 2.0;
  c.com_B[kLeftShoulder] = {0.3, 0, 0};
  c.mass[kLeftElbow] = 1.0;
  c.com_B[kLeftElbow] = {0.2, 0, 0};
  MotionState m;
  m.p_root = m.v_root = m.a_root = Vector3d::Zero();
  m.q.fill(Quaterniond::Identity());
  m.omega.fill(Vector3d::Zero());
  m.omega_d.fill(Vector3d::Zero());
  const double quarter = std::acos(0.0);
  m.q[kLeftElbow] = exp_map(Vector3d(0, quarter, 0));
  m.omega[kLeftShoulder] = {0, 2, 0};
  m.omega_d[kLeftShoulder] = {0, 3, 0};
  m.omega[kLeftElbow] = {0, 1, 0};
  m.omega_d[kLeftElbow] = {0, -1, 0};
  BodyWrenches none;
  none.fill(Vector6d::Zero());
  const RequiredForces forces = inverse_dynamics(c, 0.0, m, none);
  EXPECT_LT((forces.joint[kLeftElbow] - Vector3d(0, 0.32, 0)).norm(), 1e-14);
  EXPECT_LT((forces.joint[kLeftShoulder] - Vector3d(0, 0.59, 0)).norm(), 1e-14);
  EXPECT_LT((forces.root.tail<3>() - Vector3d(-4, 0, -0.9)).norm(), 1e-14);
  EXPECT_LT((forces.root.head<3>() - Vector3d(0, 0.59, 0)).norm(), 1e-14);
}

/// The place of a contact point when one degree of freedom (of the 61) has moved by h: finite differences of
/// forward kinematics, independent of velocities and forces.
Vector3d moved_point(const Character& c, const Snapshot& s, const ContactPoint& point, int dof, double h) {
  Snapshot m = s;
  if (dof < 3) {
    m.q[0] = s.q[0] * exp_map(h * Vector3d::Unit(dof));
  } else if (dof < 6) {
    m.p_root += s.q[0] * Vector3d(h * Vector3d::Unit(dof - 3));
  } else {
    int body = 1;
    while (body + 1 < kBodies && first_dof(body + 1) <= dof - 6) ++body;
    const Vector3d axis =
        is_hinge(body) ? hinge_axis(body) : Vector3d(Vector3d::Unit(dof - 6 - first_dof(body)));
    m.q[body] = s.q[body] * exp_map(h * axis);
  }
  const BodyPoses poses = forward_kinematics(c, m.p_root, m.q);
  const int b = point.body;
  return poses.p_WB[b] + poses.q_WB[b] * point.p_B;
}

/// Jacobian of a contact point, 3 × 61, by differences.
Eigen::Matrix3Xd point_jacobian(const Character& c, const Snapshot& s, const ContactPoint& point) {
  constexpr double h = 1e-6;
  Eigen::Matrix3Xd J(3, kTreeDofs);
  for (int dof = 0; dof < kTreeDofs; ++dof)
    J.col(dof) = (moved_point(c, s, point, dof, h) - moved_point(c, s, point, dof, -h)) / (2.0 * h);
  return J;
}

TEST(Kinematics, PointVelocitiesAreTheJacobianOfDifferencesTimesTheRates) {
  Random random(62);
  const Character c = make_character(random_betas(random));
  const Snapshot s = random_snapshot(random, 2.5, 3.0, 1.0);
  Simulation<double> simulation(c, {}, s);
  update_kinematics(simulation.model, simulation.state, simulation.data);
  for (const ContactPoint& point : c.contact_points) {
    const int b = point.body;
    const Vector3d arm = lane_of(simulation.data.q_WB[b], 0) * point.p_B;
    const Vector3d v = lane_of(simulation.data.v[b], 0) + lane_of(simulation.data.w[b], 0).cross(arm);
    EXPECT_LT((v - point_jacobian(c, s, point) * tree_velocity(s)).norm(), 1e-7) << point.body;
  }
}

// Virtual work: without motion and gravity, the joints must hold −Jᵀf against a force f on a point.
TEST(InverseDynamics, PointForceNeedsTheTransposedJacobian) {
  Random random(63);
  const Character c = make_character(random_betas(random));
  Snapshot s = random_snapshot(random, 2.5, 0.0, 1.0);
  const MotionState m = at_rest(s);
  const BodyPoses poses = forward_kinematics(c, s.p_root, s.q);
  for (const ContactPoint& point : c.contact_points) {
    const int b = point.body;
    const Vector3d force = 100.0 * random_vector(random);
    BodyWrenches wrenches;
    wrenches.fill(Vector6d::Zero());
    wrenches[b].head<3>() = (poses.q_WB[b] * point.p_B).cross(force);
    wrenches[b].tail<3>() = force;
    const Eigen::VectorXd held = tree_forces(m, inverse_dynamics(c, 0.0, m, wrenches));
    EXPECT_LT((held + point_jacobian(c, s, point).transpose() * force).norm(), 1e-6 * force.norm());
  }
}

/// At rest without external wrenches the root requires the weight, about the pelvis.
TEST(InverseDynamics, AtRestIsTheWeightAtTheCentreOfMass) {
  const Character c = make_character();
  const Snapshot s = standing(c);
  const MotionState m = at_rest(s);
  BodyWrenches none;
  none.fill(Vector6d::Zero());
  const BodyPoses poses = forward_kinematics(c, s.p_root, s.q);
  Vector3d moment = Vector3d::Zero();
  for (int i = 0; i < kBodies; ++i)
    moment +=
        (poses.p_WB[i] + poses.q_WB[i] * c.com_B[i] - s.p_root).cross(Vector3d(0, 0, kGravity * c.mass[i]));
  const RequiredForces forces = inverse_dynamics(c, kGravity, m, none);
  EXPECT_LT((forces.root.tail<3>() - Vector3d(0, 0, kGravity * c.total_mass())).norm(), 1e-10);
  EXPECT_LT((forces.root.head<3>() - moment).norm(), 1e-10);
}

}  // namespace
}  // namespace mimicx::physics
