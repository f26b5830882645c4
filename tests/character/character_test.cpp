#include "character/character.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "core/random.h"
#include "core/random_cases.h"
#include "core/units.h"

namespace mimicx {
namespace {

using Betas = std::array<double, kBetas>;

Betas random_betas(Random& random, double bound) {
  Betas betas;
  for (double& b : betas) b = random.uniform(-bound, bound);
  return betas;
}

PerBody<Quaterniond> rest_rotations() {
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  return q;
}

int mirror_of(int body) {
  const std::string name(kBodyNames[body]);
  if (name.starts_with("left_")) return body_of_name("right_" + name.substr(5));
  if (name.starts_with("right_")) return body_of_name("left_" + name.substr(6));
  return body;
}

Vector3d mirrored(const Vector3d& v) { return {-v.x(), v.y(), v.z()}; }

/// Gap between two capsules. The distance from a point of one axis to the other axis is a convex function of
/// the point's place, so a golden-section search finds its minimum.
double capsule_gap(const Capsule& a, const Vector3d& pa, const Capsule& b, const Vector3d& pb) {
  const Vector3d along = b.b_B - b.a_B;
  const auto distance = [&](double s) {
    const Vector3d x = pa + a.a_B + s * (a.b_B - a.a_B) - pb - b.a_B;
    return (x - std::clamp(x.dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm();
  };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 40; ++k) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    (distance(left) < distance(right) ? high : low) = distance(left) < distance(right) ? right : left;
  }
  return distance(0.5 * (low + high)) - a.radius - b.radius;
}

TEST(Character, DegreesOfFreedomAddUpTo55) {
  int dofs = 0;
  for (int i = 1; i < kBodies; ++i) {
    EXPECT_EQ(first_dof(i), dofs);
    EXPECT_LT(kParents[i], i);
    dofs += is_hinge(i) ? 1 : 3;
  }
  EXPECT_EQ(dofs, 55);
}

TEST(Character, StandardBodyWeighs70KgAndMassesArePositive) {
  EXPECT_NEAR(make_character().total_mass(), 70.0, 1e-9);
  Random random(1, {1});
  for (int n = 0; n < 20; ++n) {
    const Character c = make_character(random_betas(random, 3.0));
    EXPECT_NEAR(std::accumulate(c.mass.begin(), c.mass.end(), 0.0), c.total_mass(), 1e-9);
    for (const double m : c.mass) EXPECT_GT(m, 0.0);
  }
}

TEST(Character, LeftIsTheMirrorImageOfRight) {
  Random random(1, {2});
  for (int n = 0; n < 10; ++n) {
    const Character c = make_character(random_betas(random, 3.0));
    for (int i = 0; i < kBodies; ++i) {
      const int m = mirror_of(i);
      EXPECT_LT((mirrored(c.joint_offset[i]) - c.joint_offset[m]).norm(), 1e-12) << i;
      EXPECT_NEAR(c.mass[i], c.mass[m], 1e-12);
      EXPECT_LT((mirrored(c.com_B[i]) - c.com_B[m]).norm(), 1e-12);
      const Matrix3d S = Vector3d(-1, 1, 1).asDiagonal();
      EXPECT_LT((S * c.inertia_B[i] * S - c.inertia_B[m]).norm(), 1e-12) << i;
      if (i > 0) {
        EXPECT_EQ(c.joint[i].kp, c.joint[m].kp);
        EXPECT_EQ(c.joint[i].torque_limit, c.joint[m].torque_limit);
        // Under the mirror rotations about y and z change sign; a hinge's component does so with its axis.
        const Vector3d centre = c.joint[i].centre;
        if (!is_hinge(i)) {
          EXPECT_LT((Vector3d(centre.x(), -centre.y(), -centre.z()) - c.joint[m].centre).norm(), 1e-12) << i;
        }
      }
    }
  }
}

TEST(Character, JointPositionsAreAffineInBeta) {
  Random random(1, {3});
  for (int n = 0; n < 20; ++n) {
    const Betas a = random_betas(random, 2.0), b = random_betas(random, 2.0);
    Betas mix;
    for (std::size_t k = 0; k < kBetas; ++k) mix[k] = 0.3 * a[k] + 0.7 * b[k];
    const auto at = [](const Betas& betas) {
      return forward_kinematics(make_character(betas), Vector3d::Zero(), rest_rotations()).p_WB;
    };
    const auto pa = at(a), pb = at(b), pm = at(mix);
    for (int i = 0; i < kBodies; ++i) EXPECT_LT((0.3 * pa[i] + 0.7 * pb[i] - pm[i]).norm(), 1e-12);
  }
}

TEST(Character, EveryBetaChangesTheShapeAndLargeBetasAreRejected) {
  const Character standard = make_character();
  for (std::size_t k = 0; k < kBetas; ++k) {
    Betas betas{};
    betas[k] = 1.0;
    const Character c = make_character(betas);
    double change = 0.0;
    for (int i = 0; i < kBodies; ++i)
      change +=
          (c.joint_offset[i] - standard.joint_offset[i]).norm() + std::abs(c.mass[i] - standard.mass[i]);
    EXPECT_GT(change, 1e-3) << k;
    betas[k] = 5.1;
    EXPECT_THROW(make_character(betas), std::invalid_argument);
    betas[k] = std::nan("");
    EXPECT_THROW(make_character(betas), std::invalid_argument);
  }
}

/// Smallest gap of all self pairs in the rest pose, with or without the pair of thighs, which end 1 mm short
/// of the middle in every shape.
double smallest_gap(const Character& c, bool with_thighs = true) {
  const BodyPoses rest = forward_kinematics(c, Vector3d::Zero(), rest_rotations());
  double smallest = 1e9;
  for (const auto& [i, j] : c.self_pairs) {
    if (!with_thighs && i == kLeftHip && j == kRightHip) continue;
    smallest = std::min(smallest, capsule_gap(c.capsule[i], rest.p_WB[i], c.capsule[j], rest.p_WB[j]));
  }
  return smallest;
}

/// The smallest gap, except the thighs', that coordinate descent over β in ±3 finds from a start.
double narrowest_gap_near(Betas betas) {
  double best = smallest_gap(make_character(betas), false);
  for (bool better = true; better;) {
    better = false;
    for (double& beta : betas) {
      const double kept = beta;
      double best_value = kept;
      for (double value = -3.0; value <= 3.0; value += 1.0) {
        beta = value;
        const double gap = smallest_gap(make_character(betas), false);
        if (gap < best - 1e-12) {
          best = gap;
          best_value = value;
          better = true;
        }
      }
      beta = best_value;
    }
  }
  return best;
}

// Every corner of β in ±3, random shapes between them, and the result of a search for the smallest gap.
TEST(Character, SelfPairsAreApartInTheRestPoseForEveryShape) {
  for (unsigned corner = 0; corner < 1U << kBetas; ++corner) {
    Betas betas;
    for (std::size_t k = 0; k < kBetas; ++k) betas[k] = (corner >> k & 1U) != 0U ? 3.0 : -3.0;
    EXPECT_GT(smallest_gap(make_character(betas)), 0.0) << "corner " << corner;
  }
  Random random(1, {4});
  for (int n = 0; n < test::random_cases(10000); ++n)
    EXPECT_GT(smallest_gap(make_character(random_betas(random, 3.0))), 0.0);
  double narrowest = 1.0;
  for (int n = 0; n < 10; ++n) narrowest = std::min(narrowest, narrowest_gap_near(random_betas(random, 3.0)));
  std::printf("  measured: narrowest gap of self pairs but the thighs in the rest pose %.1f mm\n",
              kMm * narrowest);
  EXPECT_GT(narrowest, 0.0);
}

/// Distance from the trunk's middle line at which a hand in front of it is stopped at this height, m.
double nearest_hand(const Character& c, const BodyPoses& rest, double height) {
  const double hand = c.capsule[kLeftWrist].radius;
  double nearest = 0.0;
  for (const auto& [i, j] : c.self_pairs) {
    if (i != kLeftWrist || (j != kPelvis && j != kSpine1 && j != kSpine2 && j != kSpine3)) continue;
    const Capsule& trunk = c.capsule[j];
    const double reach = trunk.radius + hand;
    const double up = height - (rest.p_WB[j] + trunk.a_B).y();
    if (std::abs(up) < reach) nearest = std::max(nearest, std::sqrt(reach * reach - up * up));
  }
  return nearest;
}

TEST(Character, SelfPairsLeaveNoGapInTheTrunkForAHand) {
  Random random(1, {8});
  for (int n = 0; n < 100; ++n) {
    const Character c = make_character(random_betas(random, 2.0));
    const BodyPoses rest = forward_kinematics(c, Vector3d::Zero(), rest_rotations());
    for (double height = 0.0; height < rest.p_WB[kSpine3].y(); height += 0.005)
      EXPECT_GT(nearest_hand(c, rest, height), 0.6 * c.capsule[kSpine1].radius) << height;
  }
}

TEST(Character, InertiaIsThatOfASolidCapsule) {
  const Character c = make_character();
  Random random(1, {5});
  for (const int body : {kHead, kPelvis, kLeftWrist}) {
    const Capsule& capsule = c.capsule[body];
    const Vector3d low = capsule.a_B.cwiseMin(capsule.b_B).array() - capsule.radius;
    const Vector3d high = capsule.a_B.cwiseMax(capsule.b_B).array() + capsule.radius;
    Vector3d centre = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
    int inside = 0;
    while (inside < 100000) {  // Monte Carlo over the bounding box
      Vector3d p;
      for (int k = 0; k < 3; ++k) p[k] = random.uniform(low[k], high[k]);
      const Vector3d d = capsule.b_B - capsule.a_B;
      const double t = std::clamp((p - capsule.a_B).dot(d) / d.squaredNorm(), 0.0, 1.0);
      if ((p - capsule.a_B - t * d).norm() > capsule.radius) continue;
      ++inside;
      centre += p;
      second += p * p.transpose();
    }
    centre /= inside;
    second = second / inside - centre * centre.transpose();
    const Matrix3d inertia = c.mass[body] * (second.trace() * Matrix3d::Identity() - second);
    const Matrix3d& I = c.inertia_B[body];
    EXPECT_LT((inertia - I).norm(), 0.015 * I.norm()) << body;
    if (body == kPelvis) continue;  // whose centre is elsewhere
    EXPECT_LT((centre - c.com_B[body]).norm(), 0.002) << body;
  }
}

// D. A. Winter, "Biomechanics and Motor Control of Human Movement" (4th ed.), table 4.1, after Dempster, who
// cut bodies elsewhere than de Leva's sources. What an outstretched limb is to its joint hardly depends on
// the cut: mass, place of the centre and radius of gyration about the joint of a whole leg are .161, .447 and
// .560, of an arm with its hand .050, .530 and .645, in masses of the body and in distances from hip to ankle
// and from shoulder to wrist.
TEST(Character, LegsAndArmsSwingAsThoseOfPeople) {
  const Character c = make_character();
  const BodyPoses rest = forward_kinematics(c, Vector3d::Zero(), rest_rotations());
  struct Limb {
    std::vector<int> bodies;
    Vector3d axis;
    double mass, centre, gyration;
  };
  for (const Limb& limb :
       {Limb{{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}, Vector3d::UnitX(), 0.161, 0.447, 0.560},
        Limb{{kLeftShoulder, kLeftElbow, kLeftWrist}, Vector3d::UnitZ(), 0.050, 0.530, 0.645}}) {
    const Vector3d root = rest.p_WB[limb.bodies[0]];
    const double length = (rest.p_WB[limb.bodies[2]] - root).norm();
    double inertia = 0.0;
    Vector3d moment = Vector3d::Zero();
    for (const int i : limb.bodies) {
      const Vector3d arm = rest.p_WB[i] + c.com_B[i] - root;
      moment += c.mass[i] * arm;
      inertia += limb.axis.dot(c.inertia_B[i] * limb.axis) + c.mass[i] * limb.axis.cross(arm).squaredNorm();
    }
    const double m = c.total_mass() * limb.mass;
    EXPECT_NEAR(moment.norm() / (m * length * limb.centre), 1.0, 0.1) << limb.bodies[0];
    EXPECT_NEAR(inertia / (m * std::pow(length * limb.gyration, 2)), 1.0, 0.1) << limb.bodies[0];
  }
}

// R. Dumas, L. Chèze and J.-P. Verriest (J. Biomech. 40 (2007), table 2), means of both sexes.
TEST(Character, CentresOfTrunkAndLegsAreBehindTheirLines) {
  const Character c = make_character();
  const BodyPoses rest = forward_kinematics(c, Vector3d::Zero(), rest_rotations());
  // How far the centre of mass of a body is behind the line between two points. At rest people face +z.
  const auto behind = [&](int body, const Vector3d& from, const Vector3d& to) {
    const Vector3d away = (rest.p_WB[body] + c.com_B[body] - from).cross((to - from).normalized());
    EXPECT_NEAR(away.norm(), std::abs(away.x()), 0.1 * away.norm()) << body;  // hardly to the side
    return away.x() * (to.y() > from.y() ? 1.0 : -1.0);
  };
  const Vector3d hips = 0.5 * (rest.p_WB[kLeftHip] + rest.p_WB[kRightHip]);
  const Vector3d shoulders = 0.5 * (rest.p_WB[kLeftShoulder] + rest.p_WB[kRightShoulder]);
  EXPECT_NEAR(behind(kPelvis, hips, shoulders), 0.011, 0.001);
  for (const int i : {kSpine1, kSpine2, kSpine3}) EXPECT_NEAR(behind(i, hips, shoulders), 0.014, 0.001) << i;
  for (const auto& [body, child, share] : {std::tuple(kLeftHip, kLeftKnee, 0.5 * (0.041 + 0.077)),
                                           std::tuple(kLeftKnee, kLeftAnkle, 0.5 * (0.048 + 0.049))})
    for (const int right : {0, 1})
      EXPECT_NEAR(behind(body + right, rest.p_WB[body + right], rest.p_WB[child + right]),
                  share * c.joint_offset[child + right].norm(), 0.001)
          << body + right;
}

TEST(Character, SolePointsComeFirstAndLieInOnePlane) {
  Random random(1, {6});
  for (int n = 0; n < 10; ++n) {
    const Character c = make_character(random_betas(random, 3.0));
    const BodyPoses rest = forward_kinematics(c, Vector3d::Zero(), rest_rotations());
    const double sole = rest.p_WB[kLeftAnkle].y() + c.contact_points[0].p_B.y();
    for (int i = 0; i < kFootPoints; ++i) {
      const ContactPoint& p = c.contact_points[i];
      EXPECT_TRUE(p.body == (i < 4    ? kLeftAnkle
                             : i < 6  ? kLeftFoot
                             : i < 10 ? kRightAnkle
                                      : kRightFoot))
          << i;
      EXPECT_NEAR((rest.p_WB[p.body] + sole_point(p)).y(), sole, 1e-12) << i;
    }
  }
}

TEST(Character, LowestPositionBoundsEveryPointOfTheSphere) {
  Random random(1, {10});
  const Character c = make_character();
  PerBody<Quaterniond> q;
  for (Quaterniond& turn : q) turn = exp_map(Vector3d(random.normal(), random.normal(), random.normal()));
  const BodyPoses poses = forward_kinematics(c, Vector3d(1.0, 2.0, 3.0), q);
  int as_low = 0;
  for (const ContactPoint& point : c.contact_points) {
    const int body = point.body;
    const Vector3d lowest = lowest_position(point, poses);
    EXPECT_GE(lowest.z(), lowest_contact(c, poses));
    as_low += lowest.z() == lowest_contact(c, poses);
    const Vector3d centre = poses.p_WB[body] + poses.q_WB[body] * point.p_B;
    EXPECT_NEAR((lowest - centre).norm(), point.radius, 1e-12);
    for (int k = 0; k < 20; ++k) {
      const Vector3d way(random.normal(), random.normal(), random.normal());
      EXPECT_GE((centre + point.radius * way.normalized()).z(), lowest.z() - 1e-12);
    }
  }
  EXPECT_GE(as_low, 1);
}

TEST(Character, BallOfTheFootStaysOnTheFloorAtEveryHeelHeight) {
  Random random(1, {9});
  for (int n = 0; n < 10; ++n) {
    const Character c = make_character(random_betas(random, 3.0));
    PerBody<Quaterniond> q = rest_rotations();
    q[kLeftAnkle] = exp_map(Vector3d(random.uniform(0.0, 1.0), 0, 0));
    q[kLeftFoot] = q[kLeftAnkle].conjugate();
    const BodyPoses poses = forward_kinematics(c, Vector3d::Zero(), q);
    const auto lowest = [&](const ContactPoint& p) {
      const int i = p.body;
      return (poses.p_WB[i] + poses.q_WB[i] * p.p_B).y() - p.radius;
    };
    const double toe = lowest(c.contact_points[4]);
    EXPECT_GT(lowest(c.contact_points[0]), toe - 1e-12) << "heel";
    for (const int ball : {2, 3}) EXPECT_NEAR(lowest(c.contact_points[ball]), toe, 1e-12);
  }
}

/// Rest joints of a character, its pelvis at the model's.
RestJoints rest_joints(const Character& c) {
  RestJoints joints;
  joints[0] = mimicx::rest_pelvis("mimicx");
  for (int i = 1; i < kBodies; ++i) joints[i] = joints[kParents[i]] + c.joint_offset[i];
  return joints;
}

TEST(CharacterOfJoints, HasTheGivenBonesAndTheNearestShape) {
  const std::array<double, kBetas> betas = {1.5, 0, -1, 0.5, 1, -0.5, 0.3, 1, 0, 0.4};
  const Character shaped = make_character(betas), made = make_character_of_joints(rest_joints(shaped));
  for (int i = 0; i < kBodies; ++i) EXPECT_LT((made.joint_offset[i] - shaped.joint_offset[i]).norm(), 1e-14);
  // The prior shrinks the shape towards the standard one, but not beyond it.
  EXPECT_GT(made.betas[0], 0.5 * betas[0]);
  EXPECT_LT(made.betas[0], betas[0]);
  EXPECT_NEAR(made.total_mass(), shaped.total_mass(), 0.06 * shaped.total_mass());
  const Character standard = make_character(), same = make_character_of_joints(rest_joints(standard));
  for (std::size_t k = 0; k < kBetas; ++k) EXPECT_NEAR(same.betas[k], 0.0, 1e-9);
  EXPECT_NEAR(same.total_mass(), standard.total_mass(), 1e-9);
}

TEST(CharacterOfJoints, RejectsBonesOfImpossibleLength) {
  for (const double factor : {0.1, 4.0, std::numeric_limits<double>::quiet_NaN()}) {
    RestJoints joints = rest_joints(make_character());
    joints[kLeftKnee] = joints[kLeftHip] + factor * (joints[kLeftKnee] - joints[kLeftHip]);
    EXPECT_THROW(make_character_of_joints(joints), std::invalid_argument) << factor;
  }
}

TEST(ForwardKinematics, EqualsTheProductOfHomogeneousMatrices) {
  Random random(1, {7});
  const Character c = make_character(random_betas(random, 2.0));
  PerBody<Quaterniond> q;
  for (Quaterniond& r : q)
    r = Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
  const Vector3d root(0.3, -2.0, 1.1);
  const BodyPoses poses = forward_kinematics(c, root, q);
  for (int body = 0; body < kBodies; ++body) {
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    for (int i = static_cast<int>(body); i >= 0; i = kParents[i]) {
      Eigen::Matrix4d step = Eigen::Matrix4d::Identity();
      step.topLeftCorner<3, 3>() = q[i].toRotationMatrix();
      step.topRightCorner<3, 1>() = i == 0 ? root : c.joint_offset[i];
      T = step * T;
    }
    EXPECT_LT((T.topRightCorner<3, 1>() - poses.p_WB[body]).norm(), 1e-12) << body;
    EXPECT_LT((T.topLeftCorner<3, 3>() - poses.q_WB[body].toRotationMatrix()).norm(), 1e-12) << body;
  }
}

TEST(RestPelvis, KnowsTheModelsAndRejectsOthers) {
  EXPECT_LT((mimicx::rest_pelvis("smpl") - Vector3d(-0.002, -0.223, 0.028)).norm(), 1e-12);
  EXPECT_EQ(mimicx::rest_pelvis("mimicx"), mimicx::rest_pelvis("smplx"));
  EXPECT_THROW(mimicx::rest_pelvis("ghum"), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx
