/// The environment concept is checked at compile time, so most of these tests are static assertions.
#include "rl/environment.h"

#include <gtest/gtest.h>

#include "rl/toy_environments.h"

namespace mimicx::rl {
namespace {

using Toy = toy::ToyEnvironment<toy::Pendulum>;
static_assert(Environment<Toy>);

struct WithoutActor : Toy {
  void actor(int, int) const = delete;
  int acter(int, int) const { return 1; }
};
static_assert(!Environment<WithoutActor>, "a misspelt actor must not compile");

struct ActorNotConst : Toy {
  int actor(int, int) { return 1; }
};
static_assert(!Environment<ActorNotConst>, "actor must be const");

struct WithoutAgents : Toy {
  void agents() const = delete;
};
static_assert(!Environment<WithoutAgents>, "the number of agents is required");

struct WithoutResetCharacters : Toy {
  void end_iteration() {}
};
static_assert(!Environment<WithoutResetCharacters>,
              "end_iteration must return the characters that it resets");

TEST(Environment, SingleAgentActsForEveryCharacter) {
  const Toy world(2, 3, 1);
  EXPECT_EQ(world.agents(), 1);
  for (int group = 0; group < 2; ++group)
    for (int character = 0; character < 3; ++character) EXPECT_EQ(world.actor(group, character), 0);
}

}  // namespace
}  // namespace mimicx::rl
