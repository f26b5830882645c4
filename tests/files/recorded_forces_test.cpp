#include "files/recorded_forces.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/units.h"
#include "files/pushed_clip.h"

namespace mimicx::files {
namespace {

TEST(RecordedForces, MissingMemberIsAnErrorAndNoMembersIsEmpty) {
  EXPECT_FALSE(recorded_forces(turning_clip(4)).has_value());
  for (const std::size_t gone : {0u, 1u}) {
    motion::Clip clip = pushed_clip(4);
    clip.passthrough.erase(clip.passthrough.begin() + static_cast<std::ptrdiff_t>(gone));
    EXPECT_THROW(recorded_forces(clip), DataError);
  }
  motion::Clip clip = pushed_clip(4);
  clip.rotations.resize(3);
  clip.trans.resize(3);
  EXPECT_THROW(recorded_forces(clip), DataError) << "forces of another number of frames";
}

TEST(RecordedForces, MembersOfOtherProgramsAreNoForcesOfOurs) {
  motion::Clip foreign = pushed_clip(4);
  foreign.body_model = "smplh";
  EXPECT_FALSE(recorded_forces(foreign).has_value()) << "another body";
  foreign.rest_joints = RestJoints{};
  EXPECT_TRUE(recorded_forces(foreign).has_value()) << "the user's own body, with which we simulate";
  for (const auto& [member, shape] :
       {std::pair<std::size_t, std::vector<std::size_t>>{0, {4, 2, 6}}, {1, {4, 69}}, {1, {4, 23, 3}}}) {
    motion::Clip clip = pushed_clip(4);
    const std::vector<double> zeros(4 * 69, 0.0);
    clip.passthrough[member].second = NpyArray::from_double(shape, zeros.data());
    EXPECT_FALSE(recorded_forces(clip).has_value()) << clip.passthrough[member].first;
  }
}

TEST(RecordedForces, ErrorsNameTheFile) {
  motion::Clip clip = pushed_clip(4);
  clip.passthrough.pop_back();
  try {
    recorded_forces(clip, "runs/walk.npz");
    FAIL() << "one of the two members is missing";
  } catch (const DataError& error) {
    EXPECT_EQ(std::string(error.what()).find("runs/walk.npz: expected member 'joint_torques'"), 0u)
        << error.what();
  }
}

TEST(RecordedForces, GravityIsThatOfTheSimulation) {
  motion::Clip clip = pushed_clip(4);
  EXPECT_EQ(recorded_gravity(clip), kGravity);
  const double mass = motion::character_of(clip).total_mass();
  clip.passthrough.emplace_back("body_weight", NpyArray::scalar(kGravity * mass));
  EXPECT_EQ(recorded_gravity(clip), kGravity);
  clip.passthrough.back().second = NpyArray::scalar(5.0 * mass);
  EXPECT_NEAR(recorded_gravity(clip), 5.0, 1e-12);
  clip.body_model = "smplx";
  EXPECT_EQ(recorded_gravity(clip), kGravity) << "another program's member";
  clip.body_model = "mimicx";
  for (const double none : {0.0, -700.0, std::numeric_limits<double>::quiet_NaN()}) {
    clip.passthrough.back().second = NpyArray::scalar(none);
    EXPECT_EQ(recorded_gravity(clip), kGravity) << none;
  }
  clip.passthrough.back().second = NpyArray::scalar_text("70 kg");
  EXPECT_EQ(recorded_gravity(clip), kGravity);
}

TEST(RecordedForces, SimulationIsTheOneWhoseMembersAreThere) {
  physics::SimulationConfig usual, other;
  other.gravity = 1.62;
  other.friction = 0.5;
  other.rate = 480.0;
  for (const physics::SimulationConfig& simulation : {usual, other}) {
    motion::Clip clip = pushed_clip(4);
    for (const auto& member : simulation_members(simulation, motion::character_of(clip).total_mass()))
      clip.passthrough.push_back(member);
    const physics::SimulationConfig read = recorded_simulation(clip);
    EXPECT_NEAR(read.gravity, simulation.gravity, 1e-12);
    EXPECT_EQ(read.friction, simulation.friction);
    EXPECT_EQ(read.rate, simulation.rate);
    remove_recorded(clip);
    EXPECT_EQ(recorded_simulation(clip).friction, usual.friction);
    EXPECT_EQ(recorded_simulation(clip).rate, usual.rate);
  }
  EXPECT_EQ(simulation_members(usual, 70.0).size(), 1u) << "the weight alone";
}

}  // namespace
}  // namespace mimicx::files
