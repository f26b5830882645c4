// The dynamics against an established simulator on random states.
#include <gtest/gtest.h>

#include "oracles/mujoco_inverse.h"
#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

/// The oracle's velocity coordinates as a linear function of MuJoCo's: qd_tree = P qd_mujoco.
Eigen::MatrixXd coordinates(const test::MujocoCharacter& mujoco, const Snapshot& s) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(kTreeDofs, kTreeDofs);
  P.block<3, 3>(0, 3).setIdentity();
  P.block<3, 3>(3, 0) = s.q[0].toRotationMatrix().transpose();
  int dof = 6;
  for (int i = 1; i < kBodies; ++i)
    for (int k = 0; k < (is_hinge(i) ? 1 : 3); ++k) P(dof++, mujoco.dof(i) + k) = 1.0;
  return P;
}

struct MujocoTrial {
  Character character;
  SimulationConfig config;
  Snapshot snapshot;
  std::unique_ptr<test::MujocoCharacter> mujoco;

  explicit MujocoTrial(std::uint64_t number) {
    Random random(51, {number});
    character = make_character(random_betas(random));
    snapshot = random_snapshot(random, 2.5, 5.0, 50.0);
    mujoco = std::make_unique<test::MujocoCharacter>(character, config);
    mujoco->set_root(snapshot.p_root, snapshot.q[0], snapshot.v_root, snapshot.omega[0]);
    for (int i = 1; i < kBodies; ++i) mujoco->set_joint(i, snapshot.q[i], snapshot.omega[i]);
  }
};

double matrix_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST(Mujoco, MassMatrixAndBiasForcesAgreeWithTheOracle) {
  for (std::uint64_t n = 0; n < 20; ++n) {
    MujocoTrial t(n);
    mjModel& m = t.mujoco->model();
    mjData& d = t.mujoco->data();
    mj_forward(&m, &d);
    Eigen::Matrix<double, -1, -1, Eigen::RowMajor> M(kTreeDofs, kTreeDofs);
    mj_fullM(&m, M.data(), d.qM);
    const Eigen::MatrixXd P = coordinates(*t.mujoco, t.snapshot);
    const trees::Tree tree = trees::humanoid(t.character, t.config.gravity);
    const trees::TreeState state = tree_state(t.snapshot);
    EXPECT_LT(matrix_difference(P.transpose() * trees::mass_matrix(tree, state) * P, M), 1e-8);

    // At zero acceleration in MuJoCo's coordinates the pelvis' spatial acceleration is −ω × v.
    const Eigen::VectorXd qd = tree_velocity(t.snapshot);
    Eigen::VectorXd qdd = Eigen::VectorXd::Zero(kTreeDofs);
    qdd.segment<3>(3) = -qd.segment<3>(0).eval().head<3>().cross(qd.segment<3>(3).head<3>());
    const Eigen::VectorXd bias = P.transpose() * trees::inverse_dynamics(tree, state, qdd);
    EXPECT_LT(matrix_difference(bias, Eigen::Map<Eigen::VectorXd>(d.qfrc_bias, kTreeDofs)), 1e-8);
  }
}

TEST(Mujoco, ForwardDynamicsAgreesWithTheSimulator) {
  for (std::uint64_t n = 0; n < 20; ++n) {
    MujocoTrial t(n);
    Random random(52, {n});
    PerBody<Vec3<double>> tau;
    tau.fill(zero3<double>());
    for (int i = 1; i < kBodies; ++i) {
      const Vector3d torque = 40.0 * random_vector(random);
      tau[i] = {torque.x(), torque.y(), torque.z()};
    }
    const Eigen::MatrixXd P = coordinates(*t.mujoco, t.snapshot);
    mjData& d = t.mujoco->data();
    Eigen::Map<Eigen::VectorXd>(d.qfrc_applied, kTreeDofs) = P.transpose() * tree_torque(tau);
    mj_forward(&t.mujoco->model(), &d);

    Simulation<double> s(t.character, t.config, t.snapshot);
    forward_dynamics(s.model, s.state, tau, s.data);
    Eigen::VectorXd ours = tree_acceleration(t.snapshot, s.data);
    const Eigen::VectorXd qd = tree_velocity(t.snapshot);
    ours.segment<3>(3) += qd.segment<3>(0).eval().head<3>().cross(qd.segment<3>(3).head<3>());
    const Eigen::VectorXd theirs = P * Eigen::Map<Eigen::VectorXd>(d.qacc, kTreeDofs);
    EXPECT_LT(matrix_difference(ours, theirs), 1e-8) << "trial " << n;
  }
}

TEST(Mjcf, OpensWithoutWarningsForEveryShape) {
  static int warnings;
  warnings = 0;
  mju_user_warning = [](const char*) { ++warnings; };
  Random random(53);
  for (int n = 0; n < 40; ++n) {
    std::array<double, kBetas> betas = random_betas(random);
    if (n < 20)
      for (double& b : betas) b = b < 0.0 ? -3.0 : 3.0;
    test::MujocoCharacter mujoco(make_character(betas), {});  // throws on any message of MuJoCo
    mj_forward(&mujoco.model(), &mujoco.data());
    EXPECT_EQ(mujoco.model().nq, 7 + 17 * 4 + 4);
    EXPECT_EQ(mujoco.model().nv, kTreeDofs);
    for (int k = 0; k < 20; ++k) mj_step(&mujoco.model(), &mujoco.data());
    for (int kind = 0; kind < mjNWARNING; ++kind) EXPECT_EQ(mujoco.data().warning[kind].number, 0);
  }
  EXPECT_EQ(warnings, 0);
  mju_user_warning = nullptr;
}

TEST(Mjcf, CommentListsEveryJointsPlaceInMujocosCoordinates) {
  const Character character = make_character();
  const std::string text = to_mjcf(character, {});
  test::MujocoCharacter mujoco(character, {});
  for (int body = 0; body < kBodies; ++body) {
    const std::string line = std::string(kBodyNames[body]) + ": " + std::to_string(mujoco.qpos(body)) +
                             (body == 0        ? " (7), "
                              : is_hinge(body) ? " (1), "
                                               : " (4), ") +
                             std::to_string(mujoco.dof(body)) + " (";
    EXPECT_NE(text.find("\n" + line), std::string::npos) << line;
  }
}

TEST(Mjcf, JointCentresMatchForwardKinematics) {
  for (std::uint64_t n = 0; n < 20; ++n) {
    MujocoTrial t(n);
    mj_kinematics(&t.mujoco->model(), &t.mujoco->data());
    const BodyPoses poses = forward_kinematics(t.character, t.snapshot.p_root, t.snapshot.q);
    for (int i = 0; i < kBodies; ++i) {
      const int id = mj_name2id(&t.mujoco->model(), mjOBJ_BODY, std::string(kBodyNames[i]).c_str());
      const Vector3d p = Eigen::Map<Vector3d>(t.mujoco->data().xpos + 3 * id);
      EXPECT_LT((p - poses.p_WB[i]).norm(), 1e-12);
    }
  }
}

/// Root and joints in one vector, N and N·m.
Eigen::VectorXd all_of(const RequiredForces& forces) {
  Eigen::VectorXd all(6 + 3 * kJoints);
  all.head<6>() = forces.root;
  for (int i = 1; i < kBodies; ++i) {
    const Vector3d& torque = forces.joint[i];
    all.segment<3>(3 + 3 * i) = is_hinge(i) ? Vector3d(torque.dot(hinge_axis(i)) * hinge_axis(i)) : torque;
  }
  return all;
}

TEST(Mujoco, InverseDynamicsAgreesWithTheAudits) {
  for (std::uint64_t n = 0; n < 20; ++n) {
    MujocoTrial t(n);
    Random random(54, {n});
    const MotionState state = random_motion(t.snapshot, random);
    const BodyWrenches wrenches = random_wrenches(random);
    const RequiredForces required = inverse_dynamics(t.character, t.config.gravity, state, wrenches);
    const RequiredForces theirs = test::mujoco_inverse_dynamics(*t.mujoco, state, wrenches);
    EXPECT_LT(matrix_difference(all_of(required), all_of(theirs)), 1e-8) << "trial " << n;
  }
}

TEST(Mujoco, MomentumAgreesWithTheSumOverTheBodies) {
  for (std::uint64_t n = 0; n < 20; ++n) {
    MujocoTrial t(n);
    Random random(56, {n});
    const MotionState state = random_motion(t.snapshot, random);
    // The first six rows of H q̇ are the momentum of the whole about the pelvis, in its axes.
    const trees::Tree tree = trees::humanoid(t.character, t.config.gravity);
    const Eigen::MatrixXd H = trees::mass_matrix(tree, tree_state(t.snapshot));
    const Eigen::VectorXd h = H * tree_velocity(t.snapshot);
    const test::MujocoMomentum theirs = test::mujoco_momentum(*t.mujoco, state);
    const Vector3d linear_B = h.segment<3>(3), angular_B = h.segment<3>(0);
    const Vector3d linear = t.snapshot.q[0] * linear_B;
    const Vector3d angular = t.snapshot.q[0] * angular_B + (t.snapshot.p_root - theirs.center).cross(linear);
    EXPECT_LT((linear - theirs.about_center.tail<3>()).norm(), 1e-8 * linear.norm()) << "trial " << n;
    EXPECT_LT((angular - theirs.about_center.head<3>()).norm(), 1e-8 * angular.norm()) << "trial " << n;
  }
}

// Verification by a second engine: at every step of a violent second MuJoCo's inverse dynamics gives zero at
// the root and the recorded torques in the joints.
TEST(Mujoco, ExplainsEveryStepOfAViolentRollOut) {
  for (std::uint64_t n = 0; n < 3; ++n) {
    Random random(55, {n});
    const Character character = make_character(random_betas(random));
    Simulation<double> s(character, {}, random_snapshot(random, 1.2, 3.0, 0.9));
    test::MujocoCharacter mujoco(character, {});
    double hardest = 0.0;
    for (int k = 0; k < 240; ++k) {
      Snapshot before, after;
      read_lane(s.state, 0, before);
      s.advance();
      read_lane(s.state, 0, after);
      MotionState state{before.p_root, before.v_root, s.model.config.rate * (after.v_root - before.v_root),
                        before.q,      before.omega,  {}};
      BodyWrenches wrenches;
      RequiredForces acted;
      acted.root.setZero();
      double scale = 100.0;
      for (int i = 0; i < kBodies; ++i) {
        state.omega_d[i] = s.model.config.rate * (after.omega[i] - before.omega[i]);
        wrenches[i].head<3>() = lane_of(s.applied.ground[i].n, 0) + lane_of(s.applied.self[i].n, 0);
        wrenches[i].tail<3>() = lane_of(s.applied.ground[i].f, 0) + lane_of(s.applied.self[i].f, 0);
        acted.joint[i] = lane_of(s.applied.joint_torque[i], 0);
        scale = std::max(scale, wrenches[i].norm());
      }
      hardest = std::max(hardest, scale);
      const Eigen::VectorXd unexplained =
          all_of(test::mujoco_inverse_dynamics(mujoco, state, wrenches)) - all_of(acted);
      ASSERT_LT(unexplained.cwiseAbs().maxCoeff(), 1e-8 * scale) << "trial " << n << " step " << k;
    }
    EXPECT_GT(hardest, 1000.0) << "no impact";
  }
}

}  // namespace
}  // namespace mimicx::physics
