// Shadows on the floor and on solids against plain geometry.
#include <gtest/gtest.h>

#include "render/floor_shadow.h"
#include "render/lamp_shadow.h"
#include "render/simple_solids.h"

namespace mimicx::render {
namespace {

const Colour kGrey(0.5F, 0.5F, 0.5F);

TEST(FloorShadow, ShadowOfAPlateIsThePlateShiftedAlongTheLight) {
  const Solid plate = box({-0.2, -0.1, 0.999}, {0.2, 0.1, 1.0}, kGrey);
  const FloorShadow shadow({plate}, {Vector3d(0.6, 0, 0.8)},
                           0.01);  // moved by 0.6 / 0.8 of its height along -x
  for (double x = -1.5; x < 0.5; x += 0.013)
    for (double y = -0.3; y < 0.3; y += 0.011) {
      const double inside = std::min({x + 0.95, -0.55 - x, y + 0.1, 0.1 - y});
      if (inside > 0.02) {
        ASSERT_EQ(shadow.light_at(x, y), 0.0F) << x << ' ' << y;
      }
      if (inside < -0.02) {
        ASSERT_EQ(shadow.light_at(x, y), 1.0F) << x << ' ' << y;
      }
    }
}

/// Width of the edge of a plate's shadow, from 10 to 90 % of the light, m.
double softness(double height) {
  const FloorShadow shadow({box({-1, -1, height}, {0, 1, height + 0.001}, kGrey)},
                           round_light(Vector3d::UnitZ(), 0.1), 0.004);
  double from = 0.0, to = 0.0;
  for (double x = -0.4; x < 0.4; x += 0.001) {
    if (shadow.light_at(x, 0) < 0.1F) from = x;
    if (shadow.light_at(x, 0) < 0.9F) to = x;
  }
  return to - from;
}

TEST(FloorShadow, SoftensInProportionToHeight) {
  // A disc's share beside a chord at x = ± 0.687 of its radius is 10 and 90 %: 1.374 · 0.1 · height.
  EXPECT_NEAR(softness(0.5), 0.0687, 0.015);
  EXPECT_NEAR(softness(1.5), 0.206, 0.03);
}

TEST(FloorShadow, IsFullyLitWithoutSolidsAndRejectsTooManyLightPoints) {
  EXPECT_EQ(FloorShadow({}, sky_light(), 0.03).light_at(0, 0), 1.0F);
  EXPECT_EQ(FloorShadow({box({-1, -1, -2}, {1, 1, -1}, kGrey)}, {Vector3d::UnitZ()}, 0.03).light_at(50, 50),
            1.0F);
  EXPECT_THROW(FloorShadow({}, List<Vector3d>(33, Vector3d::UnitZ()), 0.03), std::invalid_argument);
}

TEST(FloorShadow, DirectionsAreUnitAndUpward) {
  const Vector3d middle = Vector3d(1, 2, 2) / 3.0;
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& d : round_light(middle, 0.1)) {
    EXPECT_NEAR(d.norm(), 1.0, 1e-12);
    EXPECT_LT(angle_between(d, middle), 0.1);
    sum += d;
  }
  EXPECT_LT(angle_between(sum, middle), 0.01);
  for (const Vector3d& d : sky_light()) {
    EXPECT_NEAR(d.norm(), 1.0, 1e-12);
    EXPECT_GT(d.z(), 0.4);
  }
}

TEST(LampShadow, PlateShadowsTheTableAndNotItself) {
  const Solid table = box({-1, -1, 0}, {1, 1, 0.1}, kGrey),
              plate = box({-0.2, -0.2, 0.6}, {0.2, 0.2, 0.65}, kGrey);
  const LampShadow shadow({table, plate}, Vector3d(0.6, 0, 0.8));
  const Vector3d up = Vector3d::UnitZ();
  for (double x = -0.9; x < 0.9; x += 0.017)
    for (double y = -0.9; y < 0.9; y += 0.019) {
      // The lamp projects the plate's two levels onto the table at 0.1 m: shifted by 0.375 and 0.4125 along
      // -x.
      const double inside = std::min({x + 0.5625, -0.225 - x, y + 0.2, 0.2 - y}),
                   rim = std::min({x + 0.65, -0.15 - x, y + 0.25, 0.25 - y});
      if (inside > 0.05) {
        ASSERT_EQ(shadow.light_at({x, y, 0.1}, up), 0.0F) << x << ' ' << y;
      }
      if (rim < 0.0) {
        ASSERT_EQ(shadow.light_at({x, y, 0.1}, up), 1.0F) << x << ' ' << y;
      }
    }
  for (double x = -0.19; x < 0.19; x += 0.01) EXPECT_EQ(shadow.light_at({x, 0, 0.65}, up), 1.0F);
}

}  // namespace
}  // namespace mimicx::render
