/// The lamp's shadows on the solids: a shadow map (L. Williams, "Casting curved shadows on curved surfaces",
/// SIGGRAPH 1978), averaged over several cells (percentage-closer filtering).
#pragma once

#include "render/solid.h"

namespace mimicx::render {

class LampShadow {
 public:
  /// @param to_lamp  direction to the distant lamp, unit length
  LampShadow(const List<Solid>& solids, const Vector3d& to_lamp);

  /// Share of the lamp's light that reaches a place of a solid, 0 to 1. @param normal  outward, unit length
  float light_at(const Vector3d& p, const Vector3d& normal) const;

 private:
  Matrix3d R_LW_;           ///< world → lamp: x, y across its light, z towards it
  double x0_ = 0, y0_ = 0;  ///< the corner of the first cell, m
  int width_ = 0, height_ = 0;
  List<float> nearest_;  ///< [height · width] largest z of the solids, m
};

}  // namespace mimicx::render
