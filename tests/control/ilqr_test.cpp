// Iterations on one window: the cost never rises, and threads change no byte.
#include "control/ilqr.h"

#include <gtest/gtest.h>

#include <cstring>

#include "control/fixtures.h"

namespace mimicx::control {
namespace {

struct WalkingProblem {
  System system = system_of(synthetic_reference("walk", 501, 30));
  Cost cost = make_cost(system, {});
  Trajectory plan;

  WalkingProblem() {
    plan.x.assign(13, lane_of(in_all_lanes<P>(system.at(0)), 0));
    plan.u.resize(12);
    roll();
  }
  /// Rolls out from the first state.
  void roll() { take_lane(roll_out(system, cost, plan, {}, step_lengths()), 0, plan); }
  /// One iteration.
  Iteration improve(IterationState& state, int threads = 2) {
    return control::improve({system, cost}, 0.2, threads, state, plan);
  }
};

TEST(Ilqr, CostNeverRisesAndEqualsThatOfTheRollOut) {
  WalkingProblem p;
  IterationState state;
  double last = p.plan.cost;
  const double first = last;
  for (int i = 0; i < 5; ++i) {
    const Iteration done = p.improve(state);
    EXPECT_LE(p.plan.cost, last);
    EXPECT_EQ(done.decrease >= 0.0, p.plan.cost < last);
    EXPECT_EQ(state.models_current, p.plan.cost == last);
    last = p.plan.cost;
    const Trajectory kept = p.plan;
    p.roll();
    EXPECT_EQ(p.plan.cost, kept.cost);
    EXPECT_EQ(std::memcmp(p.plan.x.data(), kept.x.data(), kept.x.size() * sizeof kept.x[0]), 0);
  }
  EXPECT_LT(last, 0.2 * first);
  EXPECT_LT(p.plan.worst, 0.02);
}

TEST(Ilqr, OneAndTwoThreadsGiveTheSameBytes) {
  WalkingProblem one, two;
  for (auto [p, threads] : {std::pair{&one, 1}, std::pair{&two, 2}}) {
    IterationState state;
    for (int i = 0; i < 2; ++i) p->improve(state, threads);
  }
  EXPECT_EQ(one.plan.cost, two.plan.cost);
  EXPECT_EQ(one.plan.u, two.plan.u);
  EXPECT_EQ(std::memcmp(one.plan.x.data(), two.plan.x.data(), one.plan.x.size() * sizeof one.plan.x[0]), 0);
}

TEST(Ilqr, ConcurrentSweepSeesTheModelsOfItsFrameAndAllLaterFrames) {
  WalkingProblem p;
  List<FrameModel> after, beside;
  build_models({p.system, p.cost}, p.plan, 1, after);
  const auto same = [&](int t) {
    EXPECT_EQ(beside[t].F, after[t].F);
    EXPECT_EQ(beside[t].cost.gradient, after[t].cost.gradient);
  };
  int next = p.plan.size() - 1;
  build_models({p.system, p.cost}, p.plan, 2, beside, [&](int t) {
    EXPECT_EQ(t, next--);
    if (t + 1 == p.plan.size()) {
      EXPECT_EQ(beside[t + 1].cost.gradient, after[t + 1].cost.gradient);
    }
    same(t);
  });
  EXPECT_EQ(next, -1);
}

// The predicted decrease is that of the linear-quadratic model; near the optimum it is the true one.
TEST(Ilqr, PredictedDecreaseMatchesAFullStep) {
  WalkingProblem p;
  IterationState state;
  for (int i = 0; i < 3; ++i) p.improve(state);
  const double before = p.plan.cost;
  // A small step along the law: the cost falls by α (2 − α) of the promised decrease.
  for (Control& u : p.plan.u) u[static_cast<std::size_t>(first_dof(kLeftShoulder))] += 0.01f;
  p.roll();
  const double raised = p.plan.cost;
  ASSERT_GT(raised, before);
  state.models_current = false;
  p.improve(state);
  EXPECT_NEAR(raised - p.plan.cost, state.sweep.decrease, 0.2 * state.sweep.decrease);
}

}  // namespace
}  // namespace mimicx::control
