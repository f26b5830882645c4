#include "import/evidence/cadence.h"

#include <gtest/gtest.h>

#include "synth/synthesize.h"

namespace mimicx::import {
namespace {

PerFrame<Landmarks> landmarks_of_kind(const std::string& kind) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 3;
  return landmarks_of(motion::poses_of(synth::synthesize(config)));
}

TEST(Cadence, AWalkTellsTheLengthOfItsLegs) {
  const PerFrame<Landmarks> walk = landmarks_of_kind("walk_turn");
  const std::optional<double> leg = walking_leg(walk, Vector3d::UnitZ(), 30.0);
  ASSERT_TRUE(leg);
  EXPECT_NEAR(*leg, leg_length(walk), 0.2);
  EXPECT_DOUBLE_EQ(*walking_leg(walk, Vector3d::UnitZ(), 60.0), *leg / 4) << "twice as many steps a second";
}

TEST(Cadence, UnitAndAxesDoNotMatter) {
  const PerFrame<Landmarks> walk = landmarks_of_kind("walk_turn");
  PerFrame<Landmarks> turned;
  const Quaterniond turn = exp_map(Vector3d(0.3, 1.2, -0.4));
  for (const Landmarks& pose : walk) turned.push_back(transformed(pose, turn, 39.37));
  EXPECT_DOUBLE_EQ(*walking_leg(turned, turn * Vector3d::UnitZ(), 30.0),
                   *walking_leg(walk, Vector3d::UnitZ(), 30.0));
}

TEST(Cadence, GivesNoLegLengthWithoutWalking) {
  for (const char* kind : {"stand", "squat", "wave", "turn_in_place"})
    EXPECT_FALSE(walking_leg(landmarks_of_kind(kind), Vector3d::UnitZ(), 30.0)) << kind;
}

}  // namespace
}  // namespace mimicx::import
