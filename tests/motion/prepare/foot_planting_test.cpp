// Standing feet become one place on the floor.
#include "motion/prepare/foot_planting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "motion/prepare/prepare.h"
#include "motion/prepare/stance.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

Reference exact(const std::string& kind) {
  return prepare_reference(test::synthetic_clip(kind, 3), {}, nullptr);
}

PerFrame<Stance> stance_of(const Reference& reference) {
  return find_stance(reference.character, reference.poses, reference.fps);
}

void move_pelvis(Reference& reference, const std::function<Vector3d(int)>& by) {
  for (int t = 0; t < reference.size(); ++t) {
    reference.frames[t].p_root += by(t);
    reference.poses[t] =
        forward_kinematics(reference.character, reference.frames[t].p_root, reference.frames[t].q);
  }
}

/// Largest height and largest horizontal step of the standing points, m.
struct Faults {
  double height = 0, slip = 0;
};
Faults faults_of(const PerFrame<Stance>& stance, const Reference& reference) {
  Faults worst;
  SolePositions before;
  for (int t = 0; t < reference.size(); ++t) {
    const SolePositions p = sole_positions(reference.character, reference.poses[t]);
    for (int k = 0; k < kFootPoints; ++k) {
      if (!stance[t][k]) continue;
      worst.height = std::max(worst.height, std::abs(p[k].z()));
      if (t > 0 && stance[t - 1][k]) worst.slip = std::max(worst.slip, (p[k] - before[k]).head<2>().norm());
    }
    before = p;
  }
  return worst;
}

double largest_distance(const Reference& a, const Reference& b) {
  double largest = 0.0;
  for (int t = 0; t < a.size(); ++t)
    for (int body = 0; body < kBodies; ++body)
      largest = std::max(largest, (a.poses[t].p_WB[body] - b.poses[t].p_WB[body]).norm());
  return largest;
}

TEST(FootPlanting, PlantedMotionStaysUnchanged) {
  for (const char* kind : {"walk", "squat", "stand"}) {
    Reference reference = exact(kind);
    const Reference before = reference;
    EXPECT_LT(plant_feet(stance_of(before), reference), 0.002) << kind;
    EXPECT_LT(largest_distance(before, reference), 0.002) << kind;
  }
}

// Somebody stands with the toes 3 cm in the side of a step.
TEST(FootPlanting, MovesStandingFeetOutOfTheSideOfAStep) {
  Reference reference = exact("stand");
  const PerFrame<Stance> stance = stance_of(reference);
  const Vector3d ahead = (reference.poses[0].q_WB[kPelvis] * Vector3d::UnitZ()).normalized();
  double front = -1.0;
  for (const Vector3d& p : sole_positions(reference.character, reference.poses[0]))
    front = std::max(front, p.dot(ahead));
  const Vector3d middle = reference.poses[0].p_WB[kPelvis];
  const double from_middle = front - middle.dot(ahead) - 0.03;
  reference.scene.plates.push_back({.centre = middle.head<2>() + (0.3 + from_middle) * ahead.head<2>(),
                                    .yaw = std::atan2(ahead.y(), ahead.x()),
                                    .half_extents = {0.3, 1.0},
                                    .height = 0.17});
  const auto deepest = [&] {
    double most = 0.0;
    for (const BodyPoses& pose : reference.poses)
      for (const Vector3d& p : sole_positions(reference.character, pose))
        most = std::max(most, reference.scene.way_out(p, 0.0).depth);
    return most;
  };
  EXPECT_GT(deepest(), 0.025);
  plant_feet(stance, reference);
  EXPECT_LT(deepest(), 0.003);
  const Faults faults = faults_of(stance, reference);
  EXPECT_LT(faults.height, 0.003);
  EXPECT_LT(faults.slip, 0.001);
}

// The whole body hovers 15 mm over the floor and drifts sideways by 60 mm/s.
TEST(FootPlanting, PutsHoveringAndSlidingFeetOnOnePlace) {
  for (const char* kind : {"walk", "squat"}) {
    const Reference truth = exact(kind);
    const PerFrame<Stance> stance = stance_of(truth);
    Reference reference = truth;
    move_pelvis(reference, [](int t) { return Vector3d(0.0, 0.02 * std::sin(0.1 * t), 0.015); });
    const Faults before = faults_of(stance, reference);
    const double moved = plant_feet(stance, reference);
    const Faults after = faults_of(stance, reference);
    EXPECT_GT(before.height, 0.014) << kind;
    EXPECT_GT(before.slip, 0.0018) << kind;
    EXPECT_LT(after.height, 0.003) << kind;
    EXPECT_LT(after.slip, 0.0008) << kind;
    EXPECT_LT(moved, 0.06) << kind;
    EXPECT_LT(largest_distance(truth, reference), 0.05) << kind;
  }
}

// Clearance is for feet that swing. One that keeps it up to its stance lands a frame late.
TEST(FootPlanting, FeetLandAndLeaveWhenTheyDid) {
  for (const char* kind : {"walk", "jog"}) {
    const Reference before = exact(kind);
    const PerFrame<Stance> stance = stance_of(before);
    Reference reference = before;
    move_pelvis(reference, [](int) { return Vector3d(0, 0, 0.008); });
    plant_feet(stance, reference);
    const auto lowest = [](const Reference& r, int t, int side) {
      const SolePositions p = sole_positions(r.character, r.poses[t]);
      double z = 1e9;
      for (int k = 0; k < kPointsPerFoot; ++k) z = std::min(z, p[side * kPointsPerFoot + k].z());
      return z;
    };
    const auto stands = [&](int t, int side) {
      const auto* first = stance[t].begin() + side * kPointsPerFoot;
      return std::find(first, first + kPointsPerFoot, true) != first + kPointsPerFoot;
    };
    int changes = 0;
    for (int side : {0, 1})
      for (int t = 1; t + 1 < before.size(); ++t) {
        if (stands(t, side) || stands(t - 1, side) == stands(t + 1, side)) continue;
        ++changes;
        EXPECT_LT(lowest(reference, t, side), lowest(before, t, side) + 0.006) << kind << " " << t;
      }
    EXPECT_GT(changes, 8) << kind;
  }
}

TEST(FootPlanting, TrunkArmsAndHeadKeepTheirRotations) {
  Reference reference = exact("walk");
  const Reference before = reference;
  move_pelvis(reference, [](int t) { return Vector3d(0.0, 0.02 * std::sin(0.1 * t), 0.015); });
  plant_feet(stance_of(before), reference);
  for (int t = 0; t < reference.size(); ++t)
    for (int body : {kPelvis, kSpine1, kSpine3, kHead, kLeftShoulder, kRightElbow})
      EXPECT_TRUE(reference.frames[t].q[body].isApprox(before.frames[t].q[body], 0.0)) << t << ", " << body;
}

// A person kneels upright, and the toes hover: to lower them must not push the knees through the floor.
TEST(FootPlanting, KneesOfAKneelingPersonStayOutOfTheFloor) {
  Reference reference = exact("stand");
  const auto lowest = [&](const BodyPoses& poses, bool toes) {
    double low = 1.0;
    for (const ContactPoint& point : reference.character.contact_points)
      if (point.body == (toes ? kRightFoot : kRightKnee))
        low = std::min(low, lowest_position(point, poses).z());
    return low;
  };
  for (int t = 0; t < reference.size(); ++t) {
    ReferenceFrame& frame = reference.frames[t];
    for (const int knee : {kLeftKnee, kRightKnee}) frame.q[knee] = exp_map(2.12 * hinge_axis(knee));
    frame.p_root.z() -= lowest(forward_kinematics(reference.character, frame.p_root, frame.q), false);
    reference.poses[t] = forward_kinematics(reference.character, frame.p_root, frame.q);
  }
  EXPECT_NEAR(lowest(reference.poses[40], true), 0.09, 0.01);
  PerFrame<Stance> stance(reference.frames.size(), Stance{});
  for (Stance& stands : stance)
    for (int k = 0; k < kFootPoints; ++k) {
      const int body = reference.character.contact_points[k].body;
      stands[k] = body == kLeftFoot || body == kRightFoot;
    }
  plant_feet(stance, reference);
  EXPECT_NEAR(lowest(reference.poses[40], true), 0.0, 0.002);
  for (const BodyPoses& poses : reference.poses) EXPECT_GT(lowest(poses, false), -0.002);
}

// An estimate carries a jumping body on at 2 m/s until it lands, and its feet with it, 4 mm over the floor.
TEST(FootPlanting, LandingFeetBrakeBeforeTheyTouch) {
  Reference reference = exact("jump");
  const PerFrame<Stance> stance = stance_of(reference);
  const auto flies = [&](int t) { return std::count(stance[t].begin(), stance[t].end(), true) == 0; };
  int start = 0;
  while (!flies(start)) ++start;
  int landing = start;
  while (flies(landing)) ++landing;
  ASSERT_GT(landing - start, 5);
  move_pelvis(reference, [&](int t) {
    return Vector3d(2.0 * (std::clamp(t, start, landing) - start) / reference.fps, 0.0, 0.004);
  });
  const auto way = [&](int t) {  // of the points that land, m
    const SolePositions before = sole_positions(reference.character, reference.poses[t - 1]),
                        p = sole_positions(reference.character, reference.poses[t]);
    double longest = 0.0;
    for (int k = 0; k < kFootPoints; ++k)
      if (stance[landing][k]) longest = std::max(longest, (p[k] - before[k]).head<2>().norm());
    return longest;
  };
  const double fast = way(landing);
  ASSERT_GT(fast, 0.055);
  plant_feet(stance, reference);
  EXPECT_LT(way(landing), 0.6 * fast);
  EXPECT_LT(way(landing), way(landing - 1));
  EXPECT_LT(faults_of(stance, reference).slip, 0.0008);
}

// The right foot of a person who stands is dragged 0.3 m forward over the floor within half a second.
TEST(FootPlanting, ADraggedFootSteps) {
  Reference reference = exact("stand");
  const int first = 20, last = 35;
  const auto lowest = [&](const BodyPoses& poses) {
    const SolePositions p = sole_positions(reference.character, poses);
    double low = 1.0;
    for (int k = kPointsPerFoot; k < kFootPoints; ++k) low = std::min(low, p[k].z());
    return low;
  };
  const auto share = [&](int t) { return std::clamp(double(t - first) / (last - first), 0.0, 1.0); };
  for (int t = 0; t < reference.size(); ++t) {
    const double angle = 0.35 * share(t);  // of the thigh; the pelvis sinks so that the foot stays low
    reference.frames[t].q[kRightHip] = exp_map(Vector3d(-angle, 0, 0)) * reference.frames[t].q[kRightHip];
    reference.frames[t].q[kRightAnkle] = reference.frames[t].q[kRightAnkle] * exp_map(Vector3d(angle, 0, 0));
    const BodyPoses poses =
        forward_kinematics(reference.character, reference.frames[t].p_root, reference.frames[t].q);
    reference.frames[t].p_root.z() -= lowest(poses);
    reference.poses[t] =
        forward_kinematics(reference.character, reference.frames[t].p_root, reference.frames[t].q);
  }
  const PerFrame<Stance> stance = stance_of(reference);
  const int middle = (first + last) / 2;
  ASSERT_LT(lowest(reference.poses[middle]), 1e-9);
  plant_feet(stance, reference);
  EXPECT_GT(lowest(reference.poses[middle]), 0.006);  // of 20 mm, at 0.56 of 1.5 m/s
}

TEST(FootPlanting, LowersAPelvisSmoothly) {
  Reference reference = exact("walk");
  const PerFrame<Stance> stance = stance_of(reference);
  move_pelvis(reference, [](int) { return Vector3d(0.0, 0.0, 0.02); });
  const Reference before = reference;
  plant_feet(stance, reference);
  for (int t = 1; t + 1 < reference.size(); ++t) {
    const auto change = [&](int k) { return reference.frames[k].p_root.z() - before.frames[k].p_root.z(); };
    EXPECT_LT(std::abs(change(t - 1) - 2.0 * change(t) + change(t + 1)), 0.001) << t;
  }
}

}  // namespace
}  // namespace mimicx::motion
