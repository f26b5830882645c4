/// Fixtures of the learner's tests: configurations (each test changes the settings it tests), an agent, and
/// the comparison of saved states.
#pragma once

#include <gtest/gtest.h>

#include "core/npz/npz.h"
#include "rl/policy.h"
#include "rl/ppo_config.h"

namespace mimicx::rl {

inline PpoConfig ppo_for_tests() {
  return {.horizon = 32,
          .gamma = 0.97,
          .lambda = 0.95,
          .sigma_start = 0.07,
          .sigma_end = 0.04,
          .epochs = 2,
          .minibatch = 4096,
          .clip = 0.2,
          .gradient_norm = 1.0,
          .critic_step_size = 5e-4,
          .return_rate = 0.1,
          .step_size = 5e-5,
          .step_factor = 1.5,
          .step_min = 1e-6,
          .step_max = 2e-3,
          .kl_target = 0.02,
          .kl_stop = 4.0,
          .penalty_weight = 0.0,
          .penalty_fraction = 0.125,
          .gradient_slots = 4,
          .pass_rows = 512};
}

/// A configuration with several passes of unequal size in a slot, and every term of the loss.
inline PpoConfig small_config() {
  PpoConfig config = ppo_for_tests();
  config.horizon = 16;
  config.minibatch = 256;
  config.gradient_slots = 3;
  config.pass_rows = 50;
  config.sigma_start = config.sigma_end = 0.3;
  config.penalty_weight = 0.01;
  config.penalty_fraction = 0.25;
  return config;
}

inline Agent small_agent(int observations = 2, int actions = 1) {
  AgentShape shape;
  shape.observation_dim = observations;
  shape.action_dim = actions;
  shape.hidden = {32, 16};
  return make_agent(shape, 5);
}

inline void expect_same_bytes(const Npz& a, const Npz& b) {
  ASSERT_EQ(a.members().size(), b.members().size());
  for (std::size_t k = 0; k < a.members().size(); ++k) {
    EXPECT_EQ(a.members()[k].first, b.members()[k].first);
    EXPECT_TRUE(a.members()[k].second.bytes == b.members()[k].second.bytes) << a.members()[k].first;
    EXPECT_TRUE(a.members()[k].second.text == b.members()[k].second.text) << a.members()[k].first;
  }
}

}  // namespace mimicx::rl
