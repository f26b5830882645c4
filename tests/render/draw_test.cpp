#include "render/draw.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "render/simple_solids.h"

namespace mimicx::render {
namespace {

constexpr int kWidth = 120, kHeight = 90;
const List<Colour> kPaints = {{0.6F, 0, 0}, {0, 0.6F, 0}, {0, 0, 0.6F}};

/// The paint of a pixel: 0, 1, 2; -1 for the greys of floor and sky.
int paint_of(const Pixel& p) {
  const std::array<int, 3> v = {p.r, p.g, p.b};
  for (std::size_t k = 0; k < 3; ++k)
    if (v[k] > 25 + std::max(v[(k + 1) % 3], v[(k + 2) % 3])) return static_cast<int>(k);
  return -1;
}

List<Solid> scattered(int count) {
  Random random(5);
  List<Solid> solids;
  for (int k = 0; k < count; ++k) {
    const Vector3d middle(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(0.1, 1.2));
    std::array<Vector3d, 4> p;
    for (Vector3d& corner : p)
      corner =
          middle + Vector3d(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
    solids.push_back(tetrahedron(p, kPaints[k % 3]));
  }
  return solids;
}

List<Vector3d> all_vertices(const List<Solid>& solids) {
  List<Vector3d> points;
  for (const Solid& solid : solids) points.insert(points.end(), solid.vertices.begin(), solid.vertices.end());
  return points;
}

/// The first solid that the ray hits above the floor, or -1: Möller and Trumbore's test of every triangle.
int first_met(const List<Solid>& solids, const Vector3d& eye, const Vector3d& ray) {
  int met = -1;
  double nearest = 1e300;
  for (int s = 0; s < solids.count(); ++s)
    for (const auto& [i, j, k] : solids[s].triangles) {
      const Vector3d &a = solids[s].vertices[i], ab = solids[s].vertices[j] - a,
                     ac = solids[s].vertices[k] - a;
      const Vector3d n = ray.cross(ac);
      const double det = ab.dot(n), u = (eye - a).dot(n) / det;
      const Vector3d q = (eye - a).cross(ab);
      const double v = ray.dot(q) / det, t = ac.dot(q) / det;
      if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < nearest)) continue;
      if ((eye + t * ray).z() < 0.0) continue;
      nearest = t;
      met = s;
    }
  return met;
}

TEST(Draw, ShowsTheSolidThatTheRayHitsFirst) {
  const List<Solid> solids = scattered(12);
  const Camera camera = framing(all_vertices(solids), {0.7, 0.3}, {kWidth, kHeight, 4, 4});
  const Image image = draw(solids, camera, kWidth, kHeight, 1);
  int decided = 0, of_solids = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      List<int> met;  // if the pixel and its rim agree, no edge crosses it
      for (int j = 0; j <= 4; ++j)
        for (int i = 0; i <= 4; ++i)
          met.push_back(first_met(solids, camera.p_WC, camera.ray(x + 0.3 * i - 0.1, y + 0.3 * j - 0.1)));
      if (std::adjacent_find(met.begin(), met.end(), std::not_equal_to<>()) != met.end()) continue;
      ++decided;
      of_solids += met[0] >= 0 ? 1 : 0;
      ASSERT_EQ(paint_of(image.at(x, y)), met[0] < 0 ? -1 : met[0] % 3) << x << ' ' << y;
    }
  EXPECT_GT(decided, kWidth * kHeight / 2);
  EXPECT_GT(of_solids, kWidth * kHeight / 8);
}

TEST(Draw, BoxHasTheSizeOfItsPerspectiveProjection) {
  Camera camera;
  camera.R_CW = axes_of({0.0, 0.0});
  camera.p_WC = {5, 0, 1};
  camera.focal = 100;
  camera.centre = {0.5 * kWidth, 0.5 * kHeight};
  // The face at 4 m: 100 / 4 pixels per metre, so from 35 to 85 across and from 20 to 45 down.
  const Image image = draw({box({0, -1, 1}, {1, 1, 2}, kPaints[0])}, camera, kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_EQ(paint_of(image.at(x, y)), x >= 35 && x < 85 && y >= 20 && y < 45 ? 0 : -1) << x << ' ' << y;
}

TEST(Draw, EdgesAreSmoothed) {
  Camera camera;
  camera.R_CW = axes_of({0.0, 0.0});
  camera.p_WC = {5, 0, 1};
  camera.focal = 100;
  camera.centre = {60 + 1.0 / 3.0, 45};
  const Image image = draw({box({0, -1, 1}, {1, 1, 2}, kPaints[0])}, camera, kWidth, kHeight, 1);
  const auto red_light = [&](int x) { return light_of(image.at(x, 30)).x(); };
  const float inside = red_light(60), outside = red_light(20);
  EXPECT_NEAR(red_light(35), inside + (outside - inside) / 3.0F, 0.01F) << "one sample in three is outside";
}

TEST(Draw, FloorHidesSolidsBelowIt) {
  const Camera camera = framing({{-1, -1, -0.5}, {1, 1, 1}}, {0.2, 0.5}, {kWidth, kHeight, 0, 0});
  const Image empty = draw({}, camera, kWidth, kHeight, 1);
  const Image sunk =
      draw({box({-0.5, -0.5, -1.0}, {0.5, 0.5, -0.01}, kPaints[1])}, camera, kWidth, kHeight, 1);
  const Image standing =
      draw({box({-0.5, -0.5, -1.0}, {0.5, 0.5, 0.3}, kPaints[1])}, camera, kWidth, kHeight, 1);
  const auto painted = [](const Image& image) {
    return std::count_if(image.pixels.begin(), image.pixels.end(),
                         [](const Pixel& p) { return paint_of(p) == 1; });
  };
  EXPECT_EQ(painted(empty), 0);
  EXPECT_EQ(painted(sunk), 0);
  EXPECT_GT(painted(standing), 100);
}

TEST(Draw, SignsAreVisibleThroughSolidsAndThrowNoShadow) {
  const Camera camera = framing({{-1, -1, 0}, {1, 1, 1}}, {0.2, 0.5}, {kWidth, kHeight, 0, 0});
  const Solid thing = box({-0.5, -0.5, 0.0}, {0.5, 0.5, 0.8}, kPaints[1]);
  Solid sign = box({-0.2, -0.2, 0.2}, {0.2, 0.2, 0.6}, kPaints[0]);
  const auto differ = [](const Image& a, const Image& b) {
    int red = 0, other = 0;
    for (int k = 0; k < a.pixels.count(); ++k)
      if (a.pixels[k] != b.pixels[k]) ++(paint_of(a.pixels[k]) == 0 ? red : other);
    return std::pair(red, other);
  };
  const Image alone = draw({thing}, camera, kWidth, kHeight, 1);
  EXPECT_EQ(draw({thing, sign}, camera, kWidth, kHeight, 1).pixels, alone.pixels)
      << "a thing inside is hidden";
  sign.is_sign = true;
  const auto [red, other] = differ(draw({sign, thing}, camera, kWidth, kHeight, 1), alone);
  EXPECT_GT(red, 50);
  EXPECT_LT(other, red / 4) << "its rim alone";
}

TEST(Draw, PixelsDoNotDependOnTheNumberOfThreads) {
  const List<Solid> solids = scattered(6);
  const Camera camera = framing(all_vertices(solids), {0.7, 0.3}, {kWidth, kHeight, 4, 4});
  const Image one = draw(solids, camera, kWidth, kHeight, 1);
  for (const int threads : {1, 2, 3})
    EXPECT_EQ(draw(solids, camera, kWidth, kHeight, threads).pixels, one.pixels);
  EXPECT_THROW(draw(solids, camera, 0, 10, 1), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::render
