#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "synth/synth_motions.h"

namespace mimicx::synth {
namespace {

using namespace test;

/// @param clear  soles higher than this are surely off the floor, m
/// @param frames  in flight, at least
void expect_parabolas(const std::string& kind, double clear, int frames) {
  for (const test::Motion& m : test::motions(kind)) {
    int flying = 0;
    for (std::size_t t = 1; t + 1 < m.frames(); ++t) {
      if (m.lowest(t) < clear) continue;
      const Vector3d a = (m.com(t + 1) - 2.0 * m.com(t) + m.com(t - 1)) / (test::kDt * test::kDt);
      EXPECT_LT((a + test::kG * Vector3d::UnitZ()).norm(), 1e-6) << m.clip.name << ", frame " << t;
      ++flying;
    }
    EXPECT_GE(flying, frames) << m.clip.name;
  }
}

/// The feet of a jump lift a moment before the body leaves the floor.
TEST(Jump, FliesOnAParabola) { expect_parabolas("jump", 0.01, 6); }

TEST(Jog, FliesOnAParabolaBetweenItsSteps) { expect_parabolas("jog", 0.008, 10); }

/// The metrics call up to 5 mm contact: 8 mm is clear of it.
TEST(Jog, IsClearOfTheFloorInEveryFrameOfAFlight) {
  for (const test::Motion& m : test::motions("jog"))
    for (std::size_t t = 0; t < m.frames(); ++t)
      EXPECT_TRUE(m.lowest(t) < 1e-4 || m.lowest(t) > 0.008) << m.clip.name << ", frame " << t;
}

TEST(Jump, RisesAndLandsOnItsFeet) {
  for (const test::Motion& m : test::motions("jump")) {
    double highest = 0.0, clearance = 0.0;
    for (std::size_t t = 0; t < m.frames(); ++t) {
      highest = std::max(highest, m.com(t).z());
      clearance = std::max(clearance, m.lowest(t));
    }
    EXPECT_GT(highest, m.com(0).z() + 0.10);
    EXPECT_GT(clearance, 0.03);
  }
}

TEST(Walk, GoesAtWalkingSpeedAlongItsHeading) {
  for (const test::Motion& m : test::motions("walk")) {
    const double leg = (m.character.joint_offset[kLeftKnee] + m.character.joint_offset[kLeftAnkle]).norm();
    const std::size_t from = m.frames() / 2 - 16, to = m.frames() / 2 + 16;  // two steps, about
    const Vector3d travelled = m.com(to) - m.com(from);
    const double speed = travelled.head<2>().norm() / (32 * test::kDt);
    EXPECT_GT(speed, 0.75 * leg / 0.79);
    EXPECT_LT(speed, 1.4);
    const Vector3d forward = rotation_z(heading_angle(m.poses[0].q_WB[0])) * Vector3d::UnitX();
    EXPECT_GT(travelled.normalized().dot(forward), 0.99);
  }
}

TEST(Walk, NeverFliesStandsOnBothFeetBetweenStepsAndLiftsTheSwingingFoot) {
  for (const test::Motion& m : test::motions("walk")) {
    int both = 0, steps = 0;
    double highest = 0.0;
    const std::size_t begin = 15, end = m.frames() - 20;
    for (std::size_t t = begin; t < end; ++t) {
      double low[2] = {1e9, 1e9};
      for (std::size_t i = 0; i < 12; ++i) low[i / 6] = std::min(low[i / 6], m.sole[t][i].z());
      ASSERT_LT(std::min(low[0], low[1]), 1e-6);
      const double swinging = std::max(low[0], low[1]);
      if (swinging > 1e-4) {
        highest = std::max(highest, swinging);
      } else {
        ++both;
        if (highest > 0.0) {  // a step has ended
          ++steps;
          EXPECT_GT(highest, 0.03);
        }
        highest = 0.0;
      }
    }
    EXPECT_GE(steps, 5);
    EXPECT_GE(both, steps);
  }
}

TEST(Walk, SwingsTheArmsAgainstTheLegs) {
  for (const test::Motion& m : test::motions("walk")) {
    const Vector3d forward = rotation_z(heading_angle(m.poses[0].q_WB[0])) * Vector3d::UnitX();
    double product = 0.0, legs_squared = 0.0, arms_squared = 0.0;
    for (std::size_t t = 0; t < m.frames(); ++t) {
      const double legs = forward.dot(m.joint(t, kLeftAnkle) - m.joint(t, kRightAnkle));
      const double arms = forward.dot(m.joint(t, kLeftWrist) - m.joint(t, kRightWrist));
      product += legs * arms;
      legs_squared += legs * legs;
      arms_squared += arms * arms;
    }
    EXPECT_LT(product / std::sqrt(legs_squared * arms_squared), -0.9);
    EXPECT_GT(std::sqrt(arms_squared / legs_squared), 0.3);
  }
}

TEST(Squat, GoesDeepTwiceWithItsHeelsOnTheFloor) {
  for (const test::Motion& m : test::motions("squat")) {
    int descents = 0;
    for (std::size_t t = 1; t < m.frames(); ++t) {
      const auto knee = [&](std::size_t i) { return m.clip.rotations[i][kLeftKnee].x(); };
      if (knee(t - 1) < 1.4 && knee(t) >= 1.4) ++descents;
      for (const Vector3d& point : m.sole[t]) ASSERT_LT(std::abs(point.z()), 1e-6);
    }
    EXPECT_EQ(descents, 2);
  }
}

TEST(Wave, RaisesOneHandOverTheHeadAndMovesItSideways) {
  for (const test::Motion& m : test::motions("wave")) {
    int raised[2] = {0, 0}, turns = 0;
    const Vector3d left = m.poses[0].q_WB[0] * Vector3d::UnitX();
    for (std::size_t t = 1; t + 1 < m.frames(); ++t) {
      for (int side : {0, 1})
        if (m.joint(t, kLeftWrist + side).z() > m.joint(t, kHead).z()) ++raised[side];
      const int side = raised[0] > 0 ? 0 : 1;
      const auto aside = [&](std::size_t i) { return left.dot(m.joint(i, kLeftWrist + side)); };
      if ((aside(t + 1) - aside(t)) * (aside(t) - aside(t - 1)) < 0.0) ++turns;
    }
    EXPECT_EQ(std::min(raised[0], raised[1]), 0);
    EXPECT_GT(std::max(raised[0], raised[1]), 30);
    EXPECT_GE(turns, 5);
  }
}

TEST(Stand, SwaysWithoutLeavingItsPlace) {
  for (const test::Motion& m : test::motions("stand")) {
    Vector3d low = m.com(0), high = low;
    for (std::size_t t = 0; t < m.frames(); ++t) {
      low = low.cwiseMin(m.com(t));
      high = high.cwiseMax(m.com(t));
    }
    EXPECT_GT((high - low).head<2>().norm(), 0.01);
    EXPECT_LT((high - low).head<2>().norm(), 0.08);
  }
}

/// Heading of the pelvis at the end, seen from the start, rad.
double turned(const test::Motion& m) {
  const double angle =
      heading_angle(m.poses.back().q_WB[kPelvis]) - heading_angle(m.poses.front().q_WB[kPelvis]);
  return std::remainder(angle, 2.0 * M_PI);
}

TEST(WalkTurn, WalksAroundACorner) {
  for (const test::Motion& m : test::motions("walk_turn")) {
    EXPECT_GT(std::abs(turned(m)), 0.5);
    EXPECT_LT(std::abs(turned(m)), 1.5);
    EXPECT_GT((m.com(m.frames() - 1) - m.com(0)).norm(), 2.0);
  }
}

TEST(TurnInPlace, TurnsFarAndStaysWhereItIs) {
  for (const test::Motion& m : test::motions("turn_in_place")) {
    double path = 0.0;
    for (std::size_t t = 1; t < m.frames(); ++t)
      path += std::abs(std::remainder(
          heading_angle(m.poses[t].q_WB[kPelvis]) - heading_angle(m.poses[t - 1].q_WB[kPelvis]), 2.0 * M_PI));
    EXPECT_GT(path, 1.2);
    for (std::size_t t = 0; t < m.frames(); ++t) EXPECT_LT((m.com(t) - m.com(0)).head<2>().norm(), 0.15);
  }
}

TEST(SideStep, GoesAsideAndFacesAhead) {
  for (const test::Motion& m : test::motions("side_step")) {
    const Vector3d left = m.poses[0].q_WB[kPelvis] * Vector3d::UnitX();
    double farthest = 0.0;
    for (std::size_t t = 0; t < m.frames(); ++t) {
      const Vector3d moved = m.com(t) - m.com(0);
      farthest = std::max(farthest, std::abs(left.dot(moved)));
      EXPECT_LT(std::abs(Vector3d::UnitZ().cross(left).dot(moved)), 0.08);
    }
    EXPECT_GT(farthest, 0.3);
    EXPECT_LT(std::abs(turned(m)), 1e-6);
  }
}

TEST(Kick, BringsOneFootUpAndFarAhead) {
  for (const test::Motion& m : test::motions("kick")) {
    const Vector3d forward = rotation_z(heading_angle(m.poses[0].q_WB[kPelvis])) * Vector3d::UnitX();
    double reach = 0.0;
    for (std::size_t t = 0; t < m.frames(); ++t)
      for (int side : {0, 1}) {
        const Vector3d from_other = m.joint(t, kLeftAnkle + side) - m.joint(t, kRightAnkle - side);
        if (from_other.z() > 0.2) reach = std::max(reach, forward.dot(from_other));
      }
    EXPECT_GT(reach, 0.35);
  }
}

TEST(Punch, StretchesBothArmsOutAtShoulderHeight) {
  for (const test::Motion& m : test::motions("punch")) {
    Array<int, 2> reached{};
    for (std::size_t t = 0; t < m.frames(); ++t)
      for (int side : {0, 1}) {
        const Vector3d arm = m.joint(t, kLeftWrist + side) - m.joint(t, kLeftShoulder + side);
        if (arm.norm() > 0.42 && std::abs(arm.z()) < 0.2) ++reached[side];
      }
    EXPECT_GT(std::min(reached[0], reached[1]), 0);
  }
}

TEST(Lunge, BendsTheFrontKneeOverALongStep) {
  for (const test::Motion& m : test::motions("lunge")) {
    double deepest = 0.0;
    for (std::size_t t = 0; t < m.frames(); ++t) {
      const double apart = (m.joint(t, kLeftAnkle) - m.joint(t, kRightAnkle)).norm();
      const auto& r = m.clip.rotations[t];
      if (apart > 0.5) deepest = std::max(deepest, std::min(r[kLeftKnee].x(), r[kRightKnee].x()));
    }
    EXPECT_GT(deepest, 1.0);
  }
}

TEST(Bow, LowersTheHeadByHalfTheTrunk) {
  for (const test::Motion& m : test::motions("bow")) {
    double lowest = 1e9;
    for (std::size_t t = 0; t < m.frames(); ++t) lowest = std::min(lowest, m.joint(t, kHead).z());
    const double trunk = m.joint(0, kHead).z() - m.joint(0, kPelvis).z();
    EXPECT_LT(lowest, m.joint(0, kHead).z() - 0.25 * trunk);
  }
}

TEST(Dance, StepsAndMovesItsArms) {
  for (const test::Motion& m : test::motions("dance")) {
    double raised = 0.0, travelled = 0.0;
    for (std::size_t t = 1; t < m.frames(); ++t) {
      for (int side : {0, 1})
        raised = std::max(raised, m.joint(t, kLeftWrist + side).z() - m.joint(t, kPelvis).z());
      travelled += (m.joint(t, kLeftAnkle) - m.joint(t - 1, kLeftAnkle)).norm();
    }
    EXPECT_GT(raised, 0.2);
    EXPECT_GT(travelled, 0.3);
  }
}

TEST(Jog, IsFasterThanAWalk) {
  for (const test::Motion& m : test::motions("jog")) {
    const std::size_t middle = m.frames() / 2;
    EXPECT_GT((m.com(middle + 12) - m.com(middle - 12)).norm() / (24 * test::kDt), 1.25);
  }
}

}  // namespace
}  // namespace mimicx::synth
