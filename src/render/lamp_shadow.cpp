#include "render/lamp_shadow.h"

#include <cmath>
#include <limits>

#include "render/raster.h"

namespace mimicx::render {
namespace {

constexpr double kCell = 0.006;  ///< m
constexpr double kLift = 0.012;  ///< offset along the normal before the look-up, m: two cells
constexpr int kReach = 2;        ///< cells to each side of the filter: edges are 3 cm wide

}  // namespace

LampShadow::LampShadow(const List<Solid>& solids, const Vector3d& to_lamp) {
  const Vector3d side = to_lamp.unitOrthogonal();
  R_LW_ << side.transpose(), to_lamp.cross(side).transpose(), to_lamp.transpose();
  Eigen::AlignedBox2d box;
  for (const Solid& solid : solids)
    for (const Vector3d& p : solid.vertices) box.extend((R_LW_ * p).head<2>());
  if (box.isEmpty()) return;
  x0_ = box.min().x() - kCell;
  y0_ = box.min().y() - kCell;
  width_ = static_cast<int>(std::ceil(box.sizes().x() / kCell)) + 2;
  height_ = static_cast<int>(std::ceil(box.sizes().y() / kCell)) + 2;
  nearest_.assign(width_ * height_, std::numeric_limits<float>::lowest());
  for (const Solid& solid : solids) {
    List<Vector3d> seen;
    List<GridPoint> corners;
    for (const Vector3d& p : solid.vertices) {
      seen.push_back(R_LW_ * p);
      corners.push_back(on_grid((seen.back().head<2>() - Eigen::Vector2d(x0_, y0_)) / kCell));
    }
    for (const skin::Triangle& t : solid.triangles)
      for_each_sample({corners[t[0]], corners[t[1]], corners[t[2]]}, width_, height_,
                      [&](int x, int y, const Vector3d& w) {
                        float& nearest = nearest_[y * width_ + x];
                        nearest = std::max(nearest,
                                           static_cast<float>(w[0] * seen[t[0]].z() + w[1] * seen[t[1]].z() +
                                                              w[2] * seen[t[2]].z()));
                      });
  }
}

float LampShadow::light_at(const Vector3d& p, const Vector3d& normal) const {
  const Vector3d p_L = R_LW_ * (p + kLift * normal);
  const int x = static_cast<int>(std::floor((p_L.x() - x0_) / kCell));
  const int y = static_cast<int>(std::floor((p_L.y() - y0_) / kCell));
  int dark = 0;
  for (int j = y - kReach; j <= y + kReach; ++j)
    for (int i = x - kReach; i <= x + kReach; ++i)
      dark += i >= 0 && j >= 0 && i < width_ && j < height_ &&
              nearest_[j * width_ + i] > static_cast<float>(p_L.z() + kLift);
  constexpr int kCells = (2 * kReach + 1) * (2 * kReach + 1);
  return 1.0F - static_cast<float>(dark) / static_cast<float>(kCells);
}

}  // namespace mimicx::render
