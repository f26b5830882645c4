#include "motion/surface_points.h"

#include <gtest/gtest.h>

#include "motion/made_motions.h"

namespace mimicx::motion {
namespace {

double distance_to_axis(const Capsule& c, const Vector3d& p) {
  const Vector3d d = c.b_B - c.a_B;
  const double t = std::clamp((p - c.a_B).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (p - c.a_B - t * d).norm();
}

TEST(Surface, FeetComeFirstAndEveryOtherPointLiesOnItsCapsule) {
  const Character c = make_character({1, -1, 0.5, 0, 2, 0, 0, 1, 0, 0});
  const auto points = surface_points(c);
  PerBody<int> count{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int body = points[i].body;
    ++count[body];
    if (i < kFootPoints) {
      EXPECT_EQ(points[i].p_B, sole_point(c.contact_points[i]));
    } else {
      EXPECT_NEAR(distance_to_axis(c.capsule[body], points[i].p_B), c.capsule[body].radius, 1e-12);
    }
  }
  for (int i = 0; i < kBodies; ++i) EXPECT_GT(count[i], 1) << kBodyNames[i];
}

TEST(Surface, SolesOfTheStandingCharacterAreTheLowest) {
  const Character c = make_character();
  const BodyPoses pose = poses_of(test::standing_clip(1, test::standing_height()))[0];
  const auto points = surface_points(c);
  EXPECT_NEAR(lowest_height(points, pose), 0.0, 1e-12);
  const auto positions = surface_positions(points, pose);
  for (std::size_t i = 0; i < kFootPoints; ++i) EXPECT_NEAR(positions[i].z(), 0.0, 1e-12);
  for (std::size_t i = kFootPoints; i < positions.size(); ++i) EXPECT_GT(positions[i].z(), 0.005);
}

TEST(Surface, MissesTheLowestPointOfACapsuleByLessThanAnEighthOfItsRadius) {
  const Character c = make_character();
  const auto points = surface_points(c);
  Random random(3, {1});
  for (int n = 0; n < 200; ++n) {
    const Vector3d up = test::random_vector(random).normalized();
    PerBody<double> lowest;
    lowest.fill(1e9);
    for (std::size_t i = kFootPoints; i < points.size(); ++i) {
      double& z = lowest[points[i].body];
      z = std::min(z, up.dot(points[i].p_B));
    }
    for (const Capsule& capsule : c.capsule) {
      const double z = lowest[capsule.body];
      if (z == 1e9) continue;  // ankles and feet have sole points only
      const double exact = std::min(up.dot(capsule.a_B), up.dot(capsule.b_B)) - capsule.radius;
      EXPECT_GE(z, exact - 1e-12);
      EXPECT_LT(z, exact + 0.125 * capsule.radius) << kBodyNames[capsule.body];
    }
  }
}

}  // namespace
}  // namespace mimicx::motion
