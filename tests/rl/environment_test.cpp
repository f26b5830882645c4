/// What counts as an environment is decided when compiling, so these tests are assertions of the compiler.
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
static_assert(!Environment<WithoutActor>, "a misspelt actor must not mean that agent 0 does everything");

struct ActorNotConst : Toy {
  int actor(int, int) { return 1; }
};
static_assert(!Environment<ActorNotConst>, "nor must one that cannot be asked");

struct WithoutAgents : Toy {
  void agents() const = delete;
};
static_assert(!Environment<WithoutAgents>, "nor may the number of agents be left out");

struct SilentRestarts : Toy {
  void end_iteration() {}
};
static_assert(!Environment<SilentRestarts>, "characters that are put elsewhere must be named");

TEST(Environment, SingleAgentActsForEveryCharacter) {
  const Toy world(2, 3, 1);
  EXPECT_EQ(world.agents(), 1);
  for (int group = 0; group < 2; ++group)
    for (int character = 0; character < 3; ++character) EXPECT_EQ(world.actor(group, character), 0);
}

}  // namespace
}  // namespace mimicx::rl
