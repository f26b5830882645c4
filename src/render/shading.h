/// How light falls on things, and what colour they have.
#pragma once

#include <optional>

#include "render/camera.h"
#include "render/floor_shadow.h"
#include "render/lamp_shadow.h"

namespace mimicx::render {

/// Edge of the floor's checks, m.
inline constexpr double kCheck = 0.5;

/// The light of a scene as its camera sees it.
class Shading {
 public:
  /// @param things  what throws shadows
  Shading(const List<Solid>& things, const Camera& camera);

  /// Light from a place of a solid to the camera. @param normal  unit length
  Colour of_solid(const Vector3d& p, const Vector3d& normal, const Colour& colour) const;
  /// Light from the floor where the ray from the camera meets it; with growing distance from the camera
  /// that of the background.
  Colour of_floor(const Vector3d& p, double distance) const;

 private:
  Vector3d eye_, to_lamp_;
  double far_;  ///< where the floor has half faded, m
  FloorShadow lamp_, sky_;
  LampShadow body_shadow_;
};

/// Behind everything.
Colour background();

}  // namespace mimicx::render
