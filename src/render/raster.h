/// The samples of a grid that a triangle covers, and their barycentric coordinates.
///
/// Corners are rounded to 1/256 of a sample and coverage is decided in integers, so that triangles with a
/// common edge cover every sample exactly once: a sample on an edge belongs to the triangle below it or to
/// the right of it (the top-left rule: J. Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH
/// 1988, for the edge functions).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/so3.h"

namespace mimicx::render {

/// A place on the grid in 1/256 of a sample; sample (x, y) lies at (256 x + 128, 256 y + 128).
struct GridPoint {
  std::int64_t x = 0, y = 0;
};
inline constexpr std::int64_t kSubSteps = 256;
inline constexpr double kGridLimit = 1 << 20;  ///< samples: no corner lies farther from the origin

/// @param p  in samples; clamped to ± kGridLimit
GridPoint on_grid(const Eigen::Vector2d& p);

/// The corners of a triangle, clockwise on a picture whose y axis points down.
using GridTriangle = std::array<GridPoint, 3>;

/// Twice the triangle's area in (1/256 sample)²; negative for a back-facing triangle.
std::int64_t twice_area(const GridTriangle& t);

/// Calls visit(x, y, w) for every covered sample of a grid of width × height, row by row; w are the weights
/// of the three corners and sum to 1. A back-facing triangle covers no sample.
template <class Visit>
void for_each_sample(const GridTriangle& t, int width, int height, Visit&& visit) {
  const std::int64_t area = twice_area(t);
  if (area <= 0) return;
  const auto first = [](std::int64_t a) { return (a - kSubSteps / 2 + kSubSteps - 1) >> 8; };  // ceil
  const auto last = [](std::int64_t a) { return (a - kSubSteps / 2) >> 8; };                   // floor
  const auto [x_min, x_max] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [y_min, y_max] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto x0 = static_cast<int>(std::max<std::int64_t>(first(x_min), 0));
  const auto y0 = static_cast<int>(std::max<std::int64_t>(first(y_min), 0));
  const auto x1 = static_cast<int>(std::min<std::int64_t>(last(x_max), width - 1));
  const auto y1 = static_cast<int>(std::min<std::int64_t>(last(y_max), height - 1));
  if (x0 > x1 || y0 > y1) return;
  // Edge k lies opposite corner k; its function is 0 on it and twice the area at the corner.
  std::array<std::int64_t, 3> dx, dy, least, row;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint a = t[(k + 1) % 3], b = t[(k + 2) % 3];
    dx[k] = -(b.y - a.y);
    dy[k] = b.x - a.x;
    const bool is_left = b.y < a.y, is_top = b.y == a.y && b.x > a.x;
    least[k] = is_left || is_top ? 0 : 1;
    const std::int64_t px = x0 * kSubSteps + kSubSteps / 2, py = y0 * kSubSteps + kSubSteps / 2;
    row[k] = (px - a.x) * dx[k] + (py - a.y) * dy[k];
  }
  const double scale = 1.0 / static_cast<double>(area);
  for (int y = y0; y <= y1; ++y) {
    std::array<std::int64_t, 3> e = row;
    for (int x = x0; x <= x1; ++x) {
      if (e[0] >= least[0] && e[1] >= least[1] && e[2] >= least[2])
        visit(x, y,
              Vector3d(scale * static_cast<double>(e[0]), scale * static_cast<double>(e[1]),
                       scale * static_cast<double>(e[2])));
      for (std::size_t k = 0; k < 3; ++k) e[k] += kSubSteps * dx[k];
    }
    for (std::size_t k = 0; k < 3; ++k) row[k] += kSubSteps * dy[k];
  }
}

}  // namespace mimicx::render
