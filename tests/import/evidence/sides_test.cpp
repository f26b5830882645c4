#include "import/evidence/sides.h"

#include <gtest/gtest.h>

#include "synth/synthesize.h"

namespace mimicx::import {
namespace {

TEST(Sides, ToesAndKneesTellWhetherTheyAreExchanged) {
  synth::SynthConfig config;
  config.seed = 3;
  for (const std::string kind : {"walk", "squat", "kick"}) {
    config.kind = kind;
    PerFrame<Landmarks> poses = landmarks_of(motion::poses_of(synth::synthesize(config)));
    for (const bool has_toes : {true, false})
      EXPECT_FALSE(decide_sides(poses, has_toes).are_exchanged()) << kind;
    for (Landmarks& pose : poses)
      for (const int left : {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot, kLeftShoulder})
        std::swap(pose.p[left], pose.p[left + 1]);
    for (const bool has_toes : {true, false})
      EXPECT_TRUE(decide_sides(poses, has_toes).are_exchanged()) << kind;
  }
}

}  // namespace
}  // namespace mimicx::import
