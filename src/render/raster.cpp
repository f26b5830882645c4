#include "render/raster.h"

#include <cmath>

namespace mimicx::render {

GridPoint on_grid(const Eigen::Vector2d& p) {
  const auto round = [](double x) {
    return static_cast<std::int64_t>(
        std::floor(static_cast<double>(kSubSteps) * std::clamp(x, -kGridLimit, kGridLimit) + 0.5));
  };
  return {round(p.x()), round(p.y())};
}

std::int64_t twice_area(const GridTriangle& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
}

}  // namespace mimicx::render
