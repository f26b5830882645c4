/// A pinhole camera, and its placement such that all given points are in the picture.
///
/// Camera axes: x to the right of the picture, y down, z away from the camera. (0, 0) is the upper left
/// corner of the picture; pixels are squares.
#pragma once

#include "core/containers.h"
#include "core/so3.h"

namespace mimicx::render {

struct Camera {
  Matrix3d R_CW = Matrix3d::Identity();  ///< world → camera
  Vector3d p_WC = Vector3d::Zero();      ///< position, m
  double focal = 1.0;                    ///< focal length, pixels
  Eigen::Vector2d centre{0, 0};          ///< principal point, pixels

  /// World → camera frame, m.
  Vector3d seen(const Vector3d& p_W) const { return R_CW * (p_W - p_WC); }
  /// Camera frame → pixels. @param p_C  in front of the camera: z > 0
  Eigen::Vector2d projected(const Vector3d& p_C) const { return centre + focal / p_C.z() * p_C.head<2>(); }
  /// The direction of the ray through a place of the picture, world; its z in the camera's frame is 1.
  Vector3d ray(double u, double v) const {
    return R_CW.transpose() * Vector3d((u - centre.x()) / focal, (v - centre.y()) / focal, 1.0);
  }
};

/// The viewing direction of a camera.
struct Look {
  double azimuth = 0;       ///< direction from the scene to the camera, rad from world x
  double elevation = 0.17;  ///< of the camera above the horizon, rad, less than π/2
};

/// R_CW of a camera of that viewing direction whose vertical is upright.
Matrix3d axes_of(const Look& look);

/// Width and height of a picture, and the free margins at its edges, pixels.
struct Canvas {
  int width = 0, height = 0;
  double beside = 0;  ///< free to the left and to the right
  double above = 0;   ///< free above and below
};

/// Field of view of the longer side of a picture, rad: that of a portrait lens.
inline constexpr double kFieldOfView = 0.5;

/// The nearest camera of that viewing direction that has all points inside the canvas, centred either
/// horizontally or vertically. @param points  at least one, world, m
Camera framing(const List<Vector3d>& points, const Look& look, const Canvas& canvas);

/// Width over height of the points in that viewing direction, seen from far away.
double aspect_of(const List<Vector3d>& points, const Look& look);

}  // namespace mimicx::render
