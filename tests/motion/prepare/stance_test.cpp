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

/// A person who stands on the left foot, which is put elsewhere in frame 6; frames 5 to 7 do not stand.
struct StandingOnOneFoot {
  PerFrame<SolePositions> points;
  PerFrame<bool> carried = PerFrame<bool>(12, true);
  PerFrame<Stance> stance = PerFrame<Stance>(12);

  explicit StandingOnOneFoot(const Vector3d& elsewhere) : points(12) {
    for (int t = 0; t < 12; ++t)
      for (int k = 0; k < kPointsPerFoot; ++k) {
        points[t][k] = t < 6 ? Vector3d::Zero() : elsewhere;
        stance[t][k] = t < 5 || t > 7;
      }
  }
  bool stands_on(int longest = 3) const {
    PerFrame<Stance> found = stance;
    stand_through_jumps(points, carried, 30.0, longest, {}, found);
    EXPECT_FALSE(
        std::any_of(found.begin(), found.end(), [](const Stance& at) { return at[kPointsPerFoot]; }));
    const auto in_gap = [&](int t) { return std::count(found[t].begin(), found[t].end(), true); };
    EXPECT_EQ(in_gap(5), in_gap(6));
    EXPECT_EQ(in_gap(6), in_gap(7));
    return in_gap(6) == kPointsPerFoot;
  }
};

TEST(Stance, FootThatStandsDoesNotJump) {
  const Vector3d near(0.06, 0.0, 0.0);
  EXPECT_TRUE(StandingOnOneFoot(near).stands_on());
  EXPECT_FALSE(StandingOnOneFoot(near).stands_on(2)) << "it does not stand for longer";
  EXPECT_FALSE(StandingOnOneFoot(Vector3d(0.12, 0.0, 0.0)).stands_on()) << "a step";
  StandingOnOneFoot lifted(near), hop(near), steps(near), moved(near);
  for (int k = 0; k < kPointsPerFoot; ++k) lifted.points[6][k].z() = 0.06;
  EXPECT_FALSE(lifted.stands_on());
  hop.carried[6] = false;
  EXPECT_FALSE(hop.stands_on());
  for (StandingOnOneFoot* walk : {&steps, &moved}) {
    for (int k = kPointsPerFoot + 1; k < kFootPoints; ++k) walk->stance[5][k] = true;
  }
  for (int k = 0; k < kPointsPerFoot; ++k) {
    steps.points[5][k] = 0.3 * near;
    steps.points[6][k] = 0.7 * near;
  }
  const auto kept = [](StandingOnOneFoot& walk) {
    PerFrame<Stance> found = walk.stance;
    stand_through_jumps(walk.points, walk.carried, 30.0, 3, {}, found);
    return std::all_of(found[6].begin(), found[6].begin() + kPointsPerFoot,
                       [](bool stands) { return stands; });
  };
  EXPECT_FALSE(kept(steps)) << "the other foot carries the body meanwhile";
  EXPECT_TRUE(kept(moved)) << "no leg moves a foot by 6 cm and stops it within 1/30 s";
}

// An estimate of a kick puts the whole body, and with it the standing foot, 6 cm aside within a frame.
TEST(Stance, EstimateThatJumpsOnOneFootIsOneStance) {
  ExactMotion motion("kick");
  const PerFrame<Stance> exact = motion.stance();
  const auto on_one_foot = [&](int t) {
    const auto left = std::count(exact[t].begin(), exact[t].begin() + kPointsPerFoot, true);
    const auto right = std::count(exact[t].begin() + kPointsPerFoot, exact[t].end(), true);
    return (left == 0) != (right == 0);
  };
  int first = 0, last = -1;  // of the longest stance on one foot
  for (int t = 0, begin = 0; t < exact.count(); ++t) {
    if (!on_one_foot(t)) begin = t + 1;
    if (t - begin > last - first) first = begin, last = t;
  }
  ASSERT_GT(last - first, 8);
  const int jump = (first + last) / 2;
  motion.move([&](int t) { return Vector3d(t < jump ? 0.0 : 0.06, 0.0, 0.0); });
  EXPECT_EQ(motion.stance()[jump], exact[jump]);
  EXPECT_EQ(motion.stance()[jump - 1], exact[jump - 1]);
}

}  // namespace
}  // namespace mimicx::motion
