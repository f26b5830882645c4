// Heights of the ground under points.
#include "character/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/random.h"
#include "core/units.h"

namespace mimicx {
namespace {

Plate plate(double x, double y, double yaw, double half_x, double half_y, double height) {
  return {.centre = {x, y}, .yaw = yaw, .half_extents = {half_x, half_y}, .height = height};
}

TEST(Scene, WithoutPlatesIsTheFloor) {
  EXPECT_TRUE(Scene().flat());
  EXPECT_EQ(Scene().height_under({1.0, 2.0, 3.0}), 0.0);
  EXPECT_EQ(Scene().clearance({1.0, 2.0, -0.3}), -0.3);
}

TEST(Scene, PlateIsARectangleThatTurnsWithItsYaw) {
  const Scene scene{{plate(1.0, -2.0, 0.7, 0.3, 0.1, 0.25)}};
  Random random(5, {});
  int on = 0;
  for (int k = 0; k < 500; ++k) {
    const double u = 0.4 * random.normal(), v = 0.4 * random.normal();  // in the plate's axes
    const Vector3d p = Vector3d(1.0, -2.0, 0.3) + rotation_z(0.7) * Vector3d(u, v, 0.0);
    const bool inside = std::abs(u) <= 0.3 && std::abs(v) <= 0.1;
    EXPECT_EQ(scene.height_under(p), inside ? 0.25 : 0.0);
    on += inside ? 1 : 0;
  }
  EXPECT_GT(on, 50);
}

// A point more than the reach below the top face is under or beside the box.
TEST(Scene, PlateReachesEightCentimetresDown) {
  const Scene scene{{plate(0, 0, 0, 1, 1, 0.5)}};
  EXPECT_EQ(scene.height_under({0, 0, 0.43}), 0.5);
  EXPECT_EQ(scene.height_under({0, 0, 0.41}), 0.0);
  EXPECT_EQ(scene.height_under({0, 0, 0.41}, 0.12), 0.5);
  EXPECT_NEAR(scene.clearance({0, 0, 0.43}), -0.07, 1e-15);
}

// By brute force: the least of the moves along the sides and up, in steps of 0.1 mm, after which the sphere,
// taken for a cube along the sides, no longer overlaps the box.
TEST(Scene, WayOutOfASideIsTheShortest) {
  const Plate box = plate(0.4, -0.2, 0.9, 0.3, 0.15, 0.5);
  const Vector3d first = rotation_z(0.9) * Vector3d::UnitX(), second = rotation_z(0.9) * Vector3d::UnitY();
  const auto overlaps = [&](const Vector3d& p, double radius) {
    const Vector3d from = rotation_z(-0.9) * (p - Vector3d(0.4, -0.2, 0.0));
    return std::abs(from.x()) < 0.3 + radius && std::abs(from.y()) < 0.15 + radius &&
           p.z() - radius < 0.5 - Scene::kReach && p.z() + radius > 0.5 - Scene::kSides;
  };
  const auto by_force = [&](const Vector3d& p, double radius) {
    for (double way = 0.0;; way += 1e-4)
      for (const Vector3d& to : {first, Vector3d(-first), second, Vector3d(-second),
                                 Vector3d(Vector3d::UnitZ()), Vector3d(-Vector3d::UnitZ())})
        if (!overlaps(p + way * to, radius)) return way;
  };
  Random random(6, {});
  int in = 0;
  for (int k = 0; k < 200; ++k) {
    const Vector3d p =
        Vector3d(0.4, -0.2, 0.3) + 0.15 * Vector3d(random.normal(), random.normal(), random.normal());
    const double radius = 0.02 * (k % 3);
    const WayOut way = Scene{{box}}.way_out(p, radius);
    EXPECT_NEAR(way.depth, by_force(p, radius), 1.1e-4);
    EXPECT_FALSE(overlaps(p + (way.depth + 1e-9) * way.direction, radius));
    in += way.depth > 0.0;
  }
  EXPECT_GT(in, 50);
}

TEST(Scene, OnlyStiffPlatesHaveSides) {
  Scene scene{{plate(0, 0, 0, 1, 1, 0.5)}};
  EXPECT_NEAR(scene.way_out({0.95, 0.0, 0.35}, 0.0).depth, 0.05, 1e-12);
  scene.plates[0].stiffness = 2e4;
  EXPECT_EQ(scene.way_out({0.95, 0.0, 0.35}, 0.0).depth, 0.0);
}

TEST(Scene, ThereIsRoomUnderATable) {
  const Scene table{{plate(0, 0, 0, 1, 1, 0.75)}};
  EXPECT_EQ(table.way_out({0.0, 0.0, 0.45}, 0.04).depth, 0.0);
  EXPECT_NEAR(table.way_out({0.0, 0.0, 0.52}, 0.04).depth, 0.06, 1e-12);
  EXPECT_EQ(table.way_out({0.0, 0.0, 0.52}, 0.04).direction, Vector3d(0.0, 0.0, -1.0));
}

TEST(Scene, PointThatACushionGivesWayToIsOnIt) {
  Scene scene{{plate(0, 0, 0, 1, 1, 0.5)}};
  EXPECT_NEAR(scene.clearance({0, 0, 0.499}), -0.001, 1e-12);
  scene.plates[0].stiffness = 1e4;
  const double give = scene.plates[0].give();
  EXPECT_NEAR(give, 25.0 * kGravity * (1e-4 - 2.5e-6), 1e-12);
  EXPECT_EQ(scene.clearance({0, 0, 0.5 - 0.9 * give}), 0.0);
  EXPECT_NEAR(scene.clearance({0, 0, 0.5 - give - 0.01}), -0.01, 1e-12);
  EXPECT_NEAR(scene.clearance({0, 0, 0.51}), 0.01, 1e-12);
}

TEST(Scene, HighestPlateInReachCounts) {
  const Scene scene{{plate(0, 0, 0, 1, 1, 0.2), plate(0, 0, 0, 1, 1, 0.6), plate(0, 0, 0, 1, 1, 0.4)}};
  EXPECT_EQ(scene.height_under({0, 0, 0.9}), 0.6);
  EXPECT_EQ(scene.height_under({0, 0, 0.45}), 0.4);
  EXPECT_EQ(scene.height_under({0, 0, 0.25}), 0.2);
  EXPECT_EQ(scene.height_under({0, 0, 0.05}), 0.0);
}

TEST(Scene, RefusesImpossiblePlatesNamingTheNumber) {
  const auto fault = [](const Plate& bad) {
    try {
      require_scene({{plate(0, 0, 0, 1, 1, 0.5), bad}}, "file");
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(fault(plate(0, 0, 0, 1, 1, 0.5)), "");
  EXPECT_EQ(fault(plate(0, 0, 0, 1, 1, 0.0)), "file: plate 2: expected a height from 0.01 to 10 m, found 0");
  EXPECT_NE(fault(plate(0, 0, 22.0, 1, 1, 0.5)).find("radians, found 22"), std::string::npos);
  EXPECT_NE(fault(plate(std::numeric_limits<double>::quiet_NaN(), 0, 0, 1, 1, 0.5)), "");
  Plate soft = plate(0, 0, 0, 1, 1, 0.5);
  soft.stiffness = 10.0;
  EXPECT_NE(fault(soft).find("stiffness"), std::string::npos);
  EXPECT_THROW(require_scene({List<Plate>(kMaxPlates + 1, plate(0, 0, 0, 1, 1, 0.5))}, "file"), DataError);
}

}  // namespace
}  // namespace mimicx
