// Depth of the legs in the sides of boxes, its derivatives, and plans that keep out of them.
#include "control/cost/legs_in_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "control/cost/cost.h"
#include "control/fixtures.h"
#include "control/plan.h"

namespace mimicx::control {
namespace {

/// A walk among two boxes that its legs pass through, one of them turned.
struct WalkThroughBoxes {
  motion::Reference reference = synthetic_reference("walk", 501, 30);
  System system;
  State<double> x;

  explicit WalkThroughBoxes(double stiffness = 4e5) {
    const Eigen::Vector2d middle = reference.poses[15].p_WB[kLeftKnee].head<2>();
    const Scene scene{{{middle + Eigen::Vector2d(0.05, 0.1), 0.3, {0.2, 0.3}, 0.5, stiffness},
                       {middle - Eigen::Vector2d(0.3, 0.2), -1.0, {0.2, 0.3}, 0.4, stiffness}}};
    const System flat = system_of(reference);
    system = make_system(reference.character, {}, flat.reference, reference.fps, scene);
    x = moved_at_random(system.at(15), 46, 0.2);
  }
};

SideDepths depths_of(const System& system, const State<double>& x) {
  return side_depths(system, *exact_kinematics(system, x));
}
double deepest(const System& system, const State<double>& x) { return depths_of(system, x).depth.maxCoeff(); }

TEST(LegsInBoxes, JacobianMatchesDifferences) {
  const WalkThroughBoxes s;
  const auto J = depths_of(s.system, s.x).by_tangent;
  constexpr double kStep = 1e-6;
  for (int k = 0; k < kTangent; ++k) {
    const auto a = depths_of(s.system, moved(s.x, k, kStep)).depth,
               b = depths_of(s.system, moved(s.x, k, -kStep)).depth;
    for (int i = 0; i < kLegSpheres; ++i)
      EXPECT_NEAR(J(i, k), (a[i] - b[i]) / (2.0 * kStep), 1e-6) << i << ", " << k;
  }
}

TEST(LegsInBoxes, CostMatchesItsDerivativesAndLanes) {
  const WalkThroughBoxes s;
  CostWeights weights;
  weights.slip = weights.com_velocity = weights.angular_momentum = 0.0;
  const Cost cost = make_cost(s.system, weights);
  const StateQuadratic exact = state_quadratic(s.system, cost, 15, s.x);
  for (int k = 0; k < kTangent; ++k) {
    const double h = 1e-6, plus = state_quadratic(s.system, cost, 15, moved(s.x, k, h)).value,
                 minus = state_quadratic(s.system, cost, 15, moved(s.x, k, -h)).value;
    EXPECT_NEAR(exact.gradient[k], (plus - minus) / (2 * h), 1e-5 * (1.0 + std::abs(exact.gradient[k]))) << k;
  }
  const auto scratch = std::make_unique<Data<P>>();
  const LaneCost lanes = state_cost(s.system, cost, 15, in_all_lanes<P>(s.x), *scratch);
  EXPECT_NEAR(static_cast<double>(lanes.cost[0]), exact.value, 1e-4 * exact.value);
}

TEST(LegsInBoxes, SoftPlatesHaveNone) {
  EXPECT_GT(deepest(WalkThroughBoxes().system, WalkThroughBoxes().x), 0.05);
  const WalkThroughBoxes soft(2e4);
  EXPECT_EQ(deepest(soft.system, soft.x), 0.0);
}

// Somebody who marches in place lifts the feet in front of a box, and gets 5 cm into it.
TEST(LegsInBoxes, PlanKeepsTheLegsOutOfARiser) {
  const motion::Reference reference = synthetic_reference("march", 501, 60);
  const System flat = system_of(reference);
  const Eigen::Vector2d middle = reference.poses[0].p_WB[kPelvis].head<2>(),
                        ahead = (reference.poses[0].q_WB[kPelvis] * Vector3d::UnitZ()).head<2>().normalized();
  const auto with_box = [&](double distance) {
    const Plate box{middle + ahead * (0.4 + distance), std::atan2(ahead.y(), ahead.x()), {0.4, 0.6}, 0.35};
    return make_system(reference.character, {}, flat.reference, reference.fps, {{box}});
  };
  const auto deepest_of = [](const System& system, const List<State<double>>& states) {
    double most = 0.0;
    for (const State<double>& x : states) most = std::max(most, deepest(system, x));
    return most;
  };
  double distance = 0.6;
  while (deepest_of(with_box(distance), flat.reference) < 0.05) distance -= 0.005;
  const System system = with_box(distance);
  const auto planned = [&](double weight) {
    PlanConfig config;
    config.weights.box_sides = weight;
    const Plan plan = make_plan(system, config);
    EXPECT_EQ(plan.ending, Ending::kFollowed);
    return deepest_of(system, plan.states);
  };
  EXPECT_LT(planned(CostWeights().box_sides), 0.015);
  EXPECT_GT(planned(0.0), 0.04);
}

}  // namespace
}  // namespace mimicx::control
