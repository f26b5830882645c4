/// The share of an area light that reaches each place of the floor z = 0.
///
/// The light is approximated by up to 32 distant points. Each projects the solids onto the floor as a mask of
/// square cells; the light at a place is the share of points that are visible from it. Shadows are sharp
/// where a body touches the floor and soften with its height. Parts of a solid under the floor throw no
/// shadow.
#pragma once

#include "render/solid.h"

namespace mimicx::render {

inline constexpr int kLightPoints = 32;  ///< the bits of a mask

/// Directions to the points of a round light, unit length, upward.
/// @param middle  direction to its middle @param radius  as a share of its distance
List<Vector3d> round_light(const Vector3d& middle, double radius);
/// Directions to a bright sky, cosine-weighted for a level floor, from about 25° above the horizon up.
List<Vector3d> sky_light();

class FloorShadow {
 public:
  /// @param light  at most kLightPoints directions @param cell  edge of the cells, m
  FloorShadow(const List<Solid>& solids, const List<Vector3d>& light, double cell);

  /// Light from 0 (dark) to 1, interpolated linearly between the centres of cells.
  float light_at(double x, double y) const;

 private:
  double cell_, x0_ = 0, y0_ = 0;  ///< the corner of the first cell, m
  int width_ = 0, height_ = 0;
  List<float> share_;  ///< [height · width] light, smoothed over 3 × 3 cells
};

}  // namespace mimicx::render
