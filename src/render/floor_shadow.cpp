#include "render/floor_shadow.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/elementary.h"
#include "render/raster.h"

namespace mimicx::render {
namespace {

/// Point k of n that cover the unit disc evenly: H. Vogel's sunflower, Math. Biosciences 44 (1979).
Eigen::Vector2d on_disc(int k, int n) {
  const double angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
  return std::sqrt((k + 0.5) / n) * Eigen::Vector2d(cos(angle), sin(angle));
}

/// The projection of a point onto the floor along the light, in cells.
Eigen::Vector2d thrown(const Vector3d& p, const Vector3d& to_light) {
  return p.head<2>() - std::max(p.z(), 0.0) / to_light.z() * to_light.head<2>();
}

}  // namespace

List<Vector3d> round_light(const Vector3d& middle, double radius) {
  const Vector3d side = middle.unitOrthogonal(), other = middle.cross(side);
  List<Vector3d> directions;
  for (int k = 0; k < kLightPoints; ++k) {
    const Eigen::Vector2d d = radius * on_disc(k, kLightPoints);
    directions.push_back((middle + d.x() * side + d.y() * other).normalized());
  }
  return directions;
}

List<Vector3d> sky_light() {
  constexpr double kReach = 0.9;  // radius on the unit disc, the hemisphere seen from above
  List<Vector3d> directions;
  for (int k = 0; k < kLightPoints; ++k) {
    const Eigen::Vector2d d = kReach * on_disc(k, kLightPoints);
    directions.push_back({d.x(), d.y(), std::sqrt(1.0 - d.squaredNorm())});
  }
  return directions;
}

FloorShadow::FloorShadow(const List<Solid>& solids, const List<Vector3d>& light, double cell) : cell_(cell) {
  if (light.empty() || light.count() > kLightPoints)
    throw std::invalid_argument("FloorShadow: 1 to 32 directions of light");
  Eigen::AlignedBox2d box;
  for (const Solid& solid : solids)
    for (const Vector3d& p : solid.vertices)
      for (const Vector3d& to_light : light) box.extend(thrown(p, to_light));
  if (box.isEmpty()) return;
  x0_ = box.min().x() - 2.0 * cell;
  y0_ = box.min().y() - 2.0 * cell;
  width_ = static_cast<int>(std::ceil(box.sizes().x() / cell)) + 4;
  height_ = static_cast<int>(std::ceil(box.sizes().y() / cell)) + 4;
  List<std::uint32_t> masks(width_ * height_, 0U);
  for (const Solid& solid : solids)
    for (int k = 0; k < light.count(); ++k) {
      List<GridPoint> corners;
      corners.reserve(solid.vertices.size());
      for (const Vector3d& p : solid.vertices)
        corners.push_back(on_grid((thrown(p, light[k]) - Eigen::Vector2d(x0_, y0_)) / cell));
      for (const skin::Triangle& t : solid.triangles)  // the front faces throw the whole shadow
        for_each_sample({corners[t[0]], corners[t[1]], corners[t[2]]}, width_, height_,
                        [&](int x, int y, const Vector3d&) { masks[y * width_ + x] |= 1U << k; });
    }
  share_.assign(width_ * height_, 1.0F);
  for (int y = 1; y + 1 < height_; ++y)
    for (int x = 1; x + 1 < width_; ++x) {
      int dark = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) dark += std::popcount(masks[(y + dy) * width_ + x + dx]);
      share_[y * width_ + x] = 1.0F - static_cast<float>(dark) / static_cast<float>(9 * light.count());
    }
}

float FloorShadow::light_at(double x, double y) const {
  const double u = (x - x0_) / cell_ - 0.5, v = (y - y0_) / cell_ - 0.5;
  if (!(u >= 0.0 && v >= 0.0 && u < width_ - 1 && v < height_ - 1)) return 1.0F;
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const auto a = static_cast<float>(u - i), b = static_cast<float>(v - j);
  const float* row = &share_[j * width_ + i];
  const float* next = row + width_;
  return (1.0F - b) * ((1.0F - a) * row[0] + a * row[1]) + b * ((1.0F - a) * next[0] + a * next[1]);
}

}  // namespace mimicx::render
