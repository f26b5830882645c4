// Trajectories with gaps.
#include "control/shooting.h"

#include <gtest/gtest.h>

#include <memory>

#include "control/fixtures.h"
#include "control/ilqr.h"

namespace mimicx::control {
namespace {

struct ShootingProblem {
  System system = system_of(synthetic_reference("squat", 501, 30));
  Cost cost = make_cost(system, {});
  Trajectory plan;

  ShootingProblem() {
    for (int t = 0; t < 21; ++t) plan.x.push_back(as_floats(system.at(t)));
    plan.u.resize(20);
    plan.gaps = find_gaps(system, plan);
  }
};

TEST(Shooting, RollOutHasNoGaps) {
  ShootingProblem p;
  take_lane(roll_out(p.system, p.cost, p.plan, {}, step_lengths()), 0, p.plan);
  EXPECT_TRUE(p.plan.gaps.empty());
  for (const Eigen::VectorXd& gap : find_gaps(p.system, p.plan)) EXPECT_TRUE(gap.isZero(0.0));
}

TEST(Shooting, GapLeadsFromThePlannedToTheSimulatedState) {
  const ShootingProblem p;
  const auto scratch = std::make_unique<Data<P>>();
  for (int t : {0, 7, 19}) {
    State<P> x = in_all_lanes<P>(p.plan.x[static_cast<std::size_t>(t)]);
    const Target<P> from = target_of(p.system, t, {}), to = target_of(p.system, t + 1, {});
    advance(p.system, from, to, {}, x, *scratch);
    State<double> reached = p.plan.x[static_cast<std::size_t>(t + 1)];
    Tangent<double> gap;
    for (int k = 0; k < kTangent; ++k)
      gap[static_cast<std::size_t>(k)] = p.plan.gaps[static_cast<std::size_t>(t + 1)][k];
    retract(reached, gap);
    const Tangent<double> left = difference(reached, lane_of(x, 0));
    for (double x_k : left) EXPECT_NEAR(x_k, 0.0, 2e-6);
  }
}

// The guess is the reference's states with zero controls: one iteration follows it, a roll-out of it falls.
TEST(Shooting, OneIterationClosesTheGapsOfAFeasibleReference) {
  ShootingProblem p;
  IterationState state;
  improve({p.system, p.cost}, 0.2, 2, state, p.plan);
  EXPECT_TRUE(p.plan.gaps.empty());
  EXPECT_LT(p.plan.worst, 0.02);
  const double closed = p.plan.cost;
  EXPECT_TRUE(std::isfinite(closed));
  improve({p.system, p.cost}, 0.2, 2, state, p.plan);
  EXPECT_LE(p.plan.cost, closed);
}

// With a trusted distance of almost zero no gap is closed, and the states do not change.
TEST(Shooting, FramesAfterTheTrustedOnesKeepTheirStates) {
  ShootingProblem p;
  const Trajectory before = p.plan;
  IterationState state;
  improve({p.system, p.cost}, 1e-9, 2, state, p.plan);
  ASSERT_EQ(p.plan.gaps.size(), 21u);
  EXPECT_EQ(to_eigen(p.plan.x[10].p_root), to_eigen(before.x[10].p_root));
  EXPECT_EQ(p.plan.u, before.u);
}

}  // namespace
}  // namespace mimicx::control
