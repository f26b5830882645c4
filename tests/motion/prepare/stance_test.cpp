// Which parts of the feet stand.
#include "motion/prepare/stance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/prepare/prepare.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

/// The exact poses of a synthetic motion.
struct ExactMotion {
  Reference reference;

  explicit ExactMotion(const std::string& kind)
      : reference(prepare_reference(test::synthetic_clip(kind, 3), {}, nullptr)) {}
  SolePositions sole(int t) const { return sole_positions(reference.character, reference.poses[t]); }
  PerFrame<Stance> stance() const { return find_stance(reference.character, reference.poses, reference.fps); }
  /// Moves the whole body in every frame.
  template <class Offset>
  void move(const Offset& offset) {
    for (int t = 0; t < reference.size(); ++t)
      for (Vector3d& p : reference.poses[t].p_WB) p += offset(t);
  }
};

bool any(const Stance& stance) { return std::find(stance.begin(), stance.end(), true) != stance.end(); }

// On the floor and at rest from the frame before to the frame after: it stands. High above it: it does not.
TEST(Stance, RestingPointsStandAndHighOnesDoNot) {
  for (const char* kind : {"walk", "squat", "jump"}) {
    const ExactMotion motion(kind);
    const PerFrame<Stance> stance = motion.stance();
    int resting = 0, high = 0;
    for (int t = 1; t + 1 < motion.reference.size(); ++t) {
      const SolePositions before = motion.sole(t - 1), now = motion.sole(t), after = motion.sole(t + 1);
      for (int k = 0; k < kFootPoints; ++k) {
        if (now[k].z() < 0.002 && (now[k] - before[k]).norm() < 0.0005 &&
            (after[k] - now[k]).norm() < 0.0005) {
          ++resting;
          EXPECT_TRUE(stance[t][k]) << kind << ", frame " << t << ", point " << k;
        }
        if (now[k].z() > 0.08) {
          ++high;
          EXPECT_FALSE(stance[t][k]) << kind << ", frame " << t << ", point " << k;
        }
      }
    }
    EXPECT_GT(resting, 100) << kind;
    if (std::string(kind) != "squat") {
      EXPECT_GT(high, 50) << kind;
    }
  }
}

TEST(Stance, NothingStandsInFlight) {
  const ExactMotion motion("jump");
  const PerFrame<Stance> stance = motion.stance();
  int flying = 0;
  for (int t = 0; t < motion.reference.size(); ++t) {
    const SolePositions p = motion.sole(t);
    const bool flies = std::all_of(p.begin(), p.end(), [](const Vector3d& at) { return at.z() > 0.06; });
    flying += flies;
    EXPECT_FALSE(flies && any(stance[t])) << t;
  }
  EXPECT_GT(flying, 3);
}

// Heights that tremble about the limit at which a foot begins to stand.
TEST(Stance, NoiseDoesNotLiftAStandingFoot) {
  ExactMotion motion("stand");
  motion.move([](int t) { return Vector3d(0.0, 0.0, t % 4 < 2 ? 0.024 : 0.026); });
  for (const Stance& stance : motion.stance())
    EXPECT_EQ(std::count(stance.begin(), stance.end(), true), kFootPoints);
}

// A person whose feet skate at 0.4 m/s, too fast for a standing foot, does not fall: something carries it.
TEST(Stance, CarriedBodyStandsEvenIfItsFeetSkate) {
  ExactMotion motion("stand");
  motion.move([](int t) { return Vector3d(0.4 * t / 30.0, 0.0, 0.0); });
  for (const Stance& stance : motion.stance()) EXPECT_TRUE(any(stance));
}

}  // namespace
}  // namespace mimicx::motion
