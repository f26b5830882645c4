// Access to lanes, and the interval between two PD targets.
#include "physics/control_interval.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>

#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

using P = Pack<kLanes>;

template <class T>
struct Interval {
  Model<RealOf<T>> model = make_model<RealOf<T>>(make_character());
  State<T> state{};
  Target<T> from{}, to{}, unused{};
  Data<T> data{};

  explicit Interval(std::uint64_t seed) {
    for (int lane = 0; lane < ScalarTraits<T>::kSize; ++lane) {
      Random random(31, {seed, static_cast<std::uint64_t>(lane)});
      const Snapshot a = random_snapshot(random, 0.8, 1.0, 1.0);
      set_lane(a, lane, state, from);
      Snapshot b = a;
      for (int i = 1; i < kBodies; ++i)
        b.target_q[i] = a.target_q[i] * exp_map(is_hinge(i) ? Vector3d(0.1 * hinge_axis(i))
                                                            : Vector3d(0.1 * random_vector(random)));
      State<T> ignored;
      set_lane(b, lane, ignored, to);
    }
  }
};

TEST(Lanes, RoundTripKeepsTheBitsOfAState) {
  const auto s = std::make_unique<Interval<P>>(1);
  State<P> copy{};
  for (int lane = 0; lane < kLanes; ++lane) set_lane(copy, lane, lane_of(s->state, lane));
  EXPECT_EQ(std::memcmp(&copy, &s->state, sizeof copy), 0);
  const State<P> spread = in_all_lanes<P>(lane_of(s->state, 2));
  State<P> one_by_one{};
  for (int lane = 0; lane < kLanes; ++lane) copy_lane(one_by_one, lane, s->state, 2);
  EXPECT_EQ(std::memcmp(&spread, &one_by_one, sizeof spread), 0);
}

TEST(ControlInterval, EqualsItsStepsTowardsInterpolatedTargets) {
  const auto s = std::make_unique<Interval<double>>(2);
  State<double> by_hand = s->state;
  std::vector<Target<double>> seen;
  const int substeps = 8;
  EXPECT_FALSE(advance_interval<double>(
      s->model, {s->from, s->to, substeps}, s->state, s->data, nullptr,
      [&](const auto&, const Target<double>& target, const auto&, const auto&) { seen.push_back(target); }));
  ASSERT_EQ(seen.size(), 8u);
  for (int k = 1; k <= substeps; ++k) {
    Target<double> target{};
    const double share = static_cast<double>(k) / substeps;
    for (int i = 1; i < kBodies; ++i) {
      const Quaterniond q = to_eigen(s->from.q[i]).slerp(share, to_eigen(s->to.q[i]));
      EXPECT_LT(q.angularDistance(to_eigen(seen[k - 1].q[i])), 1e-4) << kBodyNames[i];
      target.q[i] = from_eigen(q);
      target.omega[i] =
          from_eigen(Vector3d((1.0 - share) * to_eigen(s->from.omega[i]) + share * to_eigen(s->to.omega[i])));
    }
    step(s->model, target, by_hand, s->data);
  }
  // The only difference is nlerp against slerp.
  EXPECT_LT((to_eigen(by_hand.p_root) - to_eigen(s->state.p_root)).norm(), 1e-5);
  for (int i = 0; i < kBodies; ++i)
    EXPECT_LT(to_eigen(by_hand.q[i]).angularDistance(to_eigen(s->state.q[i])), 1e-4) << kBodyNames[i];
}

TEST(ControlInterval, WatchingAndRecordingChangeNoBit) {
  const auto a = std::make_unique<Interval<P>>(3), b = std::make_unique<Interval<P>>(3);
  const auto applied = std::make_unique<Applied<P>>();
  clear(*applied);
  advance_interval<P>(a->model, {a->from, a->to, 8}, a->state, a->data);
  int steps = 0;
  advance_interval<P>(b->model, {b->from, b->to, 8}, b->state, b->data, applied.get(),
                      [&](const auto&, const auto&, const auto&, const auto&) { ++steps; });
  EXPECT_EQ(std::memcmp(&a->state, &b->state, sizeof a->state), 0);
  EXPECT_EQ(steps, 8);
  EXPECT_EQ(applied->steps, 8);
}

TEST(ControlInterval, ReportsALaneThatFailsDuringTheInterval) {
  const auto s = std::make_unique<Interval<P>>(4);
  State<double> resting = lane_of(s->state, 0);  // in the air, in a pose that no range bends: it falls freely
  Target<double> aim{};
  resting.p_root = {0.0, 0.0, 50.0};
  resting.q.fill({1.0, 0.0, 0.0, 0.0});
  resting.v_root = {0.0, 0.0, 0.0};
  resting.omega.fill({0.0, 0.0, 0.0});
  aim.q = resting.q;
  s->state = in_all_lanes<P>(resting);
  s->from = s->to = in_all_lanes<P>(aim);
  s->state.v_root.z.set(2, -99.9f);  // just under max_speed: too fast once it has fallen a little
  EXPECT_FALSE(any(step(s->model, s->to, s->state, s->data)));
  const auto wrong = advance_interval<P>(s->model, {s->from, s->to, 8}, s->state, s->data);
  EXPECT_FALSE(ScalarTraits<P>::lane(wrong, 0));
  EXPECT_TRUE(ScalarTraits<P>::lane(wrong, 2));
}

TEST(ControlInterval, AssistiveForceEqualToTheWeightMakesTheBodyFloat) {
  const Character character = make_character();
  Snapshot snapshot = standing(stiffened(character));
  snapshot.p_root.z() += 0.5;
  const auto s = std::make_unique<Simulation<double>>(stiffened(character), SimulationConfig{}, snapshot);
  Wrench<double> assistance{zero3<double>(), {0.0, 0.0, character.total_mass() * kGravity}};
  const Vector3d before = to_eigen(s->state.p_root);
  // One interval only: the centre of mass is in front of the pelvis, and its moment turns the body.
  advance_interval<double>(s->model, {s->target, s->target, 8, &assistance}, s->state, s->data);
  EXPECT_LT((to_eigen(s->state.p_root) - before).norm(), 5e-4);  // a free fall: 6e-3
  EXPECT_LT(std::abs(s->state.v_root.z), 0.02);                  // a free fall: 0.33
}

TEST(PdTarget, ClampsActionsAndTreatsNonFiniteEntriesAsZero) {
  std::array<float, kDofs> action{};
  const int hip = first_dof(kLeftHip), knee = first_dof(kLeftKnee);
  action[hip] = 9.0f;
  action[hip + 1] = std::numeric_limits<float>::quiet_NaN();
  action[hip + 2] = -0.25f;
  action[knee] = 0.5f;
  const auto entry = [&](int dof) { return action[dof]; };
  EXPECT_EQ(action_rotation(kLeftHip, 2.5, entry), Vector3d(2.5, 0.0, -0.25));
  EXPECT_EQ(action_rotation(kLeftKnee, 2.5, entry), Vector3d(0.5 * hinge_axis(kLeftKnee)));
  const Quaterniond reference = exp_map(Vector3d(0.3, -0.2, 0.1));
  const Quaterniond target = residual_target(reference, Vector3d(0.0, 0.1, 0.0));
  EXPECT_NEAR((log_map(reference.conjugate() * target) - Vector3d(0.0, 0.1, 0.0)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace mimicx::physics
