// The book's algorithms on trees whose equations of motion are known.
#include <gtest/gtest.h>

#include "core/decompositions.h"
#include "core/elementary.h"
#include "core/random.h"
#include "trees/tree_dynamics.h"

namespace mimicx::trees {
namespace {

const Vector3d kY = Vector3d::UnitY();  // hinges turn in the x-z plane: a link along −z swings towards −x

/// A thin rod of that length along −z from its origin.
RigidBody rod(double mass, double length) {
  const double I = mass * length * length / 12.0;
  return {mass, Vector3d(0, 0, -length / 2), Vector3d(I, I, 0).asDiagonal()};
}

/// The acceleration by the articulated bodies; the dense solution agrees.
VectorXd accelerations(const Tree& tree, const TreeState& state, const VectorXd& tau) {
  const VectorXd qdd = forward_dynamics(tree, state, tau);
  EXPECT_LT((qdd - dense_forward_dynamics(tree, state, tau)).norm(), 1e-11 * (1.0 + qdd.norm()));
  return qdd;
}

TEST(Trees, PendulumFollowsItsEquation) {
  Tree tree;
  tree.add(-1, Vector3d(0, 0, 2), hinge(kY), rod(3.0, 1.5));
  tree.body[0].armature = 0.2;
  TreeState state = rest_state(tree);
  set_position(tree, 0, 0.7, state);
  EXPECT_NEAR(position(tree, state, 0), 0.7, 1e-14);
  const double I = 3.0 * 1.5 * 1.5 / 3.0 + 0.2;
  const double qdd = accelerations(tree, state, VectorXd::Constant(1, 2.0))(0);
  EXPECT_NEAR(qdd, (2.0 - 3.0 * kGravity * 0.75 * sin(0.7)) / I, 1e-12);
}

// The double pendulum of the textbooks: point masses on links l₁, l₂, absolute angles θ₁, θ₂ = θ₁ + q₂.
TEST(Trees, TwoLinkArmFollowsTheDoublePendulum) {
  const double m1 = 2.0, m2 = 1.5, l1 = 0.8, l2 = 0.6, w1 = 1.3, w2 = 0.4, th1 = 0.5, th2 = -0.4;
  Tree tree;
  tree.add(-1, Vector3d::Zero(), hinge(kY), {m1, Vector3d(0, 0, -l1), Matrix3d::Zero()});
  tree.add(0, Vector3d(0, 0, -l1), hinge(kY), {m2, Vector3d(0, 0, -l2), Matrix3d::Zero()});
  TreeState state = rest_state(tree);
  set_position(tree, 0, th1, state);
  set_position(tree, 1, th2 - th1, state);
  state.qd << w1, w2 - w1;
  const VectorXd qdd = accelerations(tree, state, VectorXd::Zero(2));
  const double d = th1 - th2;
  Eigen::Matrix2d M;
  M << (m1 + m2) * l1, m2 * l2 * cos(d), l1 * cos(d), l2;
  const Eigen::Vector2d right(-m2 * l2 * w2 * w2 * sin(d) - (m1 + m2) * kGravity * sin(th1),
                              l1 * w1 * w1 * sin(d) - kGravity * sin(th2));
  const Eigen::Vector2d expected = M.inverse() * right;
  EXPECT_NEAR(qdd(0), expected(0), 1e-12);
  EXPECT_NEAR(qdd(0) + qdd(1), expected(1), 1e-12);
}

// Barto, Sutton and Anderson (1983), without friction: θ from upright, half length l, force F on the cart.
TEST(Trees, CartPoleFollowsItsEquations) {
  const double m = 0.1, M = 1.0, l = 0.5, F = 7.0, theta = 0.3, w = -1.1;
  Tree tree;
  const int cart = tree.add(-1, Vector3d::Zero(), slider(Vector3d::UnitX()), {M});
  const RigidBody pole = {m, Vector3d(0, 0, l), Vector3d(m * l * l / 3, m * l * l / 3, 0).asDiagonal()};
  tree.add(cart, Vector3d::Zero(), hinge(kY), pole);
  TreeState state = rest_state(tree);
  set_position(tree, cart, 3.0, state);
  set_position(tree, 1, theta, state);
  EXPECT_NEAR(position(tree, state, cart), 3.0, 1e-14);
  state.qd << 0.6, w;
  const VectorXd qdd = accelerations(tree, state, Eigen::Vector2d(F, 0));
  const double s = sin(theta), c = cos(theta), total = m + M;
  const double alpha =
      (kGravity * s - c * (F + m * l * w * w * s) / total) / (l * (4.0 / 3.0 - m * c * c / total));
  EXPECT_NEAR(qdd(1), alpha, 1e-12);
  EXPECT_NEAR(qdd(0), (F + m * l * (w * w * s - alpha * c)) / total, 1e-12);
}

/// A planar hopper: a body on two sliders and a hinge, a leg on a hinge and a slider.
Tree hopper() {
  Tree tree;
  const int x = tree.add(-1, Vector3d::Zero(), slider(Vector3d::UnitX()), {});
  const int z = tree.add(x, Vector3d::Zero(), slider(Vector3d::UnitZ()), {});
  const int body =
      tree.add(z, Vector3d::Zero(), hinge(kY), {10.0, Vector3d(0, 0, 0.1), Matrix3d::Identity()});
  const int hip = tree.add(body, Vector3d::Zero(), hinge(kY), rod(1.0, 0.5));
  tree.add(hip, Vector3d(0, 0, -0.5), slider(Vector3d::UnitZ()), rod(0.3, 0.4));
  return tree;
}

TEST(Trees, HopperInFlightFallsAsItsCentreOfMassAndKeepsItsEnergy) {
  const Tree tree = hopper();
  TreeState state = rest_state(tree);
  state.qd << 1.0, 2.0, 0.5, -1.5, 0.3;
  // The sliders are parallel to the world: the first two rows of H q̇ are the linear momentum.
  const auto linear_momentum = [&] { return (mass_matrix(tree, state) * state.qd).head<2>().eval(); };
  const Eigen::Vector2d before = linear_momentum();
  const double energy = kinetic_energy(tree, state) + potential_energy(tree, state);
  const double dt = 1e-4;
  for (int k = 0; k < 5000; ++k) integrate(tree, accelerations(tree, state, VectorXd::Zero(5)), dt, state);
  EXPECT_LT((linear_momentum() - before - Eigen::Vector2d(0, -11.3 * kGravity * 0.5)).norm(), 2e-2);
  EXPECT_NEAR(kinetic_energy(tree, state) + potential_energy(tree, state), energy, 5e-2);
}

TEST(Trees, IntegratesVelocitiesFirstAndMovesAlongTheOrientationBeforeTheStep) {
  Tree tree;
  tree.add(-1, Vector3d::Zero(), free_joint(), rod(1.0, 0.5));
  TreeState state = rest_state(tree);
  const Vector3d spin(0.3, -2.0, 1.0), speed(1.0, 0.5, -0.4);
  state.R[0] = exp_map(Vector3d(0.4, 0.2, -0.9)).toRotationMatrix();
  state.qd << spin, speed;
  const TreeState before = state;
  VectorXd qdd(6);
  qdd << 40.0, -30.0, 20.0, 10.0, 15.0, -25.0;
  const double dt = 0.1;
  integrate(tree, qdd, dt, state);
  EXPECT_LT((state.qd - before.qd - dt * qdd).norm(), 1e-15);
  EXPECT_LT((state.p[0] - before.p[0] - dt * (before.R[0] * state.qd.tail<3>())).norm(), 1e-14);
  EXPECT_LT(
      (before.R[0].transpose() * state.R[0] - exp_map(Vector3d(dt * state.qd.head<3>())).toRotationMatrix())
          .norm(),
      1e-14);
}

// A force on the foot, given as an external one, is that of its Jacobian: τ = −Jᵀ f holds the body.
TEST(Trees, ExternalForceOnTheFootAcceleratesLikeItsGeneralisedForce) {
  const Tree tree = hopper();
  TreeState state = rest_state(tree);
  set_position(tree, 3, 0.4, state);
  const Vector3d force(5.0, 0.0, 90.0), foot_B(0, 0, -0.4);
  const TreeKinematics now = kinematics(tree, state);
  TreeForces external(5, Vector6d::Zero());
  external[4].head<3>() = (now.R_WB[4] * foot_B).cross(force);
  external[4].tail<3>() = force;
  VectorXd generalised(5);
  for (int dof = 0; dof < 5; ++dof) {
    const double h = 1e-6;
    const auto foot = [&](double step) {
      TreeState moved = state;
      moved.qd = VectorXd::Unit(5, dof);
      integrate(tree, VectorXd::Zero(5), step, moved);
      const TreeKinematics k = kinematics(tree, moved);
      return Vector3d(k.p_WB[4] + k.R_WB[4] * foot_B);
    };
    generalised(dof) = (foot(h) - foot(-h)).dot(force) / (2.0 * h);
  }
  const VectorXd zero = VectorXd::Zero(5);
  EXPECT_LT(
      (forward_dynamics(tree, state, zero, external) - forward_dynamics(tree, state, generalised)).norm(),
      1e-5);
}

/// Ten bodies on random joints of every kind, and a random state.
Tree random_tree(Random& random, TreeState& state) {
  const auto vector = [&] { return Vector3d(random.normal(), random.normal(), random.normal()); };
  Tree tree;
  for (int i = 0; i < 10; ++i) {
    const MatrixXd kinds[] = {hinge(vector()), slider(vector()), ball(), free_joint()};
    const int parent = i == 0 ? -1 : static_cast<int>(random.below(static_cast<std::uint32_t>(i)));
    const Vector3d d = vector();
    tree.add(parent, vector(), kinds[random.below(4)],
             {1.0 + random.uniform(), 0.3 * d,
              (0.1 + d.squaredNorm()) * Matrix3d::Identity() - d * d.transpose()});
    tree.body[i].armature = random.uniform();
  }
  state = rest_state(tree);
  for (Matrix3d& R : state.R) R = exp_map(vector()).toRotationMatrix();
  for (Vector3d& p : state.p) p = vector();
  for (double& speed : state.qd) speed = random.normal();
  return tree;
}

TEST(Trees, ForwardDynamicsInvertsNewtonAndEulerOnRandomTrees) {
  for (std::uint64_t n = 0; n < 30; ++n) {
    Random random(1, {n});
    TreeState state;
    const Tree tree = random_tree(random, state);
    VectorXd tau(tree.dofs());
    for (double& t : tau) t = 10.0 * random.normal();
    TreeForces external(10, Vector6d::Zero());
    for (Vector6d& f : external)
      for (double& x : f) x = 10.0 * random.normal();
    const VectorXd qdd = forward_dynamics(tree, state, tau, external);
    EXPECT_LT((inverse_dynamics(tree, state, qdd, external) - tau).norm(), 1e-9 * tau.norm()) << n;
    const VectorXd dense = dense_forward_dynamics(tree, state, tau, external);
    EXPECT_LT((qdd - dense).norm(), 1e-9 * dense.norm()) << n;
  }
}

TEST(Trees, MassMatrixGivesTheKineticEnergyOfTheBodies) {
  Random random(2);
  TreeState state;
  Tree tree = random_tree(random, state);
  for (TreeBody& body : tree.body) body.armature = 0.0;
  const MatrixXd H = mass_matrix(tree, state);
  EXPECT_NEAR(0.5 * state.qd.dot(H * state.qd), kinetic_energy(tree, state), 1e-9);
  EXPECT_GT(symmetric_eigen(H).values[0], 0.0);
}

// X of two frames in a row is the product of both; the velocity of a point does not depend on the frame.
TEST(Trees, MotionTransformsCompose) {
  Random random(3);
  const auto vector = [&] { return Vector3d(random.normal(), random.normal(), random.normal()); };
  const Matrix3d R1 = exp_map(vector()).toRotationMatrix(), R2 = exp_map(vector()).toRotationMatrix();
  const Vector3d r1 = vector(), r2 = vector();
  const Matrix6d both = motion_transform(R1 * R2, r1 + R1 * r2);
  EXPECT_LT((motion_transform(R2, r2) * motion_transform(R1, r1) - both).norm(), 1e-13);
  Vector6d v;
  v << vector(), vector();
  const Vector3d point = vector();  // in the old frame
  const Vector6d moved = motion_transform(R1, r1) * v;
  const Vector3d in_new = R1.transpose() * (point - r1);
  EXPECT_LT(
      (R1 * (moved.tail<3>() + moved.head<3>().cross(in_new)) - (v.tail<3>() + v.head<3>().cross(point)))
          .norm(),
      1e-13);
}

// d/dt of X v at constant v is −(v_J ×) X v, and power v·f is the same in every frame.
TEST(Trees, CrossProductIsTheDerivativeOfTheTransform) {
  Random random(4);
  Vector6d v, m, f;
  for (double& x : v) x = random.normal();
  for (double& x : m) x = random.normal();
  for (double& x : f) x = random.normal();
  const auto transform = [&](double t) {
    return motion_transform(exp_map(Vector3d(t * v.head<3>())).toRotationMatrix(), t * v.tail<3>());
  };
  const double h = 1e-6;
  EXPECT_LT(((transform(h) - transform(-h)) * m / (2.0 * h) + cross_motion(v) * m).norm(), 1e-8);
  EXPECT_NEAR(f.dot(cross_motion(v) * m), -m.dot(cross_force(v) * f), 1e-12);
}

TEST(Trees, SpatialInertiaIsThatOfPointMasses) {
  // Two points of 1 kg: the kinetic energy of a motion is the sum of theirs.
  const Vector3d a(0.3, -0.2, 0.5), b(-0.1, 0.4, 0.2), c = 0.5 * (a + b), d = a - c;
  const Matrix3d about_com = 2.0 * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
  Vector6d v;
  v << 0.4, -1.0, 0.7, 0.2, 0.5, -0.3;
  const auto speed = [&](const Vector3d& p) { return (v.tail<3>() + v.head<3>().cross(p)).squaredNorm(); };
  EXPECT_NEAR(v.dot(spatial_inertia({2.0, c, about_com}) * v), speed(a) + speed(b), 1e-13);
}

TEST(Trees, RejectAMissingParent) {
  Tree tree;
  EXPECT_THROW(tree.add(0, Vector3d::Zero(), ball(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::trees
