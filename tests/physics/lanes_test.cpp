// Packs: the result of a lane depends neither on its neighbours nor on the width of the pack.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>

#include "physics/step_in_parts.h"
#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

/// A lane in violent motion: in contact, falling, spinning, with distant PD targets.
Snapshot violent(std::uint64_t lane) {
  Random random(21, {lane});
  return random_snapshot(random, 1.2, 4.0, 0.9);
}

template <class T>
std::unique_ptr<Simulation<T>> violent_pack(const Character& character, std::uint64_t first) {
  auto simulation = std::make_unique<Simulation<T>>(character, SimulationConfig{});
  for (int lane = 0; lane < ScalarTraits<T>::kSize; ++lane)
    set_lane(violent(first + static_cast<std::uint64_t>(lane)), lane, simulation->state, simulation->target);
  return simulation;
}

/// All bits of a lane's state and record.
template <class T>
std::vector<float> bits_of(const Simulation<T>& s, int lane) {
  std::vector<float> all;
  const auto add = [&](const auto& v) {
    using Traits = ScalarTraits<T>;
    for (const T& x : {v.x, v.y, v.z}) all.push_back(static_cast<float>(Traits::get(x, lane)));
  };
  add(s.state.p_root);
  add(s.state.v_root);
  for (int i = 0; i < kBodies; ++i) {
    add(s.state.q[i]);
    all.push_back(ScalarTraits<T>::get(s.state.q[i].w, lane));
    add(s.state.omega[i]);
    add(s.applied.joint_torque[i]);
    add(s.applied.ground[i].f);
    add(s.applied.ground[i].n);
    add(s.applied.self[i].f);
    add(s.applied.self[i].n);
  }
  return all;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Step, LaneResultIgnoresOtherLanes) {
  using P = Pack<kLanes>;
  const Character character = make_character();
  const auto a = violent_pack<P>(character, 0);
  const auto b = violent_pack<P>(character, 100);
  const int kept = 1, nan_lane = 2, runaway = 3;
  set_lane(violent(kept), kept, b->state, b->target);
  Snapshot broken = violent(50);
  broken.omega[kLeftKnee].x() = std::numeric_limits<double>::quiet_NaN();
  set_lane(broken, nan_lane, b->state, b->target);
  Snapshot fast = violent(51);
  fast.v_root = {1e6, 0, 0};
  set_lane(fast, runaway, b->state, b->target);
  for (int k = 0; k < 240; ++k) {
    const auto fine = a->advance();
    const auto wrong = b->advance();
    ASSERT_TRUE(same_bits(bits_of(*a, kept), bits_of(*b, kept))) << "step " << k;
    for (int lane = 0; lane < kLanes; ++lane) {
      EXPECT_FALSE(ScalarTraits<P>::lane(fine, lane));
      EXPECT_EQ(ScalarTraits<P>::lane(wrong, lane), lane == nan_lane || lane == runaway);
    }
  }
}

TEST(Step, LaneBitsDoNotDependOnTheWidthOfThePack) {
  const Character character = make_character();
  const auto wide = violent_pack<Pack<16>>(character, 0);
  const auto low = violent_pack<Pack<8>>(character, 0), high = violent_pack<Pack<8>>(character, 8);
  for (int k = 0; k < 240; ++k) {
    wide->advance();
    low->advance();
    high->advance();
    for (int lane = 0; lane < 8; ++lane) {
      ASSERT_TRUE(same_bits(bits_of(*wide, lane), bits_of(*low, lane))) << "step " << k;
      ASSERT_TRUE(same_bits(bits_of(*wide, lane + 8), bits_of(*high, lane))) << "step " << k;
    }
  }
}

/// Makes every solve compute every body again; counts the bodies whose IA and pA `step` would keep.
struct AllOutdated : StepParts {
  int kept = 0;
  template <class T>
  void before_solve(Data<T>& d) {
    for (bool outdated : d.outdated) kept += outdated ? 0 : 1;
    d.outdated.fill(true);
  }
};

template <class T>
void expect_the_bits_of_solving_every_body(double height) {
  const Character character = make_character();
  SimulationConfig config;
  config.passes = 3;
  const auto s = std::make_unique<Simulation<T>>(character, config);
  for (int lane = 0; lane < ScalarTraits<T>::kSize; ++lane) {
    Snapshot start = standing(character), far = violent(static_cast<std::uint64_t>(lane));
    start.p_root.z() += height;
    start.target_q = far.target_q;
    set_lane(start, lane, s->state, s->target);
  }
  const auto anew = std::make_unique<Data<T>>();
  AllOutdated all_outdated;
  int saturated = 0, touching = 0;
  for (int k = 0; k < 240; ++k) {
    solve_in_parts(s->model, s->target, s->state, *anew, all_outdated);
    s->advance();
    ASSERT_EQ(std::memcmp(&anew->qdd, &s->data.qdd, sizeof anew->qdd), 0) << "step " << k;
    ASSERT_EQ(std::memcmp(&anew->a_v, &s->data.a_v, sizeof anew->a_v), 0) << "step " << k;
    articulated_body_algorithm(s->model, *anew);
    ASSERT_EQ(std::memcmp(&anew->qdd, &s->data.qdd, sizeof anew->qdd), 0) << "step " << k;
    for (int i = 1; i < kBodies; ++i) saturated += any(s->data.saturated[i]) ? 1 : 0;
    touching += s->data.ground_count > 0 ? 1 : 0;
  }
  EXPECT_GT(all_outdated.kept, 240);
  EXPECT_GT(saturated, 100);
  EXPECT_GT(touching, 30);
  EXPECT_LT(touching, 240) << "the flight before the landing must be part of the test";
}

TEST(Step, KeepingUnchangedBranchesGivesTheBitsOfSolvingEveryBody) {
  expect_the_bits_of_solving_every_body<double>(0.1);
  expect_the_bits_of_solving_every_body<Pack<8>>(0.1);
  expect_the_bits_of_solving_every_body<Pack<16>>(0.1);
}

TEST(Step, PackAgreesWithDoubleByTolerance) {
  const Character character = make_character();
  const auto pack = std::make_unique<Simulation<Pack<8>>>(character, SimulationConfig{});
  std::vector<Simulation<double>> singles;
  for (int lane = 0; lane < 8; ++lane) {
    Snapshot s = standing(character);
    s.p_root.z() += 0.02 * lane;
    s.v_root = {0.1 * lane, -0.05 * lane, 0};
    set_lane(s, lane, pack->state, pack->target);
    singles.emplace_back(character, SimulationConfig{}, s);
  }
  for (int k = 0; k < 60; ++k) {
    pack->advance();
    for (Simulation<double>& single : singles) single.advance();
  }
  for (int lane = 0; lane < 8; ++lane) {
    Snapshot in_pack, alone;
    read_lane(pack->state, lane, in_pack);
    read_lane(singles[lane].state, 0, alone);
    EXPECT_LT((in_pack.p_root - alone.p_root).norm(), 2e-5) << "lane " << lane;
    for (int i = 0; i < kBodies; ++i)
      EXPECT_LT(in_pack.q[i].angularDistance(alone.q[i]), 1e-3) << "lane " << lane << " body " << i;
  }
}

TEST(Aba, PackAccelerationsAgreeWithDoubleOnRandomStates) {
  const Character character = make_character();
  for (std::uint64_t first = 0; first < 64; first += 8) {
    const auto pack = violent_pack<Pack<8>>(character, first);
    PerBody<Vec3<Pack<8>>> tau;
    PerBody<Vec3<double>> tau_1;
    Random random(22, {first});
    for (int i = 0; i < kBodies; ++i) {
      const Vector3d t = 40.0 * random_vector(random);
      tau_1[i] = {t.x(), t.y(), t.z()};
      for (int lane = 0; lane < 8; ++lane) set_lane(tau[i], lane, t);
    }
    forward_dynamics(pack->model, pack->state, tau, pack->data);
    for (int lane = 0; lane < 8; ++lane) {
      Simulation<double> single(character, {}, violent(first + static_cast<std::uint64_t>(lane)));
      forward_dynamics(single.model, single.state, tau_1, single.data);
      double error = 0, size = 0;
      for (int i = 0; i < kBodies; ++i) {
        error = std::max(error, (lane_of(pack->data.qdd[i], lane) - lane_of(single.data.qdd[i], 0)).norm());
        size = std::max(size, lane_of(single.data.qdd[i], 0).norm());
      }
      EXPECT_LT(error, 1e-4 * size);
    }
  }
}

}  // namespace
}  // namespace mimicx::physics
