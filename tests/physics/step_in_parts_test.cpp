// The tests' step in parts is the simulator's step, bit by bit.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "physics/contact_scenes.h"
#include "physics/step_in_parts.h"

namespace mimicx::physics {
namespace {

/// Counts the solves of a step.
struct Counting : StepParts {
  int solves = 0;
  template <class T>
  void before_solve(Data<T>&) {
    ++solves;
  }
};

/// Thrown onto the floor with targets far away, so that contacts, ranges and torque bounds all act.
template <class T>
std::unique_ptr<Simulation<T>> thrown(const SimulationConfig& config) {
  const Character c = make_character();
  auto s = std::make_unique<Simulation<T>>(c, config);
  for (int lane = 0; lane < ScalarTraits<T>::kSize; ++lane) {
    Random random(73, {static_cast<std::uint64_t>(lane)});
    Snapshot start = snapshot_of(ContactScene::kThrow, c, static_cast<std::uint64_t>(lane));
    start.target_q = random_snapshot(random, 1.2, 0.0, 1.0).q;
    set_lane(start, lane, s->state, s->target);
  }
  return s;
}

template <class T>
void expect_the_bits_of_step(const SimulationConfig& config) {
  const auto whole = thrown<T>(config), parts = thrown<T>(config);
  Counting counting;
  const int steps = 240;
  for (int k = 0; k < steps; ++k) {
    whole->advance();
    step_in_parts(parts->model, parts->target, parts->state, parts->data, counting);
    ASSERT_EQ(std::memcmp(&whole->state, &parts->state, sizeof whole->state), 0) << "step " << k;
  }
  EXPECT_GT(counting.solves, steps * config.passes) << "the repetitions for torque bounds must take part";
}

TEST(StepInParts, GivesTheBitsOfStep) {
  for (int passes : {1, 2, 3})
    for (bool self_contact : {false, true}) {
      SimulationConfig config;
      config.passes = passes;
      config.self_contact = self_contact;
      expect_the_bits_of_step<double>(config);
      expect_the_bits_of_step<Pack<8>>(config);
      expect_the_bits_of_step<Pack<16>>(config);
    }
}

}  // namespace
}  // namespace mimicx::physics
