/// How much of a light of some size reaches each place of the floor z = 0.
///
/// The light is cut into up to 32 far away points. Each throws the solids onto the floor as a mask of square
/// cells, and a place gets the share of the points that see it: shadows are sharp where a body touches the
/// floor and soften with its height, as they do under a lamp. The part of a solid under the floor throws
/// none.
#pragma once

#include <cstdint>

#include "render/solid.h"

namespace mimicx::render {

inline constexpr int kLightPoints = 32;  ///< as many as a mask has bits

/// Directions to the points of a round light, unit length, upward.
/// @param middle  direction to its middle @param radius  as a share of its distance
List<Vector3d> round_light(const Vector3d& middle, double radius);
/// Directions to a bright sky, as a level floor is lit by it: denser overhead by the cosine. Nothing below
/// some 25° over the horizon.
List<Vector3d> sky_light();

class FloorShadow {
 public:
  /// @param light  at most kLightPoints directions @param cell  edge of the cells, m
  FloorShadow(const List<Solid>& solids, const List<Vector3d>& light, double cell);

  /// From 0, all dark, to 1; between the cells' middles linear.
  float light_at(double x, double y) const;

 private:
  double cell_, x0_ = 0, y0_ = 0;  ///< the corner of the first cell, m
  int width_ = 0, height_ = 0;
  List<float> share_;  ///< [height · width], each cell the mean of itself and its eight neighbours
};

}  // namespace mimicx::render
