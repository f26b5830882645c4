#include "core/so3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace mimicx {
namespace {

constexpr double kPi = std::numbers::pi;

Vector3d random_vector(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

Quaterniond random_rotation(Random& random) {
  return Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

/// Matrix exponential of the skew matrix by its power series.
Matrix3d exp_series(const Vector3d& r) {
  Matrix3d K;
  K << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  Matrix3d sum = Matrix3d::Identity(), term = Matrix3d::Identity();
  for (int n = 1; n < 40; ++n) {
    term = term * K / n;
    sum += term;
  }
  return sum;
}

TEST(So3, ExpIsTheMatrixExponential) {
  Random random(1, {1});
  for (const double scale : {1e-12, 1e-7, 1e-4, 0.1, 1.0, 2.0})
    for (int n = 0; n < 20; ++n) {
      const Vector3d r = scale * random_vector(random);
      EXPECT_LT((exp_map(r).toRotationMatrix() - exp_series(r)).norm(), 1e-12) << scale;
    }
}

TEST(So3, LogInvertsExpBelowAHalfTurn) {
  Random random(1, {2});
  for (const double angle : {1e-12, 1e-7, 1e-4, 0.5, 3.0, kPi - 1e-6}) {
    const Vector3d r = angle * random_vector(random).normalized();
    EXPECT_LT((log_map(exp_map(r)) - r).norm(), 1e-9 * std::max(1.0, angle)) << angle;
    const Quaterniond q = exp_map(r), minus(-q.w(), -q.x(), -q.y(), -q.z());
    EXPECT_LT((log_map(minus) - r).norm(), 1e-9) << "the other sign of the same rotation";
  }
  EXPECT_EQ(log_map(Quaterniond::Identity()), Vector3d::Zero());
}

TEST(So3, LogTakesTheShorterWay) {
  Random random(1, {3});
  for (int n = 0; n < 200; ++n) EXPECT_LE(log_map(random_rotation(random)).norm(), kPi + 1e-12);
}

TEST(So3, Rotation6dIsTheFirstTwoColumns) {
  Random random(1, {4});
  const Quaterniond q = random_rotation(random);
  const Vector6d six = rotation_6d(q);
  EXPECT_LT((six.head<3>() - q * Vector3d::UnitX()).norm(), 1e-14);
  EXPECT_LT((six.tail<3>() - q * Vector3d::UnitY()).norm(), 1e-14);
}

TEST(So3, TwistIsAboutTheAxisAndSwingAcrossIt) {
  Random random(1, {5});
  for (int n = 0; n < 100; ++n) {
    const Quaterniond q = random_rotation(random);
    const Vector3d axis = random_vector(random).normalized();
    const Quaterniond twist = twist_about(q, axis), swing = q * twist.conjugate();
    EXPECT_LT((twist * axis - axis).norm(), 1e-12);
    EXPECT_NEAR(log_map(swing).dot(axis), 0.0, 1e-9);
    EXPECT_LT((swing * twist).angularDistance(q), 1e-7);
  }
}

TEST(So3, AngleBetweenMatchesRotationBetween) {
  Random random(1, {6});
  for (int n = 0; n < 100; ++n) {
    const Vector3d a = random_vector(random), b = random_vector(random);
    const Quaterniond turn = rotation_between(a, b);
    EXPECT_LT((turn * a.normalized() - b.normalized()).norm(), 1e-12);
    EXPECT_NEAR(log_map(turn).norm(), angle_between(a, b), 1e-12);
    EXPECT_NEAR(log_map(turn).dot(a), 0.0, 1e-12);  // no twist about the start
    EXPECT_EQ(turn.coeffs(), Quaterniond::FromTwoVectors(a, b).coeffs()) << "what Eigen makes of it";
    const Quaterniond half = rotation_between(a, -2.0 * a);
    EXPECT_LT((half * a + a).norm(), 1e-6 * a.norm());
  }
  for (const double angle : {0.0, 1e-9, kPi - 1e-9, kPi})
    EXPECT_NEAR(angle_between(Vector3d::UnitX(), {3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0}), angle,
                1e-15);
}

TEST(So3, HeadingTurnsWithTheWorldsVertical) {
  const Quaterniond standing = exp_map(kPi / 2 * Vector3d::UnitX());  // y up to z up
  const double before = heading_angle(standing);
  for (const double turn : {-2.0, 0.3, 3.0})
    EXPECT_NEAR(std::remainder(heading_angle(rotation_z(turn) * standing) - before - turn, 2 * kPi), 0.0,
                1e-12);
  EXPECT_NEAR(before, -kPi / 2, 1e-12);  // model z, the way the character looks, is world -y
  // Lying on the back the body looks straight up: then its y axis says where it points.
  EXPECT_NEAR(heading_angle(rotation_z(0.7)), 0.7 + kPi / 2, 1e-12);
}

}  // namespace
}  // namespace mimicx
