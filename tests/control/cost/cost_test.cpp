// The cost: derivatives, weights, and agreement of lanes with double.
#include "control/cost/cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "control/fixtures.h"

namespace mimicx::control {
namespace {

struct WalkingScene {
  System system = system_of(synthetic_reference("walk", 501, 12));
  Cost cost = make_cost(system, all_terms(), factors());
  State<double> x = moved_at_random(system.at(5), 44, 0.05);

  static CostWeights all_terms() {
    CostWeights weights;
    weights.com_velocity = 30.0;
    weights.angular_momentum = 50.0;
    weights.slip = 20.0;
    return weights;
  }
  static List<FrameFactors> factors() {
    List<FrameFactors> all(12);
    for (int t = 0; t < all.count(); ++t) {
      for (int i = 0; i < kBodies; ++i) all[t].certainty[i] = static_cast<float>((t + i) % 3) * 0.5f;
      all[t].momentum = 0.5f;
    }
    return all;
  }
};

TEST(Cost, GradientMatchesDifferences) {
  const WalkingScene s;
  const StateQuadratic exact = state_quadratic(s.system, s.cost, 5, s.x);
  for (int k = 0; k < kTangent; ++k) {
    const double h = 1e-5, plus = state_quadratic(s.system, s.cost, 5, moved(s.x, k, h)).value,
                 minus = state_quadratic(s.system, s.cost, 5, moved(s.x, k, -h)).value;
    EXPECT_NEAR(exact.gradient[k], (plus - minus) / (2 * h), 1e-6 * (1.0 + std::abs(exact.gradient[k]))) << k;
  }
}

// Where the error is zero, Gauss–Newton's Hessian is the Hessian.
TEST(Cost, HessianAtTheReferenceMatchesDifferences) {
  WalkingScene s;
  s.x = s.system.at(5);
  s.cost.weights.slip = 0.0;  // the reference's feet move
  const StateQuadratic exact = state_quadratic(s.system, s.cost, 5, s.x);
  const double h = 1e-4;
  for (int k = 0; k < kTangent; ++k) {
    const Eigen::VectorXd column = (state_quadratic(s.system, s.cost, 5, moved(s.x, k, h)).gradient -
                                    state_quadratic(s.system, s.cost, 5, moved(s.x, k, -h)).gradient) /
                                   (2 * h);
    for (int i = 0; i < kTangent; ++i) {
      const double expected = exact.hessian(std::max(i, k), std::min(i, k));
      // The gradient at x + h is measured in x + h's own frame: a term of the gradient's size, which is 0.
      EXPECT_NEAR(column[i], expected, 1e-3 * (1.0 + std::abs(expected))) << i << ", " << k;
    }
  }
}

TEST(Cost, LanesAgreeWithDouble) {
  const WalkingScene s;
  const auto scratch = std::make_unique<Data<P>>();
  const LaneCost lanes = state_cost(s.system, s.cost, 5, in_all_lanes<P>(s.x), *scratch);
  const double exact = state_quadratic(s.system, s.cost, 5, s.x).value;
  EXPECT_NEAR(static_cast<double>(lanes.cost[kLanes - 1]), exact, 1e-4 * exact);
  double worst = 0;
  const State<double> reference = s.system.at(5);
  Data<double> a, b;
  const Model<double> model = make_model<double>(synthetic_reference("walk", 501, 2).character);
  update_kinematics(model, s.x, a);
  update_kinematics(model, reference, b);
  for (std::size_t i = 0; i < kBodies; ++i)
    worst = std::max(worst, (to_eigen(a.p_WB[i]) - to_eigen(b.p_WB[i])).squaredNorm());
  EXPECT_NEAR(static_cast<double>(lanes.worst[0]), worst, 1e-4 * worst);
}

TEST(Cost, UncertaintyReducesTheWeightOfItsBodyAlone) {
  const WalkingScene s;
  const int certain = 1, doubtful = 0;  // frame 5: (5 + 1) % 3 = 0, (5 + 0) % 3 = 2
  EXPECT_EQ(s.cost.position_weight(5, certain), 0.0);
  EXPECT_EQ(s.cost.position_weight(5, doubtful), s.cost.weights.position);
  EXPECT_EQ(s.cost.tangent_weight(5, kJointRotation + first_dof(1)), 0.0);
  EXPECT_EQ(s.cost.tangent_weight(5, kRootRotation), s.cost.weights.root_rotation);
}

TEST(Cost, FeetMayLandAtTheGoalsSpeedAsFarAsTheGoalIsFeasible) {
  const System walk = system_of(synthetic_reference("walk", 501, 60));
  FrameFactors unsure;
  unsure.momentum = 0.5f;
  const Cost feasible = make_cost(walk, {}), other = make_cost(walk, {}, List<FrameFactors>(60, unsure));
  double fastest = 0.0;
  for (int t = 0; t < walk.frames(); ++t)
    for (int k = 0; k < kFootPoints; ++k) {
      EXPECT_EQ(other.landings[t][k].near, feasible.landings[t][k].near);
      EXPECT_EQ(other.landings[t][k].v, 0.5 * feasible.landings[t][k].v);
      fastest = std::max(fastest, feasible.landings[t][k].v.norm());
    }
  EXPECT_GT(fastest, 0.1) << "m/s: a foot lands";
}

TEST(Cost, AssistiveForcesCostOnlyInAnAssistedSystem) {
  WalkingScene s;
  Control u{}, before{};
  u[3] = 0.5f;
  before[3] = 0.2f;
  u[kDofs + 1] = 2.0f;
  const CostWeights& w = s.cost.weights;
  const double unassisted = w.residual * 0.25 + w.change * 0.09;
  EXPECT_NEAR(control_cost(s.system, s.cost, u, before), unassisted, 1e-6);
  s.system.assisted = true;
  EXPECT_NEAR(control_cost(s.system, s.cost, u, before), unassisted + 4.0 * w.assistance, 1e-6);
}

TEST(Cost, RejectsWeightsWithoutAMinimum) {
  const System system = system_of(synthetic_reference("stand", 501, 4));
  CostWeights weights;
  weights.residual = 0.0;
  EXPECT_THROW(make_cost(system, weights), std::invalid_argument);
  weights = {};
  weights.position = -1.0;
  EXPECT_THROW(make_cost(system, weights), std::invalid_argument);
  weights = {};
  weights.body_rotation[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_cost(system, weights), std::invalid_argument);
  EXPECT_THROW(make_cost(system, {}, List<FrameFactors>(3)), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::control
