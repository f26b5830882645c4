#include "import/evidence/up_axis.h"

#include <gtest/gtest.h>

#include "import/world_transform.h"
#include "motion/made_motions.h"
#include "synth/synthesize.h"

namespace mimicx::import {
namespace {

motion::Clip moving(const std::string& kind) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 3;
  return synth::synthesize(config);
}

/// What is decided where `axis` is up in the file.
UpDecision decided_up(motion::Clip clip, char axis, char custom) {
  rotate_world(rotation_to_z_up(axis).conjugate(), clip);
  return decide_up(landmarks_of(motion::poses_of(clip)), std::nullopt, custom);
}

/// Without any motion but 1 mm of sway, in a pose turned about x from standing.
motion::Clip still(double turned, int frames = 60) {
  motion::Clip clip = test::standing_clip(frames, test::standing_height());
  for (int t = 0; t < frames; ++t) clip.trans[t].x() += 0.001 * (t % 2);
  rotate_world(exp_map(turned * Vector3d::UnitX()), clip);
  return clip;
}

/// The floor at height 0.
motion::Clip on_floor(motion::Clip clip) {
  double lowest = 1e9;
  for (const BodyPoses& pose : motion::poses_of(clip))
    lowest = std::min(lowest, lowest_contact(make_character(), pose));
  shift_world({0, 0, -lowest}, clip);
  return clip;
}

TEST(UpAxis, WhoeverMovesOnAFloorTellsIt) {
  for (const std::string kind : {"walk", "jump", "squat", "kick", "dance"})
    for (const char axis : {'y', 'z', 'Y'})
      for (const char custom : {'y', 'z'}) {
        const UpDecision up = decided_up(moving(kind), axis, custom);
        EXPECT_EQ(up.axis, axis) << kind << ", custom " << custom << ": " << up.why;
        EXPECT_TRUE(!up.is_near() || axis == 'Y') << kind << ' ' << axis << custom;
      }
  for (const char axis : {'x', 'X', 'Z'}) EXPECT_EQ(decided_up(moving("walk"), axis, 'z').axis, axis);
}

TEST(UpAxis, WhoeverStandsStillIsUpright) {
  for (const int frames : {1, 2, 60})
    for (const char axis : {'y', 'z'})
      for (const char custom : {'y', 'z'})
        EXPECT_EQ(decided_up(still(0.0, frames), axis, custom).axis, axis) << frames << ' ' << axis << custom;
}

TEST(UpAxis, ASleeperIsNotStoodUp) {
  motion::Clip clip = on_floor(still(-test::kPi / 2));
  rotate_world(exp_map(test::kPi / 2 * Vector3d::UnitZ()), clip);  // along x
  EXPECT_EQ(decided_up(clip, 'z', 'z').axis, 'z');
}

TEST(UpAxis, ACrawlerLiesAlongTheFloor) {
  motion::Clip clip = on_floor(still(test::kPi / 2, 90));
  for (int t = 0; t < clip.frames(); ++t) clip.trans[t] += 0.01 * t * Vector3d::UnitY();
  EXPECT_EQ(decided_up(clip, 'z', 'z').axis, 'z');
}

TEST(UpAxis, AHandstandStaysOnItsHands) {
  // Hands over the head and down: they rest, the feet sway.
  motion::Clip clip = test::standing_clip(90, test::standing_height());
  for (int t = 0; t < clip.frames(); ++t) {
    clip.rotations[t][kLeftShoulder] = {0, 0, 1.5};
    clip.rotations[t][kRightShoulder] = {0, 0, -1.5};
    clip.rotations[t][kLeftHip] = {0.2 * std::sin(0.2 * t), 0, 0.1};
  }
  rotate_world(exp_map(test::kPi * Vector3d::UnitX()), clip);
  clip = on_floor(clip);
  EXPECT_EQ(decided_up(clip, 'z', 'z').axis, 'z');
  EXPECT_EQ(decided_up(clip, 'y', 'y').axis, 'y');
}

TEST(UpAxis, NearlyEqualAxesGiveAWarning) {
  motion::Clip clip = on_floor(still(-test::kPi / 2));  // lies on the floor along y, as a person stands y up
  shift_world({0, 5, 0}, clip);
  const UpDecision up = decided_up(clip, 'z', 'z');
  EXPECT_TRUE(up.is_near()) << up.lead;
  EXPECT_NE(near_up_warning(up).find("--up"), std::string::npos);
}

}  // namespace
}  // namespace mimicx::import
