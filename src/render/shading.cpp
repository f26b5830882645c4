#include "render/shading.h"

#include <algorithm>
#include <cmath>

namespace mimicx::render {
namespace {

constexpr float kLampLight = 0.85F, kSkyLight = 0.62F;  ///< on white paper that faces them
constexpr float kEarthLight = 0.22F;                    ///< from the floor, on surfaces that face down
constexpr double kLampRadius = 0.10;                    ///< as a share of its distance
constexpr double kLampCell = 0.01, kSkyCell = 0.03;     ///< of their shadows on the floor, m

/// Direction to the lamp: up, left of the camera and behind it.
Vector3d lamp_of(const Camera& camera) {
  const Vector3d right = camera.R_CW.row(0), away = camera.R_CW.row(2);
  const Vector3d level = Vector3d(away.x(), away.y(), 0).normalized();
  return (1.25 * Vector3d::UnitZ() - 0.75 * right - 0.55 * level).normalized();
}

/// x³² by squaring: powers differ between libraries.
float to_the_32nd(float x) {
  for (int k = 0; k < 5; ++k) x *= x;
  return x;
}

}  // namespace

Colour background() { return {0.86F, 0.89F, 0.92F}; }

Shading::Shading(const List<Solid>& things, const Camera& camera)
    : eye_(camera.p_WC),
      to_lamp_(lamp_of(camera)),
      far_(std::max(3.0 * camera.p_WC.z(), 1.6 * camera.p_WC.z() / std::max(0.05, -camera.R_CW(2, 2)))),
      lamp_(things, round_light(to_lamp_, kLampRadius), kLampCell),
      sky_(things, sky_light(), kSkyCell),
      body_shadow_(things, to_lamp_) {}

Colour Shading::of_solid(const Vector3d& p, const Vector3d& normal, const Colour& colour) const {
  const auto facing = static_cast<float>(normal.dot(to_lamp_));
  const float reach = facing > 0.0F ? body_shadow_.light_at(p, normal) : 0.0F;
  const auto up = static_cast<float>(0.5 + 0.5 * normal.z());
  const float light =
      kLampLight * reach * std::max(facing, 0.0F) + kSkyLight * up + kEarthLight * (1.0F - up);
  const Vector3d half = (to_lamp_ + (eye_ - p).normalized()).normalized();
  const float shine = 0.10F * reach * to_the_32nd(std::max(static_cast<float>(normal.dot(half)), 0.0F));
  return light * colour + Colour::Constant(shine);
}

Colour Shading::of_floor(const Vector3d& p, double distance) const {
  const auto cell =
      static_cast<long>(std::floor(p.x() / kCheck)) + static_cast<long>(std::floor(p.y() / kCheck));
  const Colour paint = (cell & 1) != 0 ? Colour(0.52F, 0.54F, 0.56F) : Colour(0.68F, 0.70F, 0.72F);
  const float lamp = lamp_.light_at(p.x(), p.y()), sky = sky_.light_at(p.x(), p.y());
  const Colour lit = (kLampLight * static_cast<float>(to_lamp_.z()) * lamp + kSkyLight * sky) * paint;
  const double ratio = distance / far_;
  const auto fade = static_cast<float>(1.0 / (1.0 + ratio * ratio * ratio * ratio));
  return fade * lit + (1.0F - fade) * background();
}

}  // namespace mimicx::render
