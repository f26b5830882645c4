// The dynamics against an established simulator on random states.
#include <gtest/gtest.h>

#include "oracles/mujoco_character.h"
#include "physics/test_states.h"

namespace mimicx {
namespace {

/// The oracle's velocity coordinates as a linear function of MuJoCo's: qd_book = P qd_mujoco.
Eigen::MatrixXd coordinates(const MujocoCharacter& mujoco, const Snapshot& s) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(kBookDofs, kBookDofs);
  P.block<3, 3>(0, 3).setIdentity();
  P.block<3, 3>(3, 0) = s.q[0].toRotationMatrix().transpose();
  int dof = 6;
  for (int i = 1; i < kBodies; ++i)
    for (int k = 0; k < (is_hinge(i) ? 1 : 3); ++k) P(dof++, mujoco.dof(i) + k) = 1.0;
  return P;
}

struct MujocoTrial {
  Character character;
  SimulationOptions options;
  Snapshot snapshot;
  std::unique_ptr<MujocoCharacter> mujoco;

  explicit MujocoTrial(std::uint64_t number) {
    Random random(51, {number});
    character = make_character(random_betas(random));
    for (JointParameters& j : character.joint) j.kp = j.kd = 0;
    snapshot = random_snapshot(random, 2.5, 5.0, 50.0);
    mujoco = std::make_unique<MujocoCharacter>(character, options);
    mujoco->set_root(snapshot.p_root, snapshot.q[0], snapshot.v_root, snapshot.omega[0]);
    for (int i = 1; i < kBodies; ++i)
      mujoco->set_joint(i, snapshot.q[static_cast<std::size_t>(i)],
                        snapshot.omega[static_cast<std::size_t>(i)]);
  }
};

double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST(Mujoco, MassMatrixAndBiasForcesAgreeWithTheOracle) {
  for (std::uint64_t n = 0; n < 20; ++n) {
    MujocoTrial t(n);
    mjModel& m = t.mujoco->model();
    mjData& d = t.mujoco->data();
    mj_forward(&m, &d);
    Eigen::Matrix<double, -1, -1, Eigen::RowMajor> M(kBookDofs, kBookDofs);
    mj_fullM(&m, M.data(), d.qM);
    const Eigen::MatrixXd P = coordinates(*t.mujoco, t.snapshot);
    const BookModel book = make_book_model(t.character, t.options.gravity);
    const BookPosition q = book_position(t.snapshot);
    EXPECT_LT(relative_difference(P.transpose() * book_mass_matrix(book, q) * P, M), 1e-8);

    // At zero acceleration in MuJoCo's coordinates the pelvis' spatial acceleration is −ω × v.
    const Eigen::VectorXd qd = book_velocity(t.snapshot);
    Eigen::VectorXd qdd = Eigen::VectorXd::Zero(kBookDofs);
    qdd.segment<3>(3) = -qd.segment<3>(0).eval().head<3>().cross(qd.segment<3>(3).head<3>());
    const Eigen::VectorXd bias = P.transpose() * book_inverse_dynamics(book, q, qd, qdd, no_forces());
    EXPECT_LT(relative_difference(bias, Eigen::Map<Eigen::VectorXd>(d.qfrc_bias, kBookDofs)), 1e-8);
  }
}

TEST(Mujoco, ForwardDynamicsAgreesWithTheSimulator) {
  for (std::uint64_t n = 0; n < 20; ++n) {
    MujocoTrial t(n);
    Random random(52, {n});
    std::array<Vec3<double>, kBodies> tau;
    tau.fill(zero3<double>());
    for (std::size_t i = 1; i < kBodies; ++i) {
      const Vector3d torque = 40.0 * random_vector(random);
      tau[i] = {torque.x(), torque.y(), torque.z()};
    }
    const Eigen::MatrixXd P = coordinates(*t.mujoco, t.snapshot);
    mjData& d = t.mujoco->data();
    Eigen::Map<Eigen::VectorXd>(d.qfrc_applied, kBookDofs) = P.transpose() * book_torque(tau);
    mj_forward(&t.mujoco->model(), &d);

    Simulation<double> s(t.character, t.options, t.snapshot);
    forward_dynamics(s.model, s.state, tau, s.data);
    Eigen::VectorXd ours = book_acceleration(t.snapshot, s.data);
    const Eigen::VectorXd qd = book_velocity(t.snapshot);
    ours.segment<3>(3) += qd.segment<3>(0).eval().head<3>().cross(qd.segment<3>(3).head<3>());
    const Eigen::VectorXd theirs = P * Eigen::Map<Eigen::VectorXd>(d.qacc, kBookDofs);
    EXPECT_LT(relative_difference(ours, theirs), 1e-8) << "trial " << n;
  }
}

}  // namespace
}  // namespace mimicx
