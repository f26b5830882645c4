#include "render/camera.h"

#include <algorithm>
#include <stdexcept>

#include "core/elementary.h"

namespace mimicx::render {
namespace {

constexpr double kLeastDistance = 0.5;  ///< of the nearest point, m; needed for a single point

/// The camera's place along one axis of the picture at which the outermost points lie on the edges: all
/// points satisfy x ≤ c + tangent (z − d) and −x ≤ −c + tangent (z − d), each with equality for some point.
struct Wedge {
  double centre, depth;  ///< c, d: across and along the optical axis, m
};
Wedge wedge_around(const List<Vector3d>& points, int axis, double tangent) {
  double right = -1e300, left = -1e300;
  for (const Vector3d& p : points) {
    right = std::max(right, p[axis] - tangent * p.z());
    left = std::max(left, -p[axis] - tangent * p.z());
  }
  return {0.5 * (right - left), -0.5 * (right + left) / tangent};
}

}  // namespace

Matrix3d axes_of(const Look& look) {
  const double c = cos(look.elevation), s = sin(look.elevation);
  const Vector3d away = -Vector3d(c * cos(look.azimuth), c * sin(look.azimuth), s);
  const Vector3d right = away.cross(Vector3d::UnitZ()).normalized();
  Matrix3d R_CW;
  R_CW << right.transpose(), away.cross(right).transpose(), away.transpose();
  return R_CW;
}

Camera framing(const List<Vector3d>& points, const Look& look, const Canvas& canvas) {
  const double half_w = 0.5 * canvas.width - canvas.beside, half_h = 0.5 * canvas.height - canvas.above;
  if (points.empty() || half_w <= 0.0 || half_h <= 0.0)
    throw std::invalid_argument("framing: no points, or no room for them");
  Camera camera;
  camera.R_CW = axes_of(look);
  camera.centre = {0.5 * canvas.width, 0.5 * canvas.height};
  camera.focal = std::max(camera.centre.x(), camera.centre.y()) / tan(0.5 * kFieldOfView);
  List<Vector3d> turned;
  double nearest = 1e300;
  for (const Vector3d& p : points) {
    turned.push_back(camera.R_CW * p);
    nearest = std::min(nearest, turned.back().z());
  }
  const Wedge x = wedge_around(turned, 0, half_w / camera.focal);
  const Wedge y = wedge_around(turned, 1, half_h / camera.focal);
  const Vector3d p_C(x.centre, y.centre, std::min({x.depth, y.depth, nearest - kLeastDistance}));
  camera.p_WC = camera.R_CW.transpose() * p_C;
  return camera;
}

double aspect_of(const List<Vector3d>& points, const Look& look) {
  const Matrix3d R_CW = axes_of(look);
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points) box.extend(R_CW * p);
  return box.sizes().x() / std::max(box.sizes().y(), 1e-9);
}

}  // namespace mimicx::render
