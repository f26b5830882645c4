// Slip of the soles' points and its derivatives.
#include "control/sole_slip.h"

#include <gtest/gtest.h>

#include <memory>

#include "control/cost.h"
#include "control/fixtures.h"

namespace mimicx::control {
namespace {

Array<Vec3<double>, kFootPoints> slip_of(const System& system, const State<double>& x) {
  const auto d = std::make_unique<Data<double>>();
  update_kinematics(system.exact_model, x, *d);
  return sole_slip(system, *d);
}

struct TurningWalk {
  System system = system_of(synthetic_reference("walk_turn", 501, 12));
  State<double> x = system.at(5);
  TurningWalk() {
    Random random(45);
    retract(x, random_tangent<double>(random, 0.3));
  }
};

TEST(SoleSlip, JacobianMatchesDifferences) {
  const TurningWalk s;
  const auto d = std::make_unique<Data<double>>();
  update_kinematics(s.system.exact_model, s.x, *d);
  const SoleSlipJacobian J = sole_slip_jacobian(s.system, *d);
  constexpr double kStep = 1e-5;
  for (int k = 0; k < kTangent; ++k) {
    State<double> plus = s.x, minus = s.x;
    Tangent<double> delta{};
    delta[k] = kStep;
    retract(plus, delta);
    delta[k] = -kStep;
    retract(minus, delta);
    const auto a = slip_of(s.system, plus), b = slip_of(s.system, minus);
    for (int point = 0; point < kFootPoints; ++point) {
      const Vector3d expected = (to_eigen(a[point]) - to_eigen(b[point])) / (2.0 * kStep);
      EXPECT_LT((J.block<2, 1>(2 * point, k) - expected.head<2>()).norm(), 1e-8) << point << ", " << k;
    }
  }
}

// The rate of change of the points' positions, by a small step of the pose along its velocities.
TEST(SoleSlip, VelocitiesAreRatesOfThePositions) {
  const TurningWalk s;
  constexpr double kStep = 1e-6;
  const auto positions = [&](double time) {
    State<double> x = s.x;
    Tangent<double> delta{};
    for (int k = 0; k < 3; ++k) {
      delta[k] = time * to_eigen(s.x.v_root)[k];
      delta[kRootRotation + k] = time * to_eigen(s.x.omega[0])[k];
    }
    for (int k = 0; k < kDofs; ++k)
      delta[kJointRotation + k] = time * dofs()[k].axis.dot(to_eigen(s.x.omega[dofs()[k].body]));
    retract(x, delta);
    const BodyPoses poses = poses_of(s.system, x);
    Array<Vector3d, kFootPoints> p;
    for (int k = 0; k < kFootPoints; ++k)
      p[k] = poses.p_WB[s.system.sole[k].body] + poses.q_WB[s.system.sole[k].body] * s.system.sole[k].p_B;
    return p;
  };
  const auto ahead = positions(kStep), behind = positions(-kStep);
  const auto v = slip_of(s.system, s.x);
  for (int k = 0; k < kFootPoints; ++k)
    EXPECT_LT((to_eigen(v[k]) - (ahead[k] - behind[k]) / (2.0 * kStep)).norm(), 1e-5) << k;
}

}  // namespace
}  // namespace mimicx::control
