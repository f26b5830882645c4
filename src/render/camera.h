/// A pinhole camera, and where it has to stand to see all that it shall see.
///
/// Camera axes: x to the right of the picture, y down, z away from the camera. The picture is as wide and as
/// high as the caller says; (0, 0) is its upper left corner, pixels are squares.
#pragma once

#include "core/containers.h"
#include "core/so3.h"

namespace mimicx::render {

struct Camera {
  Matrix3d R_CW = Matrix3d::Identity();  ///< world → camera
  Vector3d p_WC = Vector3d::Zero();      ///< where it stands, m
  double focal = 1.0;                    ///< distance of the picture, in its pixels
  Eigen::Vector2d centre{0, 0};          ///< where the optical axis meets the picture

  /// In the camera's frame, m.
  Vector3d seen(const Vector3d& p_W) const { return R_CW * (p_W - p_WC); }
  /// On the picture. @param p_C  before the camera: z > 0
  Eigen::Vector2d projected(const Vector3d& p_C) const { return centre + focal / p_C.z() * p_C.head<2>(); }
  /// The direction in which a place of the picture is seen, world, z of the camera's frame 1.
  Vector3d ray(double u, double v) const {
    return R_CW.transpose() * Vector3d((u - centre.x()) / focal, (v - centre.y()) / focal, 1.0);
  }
};

/// How a camera looks, wherever it stands.
struct Look {
  double azimuth = 0;       ///< the camera stands this way of what it sees, rad from world x
  double elevation = 0.17;  ///< and so far above the horizon, rad, less than a quarter turn
};

/// Axes of a camera that looks so and keeps the vertical upright.
Matrix3d axes_of(const Look& look);

/// Width and height of a picture, and what must stay free at its edges, pixels.
struct Canvas {
  int width = 0, height = 0;
  double beside = 0;  ///< free to the left and to the right
  double above = 0;   ///< free above and below
};

/// The angle that the longer side of a picture opens.
inline constexpr double kFieldOfView = 0.5;  // rad: a mild tele lens, as portraits are taken

/// The nearest camera of that look that has all points inside the canvas, and in the middle of it one way or
/// the other. @param points  at least one, world, m
Camera framing(const List<Vector3d>& points, const Look& look, const Canvas& canvas);

/// Width over height of the points as that look sees them from far away.
double aspect_of(const List<Vector3d>& points, const Look& look);

}  // namespace mimicx::render
