#include "render/camera.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/random.h"

namespace mimicx::render {
namespace {

TEST(Camera, ProjectsAsComputedByHand) {
  Camera camera;  // 5 m in front of the origin, looking horizontally along y
  camera.R_CW = axes_of({-0.5 * std::numbers::pi, 0.0});
  camera.p_WC = {0, -5, 1};
  camera.focal = 200;
  camera.centre = {160, 120};
  const Vector3d p_C = camera.seen({1, 0, 1.5});
  EXPECT_TRUE(p_C.isApprox(Vector3d(1, -0.5, 5), 1e-12)) << p_C.transpose();
  EXPECT_TRUE(camera.projected(p_C).isApprox(Eigen::Vector2d(160 + 40, 120 - 20), 1e-12));
}

TEST(Camera, StandsAtTheAzimuthAndLooksDown) {
  const Matrix3d R_CW = axes_of({0.3, 0.2});
  EXPECT_TRUE((R_CW * R_CW.transpose()).isIdentity(1e-12));
  EXPECT_NEAR(R_CW.determinant(), 1.0, 1e-12);
  const Vector3d away = R_CW.row(2), right = R_CW.row(0);
  EXPECT_TRUE(away.isApprox(
      -Vector3d(std::cos(0.2) * std::cos(0.3), std::cos(0.2) * std::sin(0.3), std::sin(0.2)), 1e-12));
  EXPECT_EQ(right.z(), 0.0) << "the horizon is level";
}

TEST(Camera, RayThroughAProjectedPointHitsThePoint) {
  Random random(3);
  const Camera camera = framing({{0, 0, 0}, {1, 2, 3}}, {1.0, 0.4}, {300, 200, 10, 10});
  for (int k = 0; k < 50; ++k) {
    const double u = random.uniform(0, 300), v = random.uniform(0, 200);
    const Vector3d p_C = camera.seen(camera.p_WC + 7.0 * camera.ray(u, v));
    EXPECT_NEAR(p_C.z(), 7.0, 1e-9);
    EXPECT_TRUE(camera.projected(p_C).isApprox(Eigen::Vector2d(u, v), 1e-9));
  }
}

TEST(Camera, FramingFitsAllPointsTightlyIntoTheCanvas) {
  Random random(4);
  for (int trial = 0; trial < 40; ++trial) {
    List<Vector3d> points;
    for (int k = 0; k < 30; ++k)
      points.push_back({random.uniform(-2, 2), random.uniform(-1, 1), random.uniform(0, 2)});
    const Canvas canvas{200 + 10 * trial, 300, 12, 20};
    const Camera camera = framing(points, {random.uniform(-3, 3), random.uniform(-0.1, 0.8)}, canvas);
    Eigen::AlignedBox2d seen;
    for (const Vector3d& p : points) seen.extend(camera.projected(camera.seen(p)));
    const double left = seen.min().x() - canvas.beside, right = canvas.width - canvas.beside - seen.max().x();
    const double top = seen.min().y() - canvas.above, bottom = canvas.height - canvas.above - seen.max().y();
    EXPECT_GE(std::min({left, right, top, bottom}), -1e-6);
    EXPECT_NEAR(std::min(left + right, top + bottom), 0.0, 1e-6) << "no nearer place shows them all";
  }
}

TEST(Camera, FramingRejectsACanvasWithoutRoom) {
  EXPECT_THROW(framing({{0, 0, 0}}, {}, {20, 20, 10, 0}), std::invalid_argument);
  EXPECT_THROW(framing({}, {}, {20, 20, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::render
