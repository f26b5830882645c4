// A million character steps with random states and targets far outside the range of human motion.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include "physics/integration.h"
#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

using P = Pack<kLanes>;

/// A random snapshot: from rest to far beyond human speeds, high in the air or deep in the floor, joints
/// beyond their ranges, targets up to half a turn away with any velocity.
Snapshot anything(Random& random) {
  const double speed = std::pow(10.0, random.uniform(-2.0, 1.7));
  Snapshot s = random_snapshot(random, 3.1, speed, random.uniform(-0.5, 2.0));
  const double feed_forward = std::pow(10.0, random.uniform(-2.0, 2.0));
  for (int i = 1; i < kBodies; ++i)
    s.target_omega[i] =
        feed_forward * (is_hinge(i) ? Vector3d(random.normal() * hinge_axis(i)) : random_vector(random));
  return s;
}

/// New targets of the same kind, the state as it is.
void new_target(Random& random, int lane, Simulation<P>& s) {
  const Snapshot aim = anything(random);
  for (int i = 0; i < kBodies; ++i) {
    set_lane(s.target.q[i], lane, aim.target_q[i]);
    set_lane(s.target.omega[i], lane, aim.target_omega[i]);
  }
}

/// Finite in the lanes whose state is finite and all forces on them.
P sum_of_all(const Simulation<P>& s) {
  P sum(0.0);
  const auto add_one = [&](P x) { sum += max(x, -x); };  // a sum of magnitudes keeps NaN and infinity
  const auto add = [&](const Vec3<P>& v) {
    add_one(v.x);
    add_one(v.y);
    add_one(v.z);
  };
  add(s.state.p_root);
  add(s.state.v_root);
  for (int i = 0; i < kBodies; ++i) {
    for (const P& x : {s.state.q[i].w, s.state.q[i].x, s.state.q[i].y, s.state.q[i].z}) add_one(x);
    add(s.state.omega[i]);
    add(s.applied.joint_torque[i]);
    add(s.applied.ground[i].f);
    add(s.applied.ground[i].n);
    add(s.applied.self[i].f);
    add(s.applied.self[i].n);
  }
  return sum;
}

TEST(Robustness, UnflaggedLanesStayFiniteOverAMillionRandomSteps) {
  constexpr int kSteps = 1'000'000 / kLanes + 1;
  Random random(81);
  long flagged = 0, shapes = 0;
  std::unique_ptr<Simulation<P>> s;
  for (int k = 0; k < kSteps; ++k) {
    if (k % 4096 == 0) {  // another shape, rate and number of passes
      SimulationConfig config;
      config.rate = 120.0 * static_cast<double>(1 << (shapes % 3));
      config.passes = 1 + static_cast<int>(shapes / 3 % 3);
      s = std::make_unique<Simulation<P>>(make_character(random_betas(random)), config);
      for (int lane = 0; lane < kLanes; ++lane) set_lane(anything(random), lane, s->state, s->target);
      ++shapes;
    }
    if (k % 64 == 63)
      for (int lane = 0; lane < kLanes; ++lane) new_target(random, lane, *s);
    const auto wrong = s->advance();
    const P sum = sum_of_all(*s);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (ScalarTraits<P>::lane(wrong, lane)) {
        ++flagged;
        set_lane(anything(random), lane, s->state, s->target);  // the episode ends
      } else {
        ASSERT_TRUE(std::isfinite(sum[lane])) << "step " << k << ", lane " << lane;
      }
    }
  }
  std::printf("  measured: %d steps of %d lanes, %ld shapes, %ld lanes flagged\n", kSteps, kLanes, shapes,
              flagged);
  EXPECT_GT(flagged, 0) << "nothing ran away: the test is too tame";
}

/// Bits of a lane's state.
std::array<float, 6 + 7 * kBodies> bits_of(const State<P>& state, int lane) {
  std::array<float, 6 + 7 * kBodies> bits{};
  std::size_t n = 0;
  const auto add = [&](const P& x) { bits[n++] = x[lane]; };
  for (const Vec3<P>& v : {state.p_root, state.v_root}) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  for (int i = 0; i < kBodies; ++i) {
    for (const P& x : {state.q[i].w, state.q[i].x, state.q[i].y, state.q[i].z}) add(x);
    for (const P& x : {state.omega[i].x, state.omega[i].y, state.omega[i].z}) add(x);
  }
  return bits;
}

// One lane beside random neighbours, including NaN, infinite and runaway ones, has the bits that it has
// beside copies of itself.
TEST(Robustness, LaneKeepsItsBitsBesideFailingLanes) {
  const Character character = make_character();
  long flagged = 0;
  for (std::uint64_t trial = 0; trial < 24; ++trial) {
    Random random(82, {trial});
    const int kept = static_cast<int>(trial) % kLanes;
    const Snapshot tame = random_snapshot(random, 1.2, 3.0, 0.9);
    const auto alone = std::make_unique<Simulation<P>>(character, SimulationConfig{}, tame);
    const auto crowd = std::make_unique<Simulation<P>>(character, SimulationConfig{}, tame);
    for (int k = 0; k < 240; ++k) {
      for (int lane = 0; lane < kLanes; ++lane) {
        if (lane == kept || random.uniform() > 0.1) continue;
        Snapshot s = anything(random);
        const double kind = random.uniform();
        const auto body = random.below(kBodies);
        if (kind < 0.1) s.omega[body].x() = std::numeric_limits<double>::quiet_NaN();
        if (kind > 0.1 && kind < 0.2) s.p_root.z() = std::numeric_limits<double>::infinity();
        if (kind > 0.2 && kind < 0.3) s.target_q[body].w() = std::numeric_limits<double>::quiet_NaN();
        if (kind > 0.3 && kind < 0.4) s.v_root *= 1e30;
        set_lane(s, lane, crowd->state, crowd->target);
      }
      const auto fine = alone->advance(), wrong = crowd->advance();
      ASSERT_FALSE(ScalarTraits<P>::lane(wrong, kept));
      ASSERT_FALSE(ScalarTraits<P>::lane(fine, kept));
      for (int lane = 0; lane < kLanes; ++lane) flagged += ScalarTraits<P>::lane(wrong, lane);
      const auto a = bits_of(alone->state, kept), b = bits_of(crowd->state, kept);
      ASSERT_EQ(std::memcmp(a.data(), b.data(), sizeof a), 0) << "trial " << trial << " step " << k;
    }
  }
  EXPECT_GT(flagged, 1000);
}

TEST(Robustness, FlagsNaNInTheSameStepAnywhereInStateOrTarget) {
  const Character character = make_character();
  Random random(83);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int body = 0; body < kBodies; ++body)
    for (int place = 0; place < 4; ++place) {
      if (body == 0 && place > 1) continue;  // the pelvis has no target
      Snapshot s = random_snapshot(random, 1.0, 1.0, 3.0);
      if (place == 0) s.q[body].x() = nan;
      if (place == 1) s.omega[body].y() = nan;
      if (place == 2) s.target_q[body].z() = nan;
      if (place == 3) s.target_omega[body].x() = nan;
      const auto simulation = std::make_unique<Simulation<P>>(character, SimulationConfig{}, s);
      const auto wrong = simulation->advance();
      EXPECT_TRUE(ScalarTraits<P>::lane(wrong, 0)) << kBodyNames[body] << " " << place;
    }
}

TEST(Robustness, FlagsAHalfTurnOfAJointWithinAStep) {
  const Character c = make_character();
  for (const double rate : {30.0, 120.0}) {  // rates at which this is below max_joint_speed
    SimulationConfig o;
    o.rate = rate;
    Simulation<double> s(c, o, standing(c));
    for (const double turn : {0.99, 1.01}) {  // half circles per step
      s.state.omega[kLeftElbow] = {0.0, turn * std::acos(-1.0) * rate, 0.0};
      EXPECT_EQ(any(gone_wrong(s.model, s.state)), turn > 1.0) << rate;
    }
  }
}

}  // namespace
}  // namespace mimicx::physics
