// The state manifold: properties of ⊖ and ⊕.
#include "control/tangent.h"

#include <gtest/gtest.h>

#include "control/fixtures.h"

namespace mimicx::control {
namespace {

TEST(Tangent, AddingAndTakingAwayAreInverse) {
  const motion::Reference walk = synthetic_reference("walk", 501, 30);
  Random random(41);
  for (int trial = 0; trial < 20; ++trial) {
    const State<double> y = simulator_state(walk.frames[static_cast<std::size_t>(trial)]);
    const Tangent<double> delta = random_tangent<double>(random, 0.5);
    State<double> x = y;
    retract(x, delta);
    const Tangent<double> back = difference(x, y);
    for (std::size_t k = 0; k < kTangent; ++k) EXPECT_NEAR(back[k], delta[k], 1e-12) << k;
    State<double> again = y;
    retract(again, difference(simulator_state(walk.frames[29]), y));
    const Tangent<double> left = difference(again, simulator_state(walk.frames[29]));
    for (std::size_t k = 0; k < kTangent; ++k) EXPECT_NEAR(left[k], 0.0, 1e-12) << k;
  }
}

TEST(Tangent, CoordinatesAreWhatTheHeaderSays) {
  const State<double> y = simulator_state(synthetic_reference("walk", 501, 30).frames[12]);
  const auto moved = [&](int k) {
    Tangent<double> delta{};
    delta[static_cast<std::size_t>(k)] = 0.1;
    State<double> x = y;
    retract(x, delta);
    return x;
  };
  EXPECT_NEAR(moved(1).p_root.y - y.p_root.y, 0.1, 1e-12);
  EXPECT_NEAR(moved(kRootVelocity + 2).v_root.z - y.v_root.z, 0.1, 1e-12);
  EXPECT_NEAR(moved(kRootSpin).omega[0].x - y.omega[0].x, 0.1, 1e-12);
  const Quaterniond turned = to_eigen(y.q[0]) * exp_map(Vector3d(0.0, 0.1, 0.0));
  EXPECT_LT(turned.angularDistance(to_eigen(moved(kRootRotation + 1).q[0])), 1e-12);
  for (int body = 1; body < kBodies; ++body) {
    const auto i = static_cast<std::size_t>(body);
    for (int axis = 0; axis < (is_hinge(body) ? 1 : 3); ++axis) {
      const Vector3d about = is_hinge(body) ? hinge_axis(body) : Vector3d(Vector3d::Unit(axis));
      const int dof = first_dof(body) + axis;
      EXPECT_EQ(dofs()[static_cast<std::size_t>(dof)].body, body);
      EXPECT_EQ(dofs()[static_cast<std::size_t>(dof)].axis, about);
      const Quaterniond q = to_eigen(y.q[i]) * exp_map(0.1 * about);
      EXPECT_LT(q.angularDistance(to_eigen(moved(kJointRotation + dof).q[i])), 1e-12) << kBodyNames[i];
      const Vector3d spin = to_eigen(moved(kJointVelocity + dof).omega[i]) - to_eigen(y.omega[i]);
      EXPECT_LT((spin - 0.1 * about).norm(), 1e-12) << kBodyNames[i];
    }
  }
}

TEST(Tangent, PacksAgreeWithDouble) {
  const motion::Reference walk = synthetic_reference("walk", 501, 30);
  Random random(42);
  State<P> a = in_all_lanes<P>(simulator_state(walk.frames[3]));
  const State<P> b = in_all_lanes<P>(simulator_state(walk.frames[7]));
  const Tangent<double> delta = random_tangent<double>(random, 0.2);
  Tangent<P> in_lanes;
  for (std::size_t k = 0; k < kTangent; ++k) in_lanes[k] = P(delta[k]);
  State<double> exact = lane_of(a, 1);
  retract(a, in_lanes);
  retract(exact, delta);
  const Tangent<P> d = difference(a, b);
  const Tangent<double> expected = difference(exact, lane_of(b, 0));
  for (std::size_t k = 0; k < kTangent; ++k)
    EXPECT_NEAR(static_cast<double>(d[k][kLanes - 1]), expected[k], 2e-6 * (1.0 + std::abs(expected[k])))
        << k;
}

}  // namespace
}  // namespace mimicx::control
