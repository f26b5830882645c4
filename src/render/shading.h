/// Lighting: the colour of solids and floor as the camera sees them.
#pragma once

#include "render/camera.h"
#include "render/floor_shadow.h"
#include "render/lamp_shadow.h"

namespace mimicx::render {

/// Edge of the floor's checks, m.
inline constexpr double kCheck = 0.5;

/// The lights of a scene and their shadows.
class Shading {
 public:
  /// @param things  the solids that throw shadows
  Shading(const List<Solid>& things, const Camera& camera);

  /// Light from a place of a solid to the camera. @param normal  unit length
  Colour of_solid(const Vector3d& p, const Vector3d& normal, const Colour& colour) const;
  /// Light from a place of the floor to the camera; it fades into the background with the distance.
  Colour of_floor(const Vector3d& p, double distance) const;

 private:
  Vector3d eye_, to_lamp_;
  double far_;  ///< distance at which the floor has faded by half, m
  FloorShadow lamp_, sky_;
  LampShadow body_shadow_;
};

/// The colour behind the scene.
Colour background();

}  // namespace mimicx::render
