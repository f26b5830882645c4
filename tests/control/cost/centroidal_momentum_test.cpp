// Centroidal momentum: derivatives, and what conserves it.
#include "control/cost/centroidal_momentum.h"

#include <gtest/gtest.h>

#include <memory>

#include "control/fixtures.h"

namespace mimicx::control {
namespace {

struct MovingBody {
  System system = system_of(synthetic_reference("jump", 501, 12));
  State<double> x = moved_at_random(system.at(5), 44, 0.3);

  CentroidalMomentum<double> momentum(const State<double>& state) const {
    return centroidal_momentum(system.exact_model, *exact_kinematics(system, state));
  }
  CentroidalJacobian jacobian() const {
    return centroidal_jacobian(system.exact_model, *exact_kinematics(system, x));
  }
};

Vector6d vector_of(const CentroidalMomentum<double>& h) {
  Vector6d out;
  out << to_eigen(h.linear), to_eigen(h.angular);
  return out;
}

TEST(CentroidalMomentum, JacobianMatchesDifferences) {
  const MovingBody body;
  const CentroidalJacobian J = body.jacobian();
  constexpr double kStep = 1e-5;
  for (int k = 0; k < kTangent; ++k) {
    const Vector6d expected = (vector_of(body.momentum(moved(body.x, k, kStep))) -
                               vector_of(body.momentum(moved(body.x, k, -kStep)))) /
                              (2.0 * kStep);
    EXPECT_LT((J.col(k) - expected).cwiseAbs().maxCoeff(), 1e-8) << k;
  }
}

// h = A(q) q̇: Orin, Goswami and Lee, eq. (1).
TEST(CentroidalMomentum, IsLinearInTheVelocities) {
  const MovingBody body;
  Eigen::Matrix<double, kPositions, 1> velocity;
  velocity << to_eigen(body.x.v_root), to_eigen(body.x.omega[0]), Eigen::VectorXd::Zero(kDofs);
  for (int k = 0; k < kDofs; ++k)
    velocity[6 + k] = dofs()[k].axis.dot(to_eigen(body.x.omega[dofs()[k].body]));
  const Vector6d product = body.jacobian().rightCols<kPositions>() * velocity;
  EXPECT_LT((product - vector_of(body.momentum(body.x))).cwiseAbs().maxCoeff(), 1e-12);
}

// In flight gravity alone acts: joint torques change neither the angular momentum nor the fall.
TEST(CentroidalMomentum, InFlightIsThatOfAFallingBody) {
  MovingBody body;
  SimulationConfig config;
  config.rate = 9600.0;
  config.self_contact = false;
  body.system =
      make_system(synthetic_reference("jump", 501, 12).character, config, body.system.reference, 30.0);
  body.x.p_root.z += 5.0;
  const auto d = std::make_unique<Data<P>>();
  State<P> x = in_all_lanes<P>(body.x);
  const Target<P> target = target_of(body.system, 5, Control{});
  advance(body.system, target, target, assistance_of(body.system, Control{}), x, *d);
  const Vector6d before = vector_of(body.momentum(body.x)), after = vector_of(body.momentum(lane_of(x, 0)));
  EXPECT_GT(before.tail<3>().norm(), 0.05);
  EXPECT_LT((after - before - Vector6d::Unit(2) * (-config.gravity / 30.0)).cwiseAbs().maxCoeff(), 2e-3);
}

TEST(CentroidalMomentum, LanesAgreeWithDouble) {
  const MovingBody body;
  const auto d = std::make_unique<Data<P>>();
  update_kinematics(body.system.model, in_all_lanes<P>(body.x), *d);
  const CentroidalMomentum<P> lanes = centroidal_momentum(body.system.model, *d);
  const CentroidalMomentum<double> exact = body.momentum(body.x);
  EXPECT_LT((lane_of(lanes.linear, 0) - to_eigen(exact.linear)).norm(), 1e-5);
  EXPECT_LT((lane_of(lanes.angular, kLanes - 1) - to_eigen(exact.angular)).norm(), 1e-5);
}

}  // namespace
}  // namespace mimicx::control
