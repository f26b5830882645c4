// The articulated-body algorithm against independent formulations and a case worked by hand.
#include <gtest/gtest.h>

#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

constexpr int kTrials = 60;

double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// A random shape, state and torques, and the simulator's accelerations.
struct Trial {
  Character character;
  SimulationConfig config;
  Snapshot snapshot;
  PerBody<Vec3<double>> tau;
  Data<double> data{};

  explicit Trial(std::uint64_t number) {
    Random random(7, {number});
    character = make_character(random_betas(random));
    snapshot = random_snapshot(random, 2.5, 5.0, 1.0);
    tau.fill(zero3<double>());
    for (int i = 1; i < kBodies; ++i) {
      const Vector3d t = 40.0 * random_vector(random);
      tau[i] = {t.x(), t.y(), t.z()};
    }
    Simulation<double> simulation(character, config, snapshot);
    forward_dynamics(simulation.model, simulation.state, tau, simulation.data);
    data = simulation.data;
  }
};

TEST(Aba, AccelerationsSatisfyRneaOnRandomShapesAndStates) {
  for (std::uint64_t n = 0; n < kTrials; ++n) {
    const Trial t(n);
    const trees::Tree tree = trees::humanoid(t.character, t.config.gravity);
    const Eigen::VectorXd tau =
        trees::inverse_dynamics(tree, tree_state(t.snapshot), tree_acceleration(t.snapshot, t.data));
    EXPECT_LT(relative_difference(tau, tree_torque(t.tau)), 1e-9) << "trial " << n;
  }
}

TEST(Aba, AgreesWithCompositeInertiasAndCholesky) {
  for (std::uint64_t n = 0; n < kTrials; ++n) {
    const Trial t(n);
    const trees::Tree tree = trees::humanoid(t.character, t.config.gravity);
    const Eigen::VectorXd qdd =
        trees::dense_forward_dynamics(tree, tree_state(t.snapshot), tree_torque(t.tau));
    EXPECT_LT(relative_difference(tree_acceleration(t.snapshot, t.data), qdd), 1e-9) << "trial " << n;
  }
}

TEST(Aba, AgreesWithTheLiteralDenseAlgorithm) {
  for (std::uint64_t n = 0; n < kTrials; ++n) {
    const Trial t(n);
    const trees::Tree tree = trees::humanoid(t.character, t.config.gravity);
    const Eigen::VectorXd qdd = trees::forward_dynamics(tree, tree_state(t.snapshot), tree_torque(t.tau));
    EXPECT_LT(relative_difference(tree_acceleration(t.snapshot, t.data), qdd), 1e-9) << "trial " << n;
  }
}

// An independent check of the oracle: its inertia matrix gives the kinetic energy of bodies whose velocities
// are differences of positions.
TEST(TreeDynamics, MassMatrixMatchesKineticEnergyByDifferences) {
  Random random(8);
  const Character character = make_character(random_betas(random));
  const Snapshot s = random_snapshot(random, 2.5, 3.0, 1.0);
  trees::Tree tree = trees::humanoid(character, kGravity);
  for (trees::TreeBody& body : tree.body) body.armature = 0.0;
  const Eigen::VectorXd qd = tree_velocity(s);
  const double energy = 0.5 * qd.dot(trees::mass_matrix(tree, tree_state(s)) * qd);

  const double h = 1e-5;
  const auto moved = [&](double t) {
    Snapshot m = s;
    m.p_root += t * s.v_root;
    for (int i = 0; i < kBodies; ++i) m.q[i] = s.q[i] * exp_map(t * s.omega[i]);
    return forward_kinematics(character, m.p_root, m.q);
  };
  const BodyPoses before = moved(-h), after = moved(h), now = moved(0);
  double expected = 0.0;
  for (int i = 0; i < kBodies; ++i) {
    const auto com = [&](const BodyPoses& p) { return Vector3d(p.p_WB[i] + p.q_WB[i] * character.com_B[i]); };
    const Vector3d v = (com(after) - com(before)) / (2 * h);
    const Vector3d w_W = log_map(after.q_WB[i] * before.q_WB[i].conjugate()) / (2 * h);
    const Vector3d w = now.q_WB[i].conjugate() * w_W;
    expected += 0.5 * character.mass[i] * v.squaredNorm() + 0.5 * w.dot(character.inertia_B[i] * w);
  }
  EXPECT_NEAR(energy, expected, 1e-7 * expected);
}

TEST(Kinematics, VelocitiesAndVelocityProductsMatchDifferences) {
  Random random(9);
  const Character character = make_character(random_betas(random));
  const Snapshot s = random_snapshot(random, 2.5, 3.0, 1.0);
  Simulation<double> simulation(character, {}, s);
  update_kinematics(simulation.model, simulation.state, simulation.data);
  const Data<double> now = simulation.data;
  const double h = 1e-5;
  const auto moved = [&](double t) {  // along the motion with ω and v_root constant: q̈ = 0
    Snapshot m = s;
    m.p_root += t * s.v_root;
    for (int i = 0; i < kBodies; ++i) m.q[i] = s.q[i] * exp_map(t * s.omega[i]);
    Simulation<double> other(character, {}, m);
    update_kinematics(other.model, other.state, other.data);
    return other.data;
  };
  const Data<double> before = moved(-h), after = moved(h);
  PerBody<Vector3d> a_w, a_v;  // accelerations propagated with the c terms
  a_w[0] = a_v[0] = Vector3d::Zero();
  for (int i = 0; i < kBodies; ++i) {
    const auto at = [&](const PerBody<Vec3<double>>& x) { return lane_of(x[i], 0); };
    EXPECT_LT((at(now.v) - (at(after.p_WB) - at(before.p_WB)) / (2 * h)).norm(), 1e-7);
    const Vector3d w = log_map(lane_of(after.q_WB[i], 0) * lane_of(before.q_WB[i], 0).conjugate()) / (2 * h);
    EXPECT_LT((at(now.w) - w).norm(), 1e-7);
    if (i > 0) {
      const int lambda = kParents[i];
      a_w[i] = a_w[lambda] + at(now.c_w);
      a_v[i] = a_v[lambda] + a_w[lambda].cross(at(now.r)) + at(now.c_v);
    }
    EXPECT_LT((a_w[i] - (at(after.w) - at(before.w)) / (2 * h)).norm(), 1e-5);
    EXPECT_LT((a_v[i] - (at(after.v) - at(before.v)) / (2 * h)).norm(), 1e-5);
  }
}

// Worked by hand. Two bodies have mass: the pelvis (1 kg, inertia 1 about its centre, which is the origin)
// and the left thigh (1 kg, inertia 1 about its centre, which is 1 m along x from the hip; hip at the
// origin). No gravity; the thigh spins about z with ω = 2 relative to the resting pelvis, and the hip
// applies τ = 1 about z.
//   Sideways (y):  m a₀ + m (a₀ + α₁·1) = 0           → a₀ = −α₁/2,  force on the thigh F = a₀ + α₁ = α₁/2
//   Pelvis:        1·α₀ = −τ                           → α₀ = −1
//   Thigh:         1·α₁ = τ − 1·F = 1 − α₁/2           → α₁ = 2/3,  a₀y = −1/3,  q̈ = α₁ − α₀ = 5/3
//   Along (x):     m a₀ + m (a₀ − ω²·1) = 0            → a₀x = ω²/2 = 2
TEST(Aba, ReproducesTheTwoBodyExampleWorkedByHand) {
  Character c = make_character();
  c.mass.fill(0.0);
  c.com_B.fill(Vector3d::Zero());
  c.inertia_B.fill(Matrix3d::Zero());
  for (const int i : {kPelvis, kLeftHip}) {
    c.mass[i] = 1.0;
    c.inertia_B[i] = Matrix3d::Identity();
  }
  c.com_B[kLeftHip] = {1, 0, 0};
  c.joint_offset[kLeftHip] = Vector3d::Zero();
  c.joint[kLeftHip].armature = 0.0;
  SimulationConfig config;
  config.gravity = 0.0;
  Snapshot s;
  s.q.fill(Quaterniond::Identity());
  s.target_q = s.q;
  s.omega.fill(Vector3d::Zero());
  s.target_omega = s.omega;
  s.omega[kLeftHip] = {0, 0, 2};
  Simulation<double> simulation(c, config, s);
  PerBody<Vec3<double>> tau;
  tau.fill(zero3<double>());
  tau[kLeftHip] = {0, 0, 1};
  forward_dynamics(simulation.model, simulation.state, tau, simulation.data);
  const auto near = [](const Vec3<double>& x, const Vector3d& expected) {
    return (lane_of(x, 0) - expected).norm() < 1e-14;
  };
  EXPECT_TRUE(near(simulation.data.a_v[kPelvis], {2, -1.0 / 3, 0}));
  EXPECT_TRUE(near(simulation.data.a_w[kPelvis], {0, 0, -1}));
  EXPECT_TRUE(near(simulation.data.a_w[kLeftHip], {0, 0, 2.0 / 3}));
  EXPECT_TRUE(near(simulation.data.qdd[kLeftHip], {0, 0, 5.0 / 3}));
}

}  // namespace
}  // namespace mimicx::physics
