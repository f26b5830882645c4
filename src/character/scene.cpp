#include "character/scene.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "core/number_text.h"
#include "core/units.h"

namespace mimicx {
namespace {

constexpr double kPointLoad = 75.0 * kGravity / 3.0;  ///< N

}  // namespace

bool Plate::spans(const Vector3d& p) const {
  const Eigen::Vector2d d = p.head<2>() - centre;
  if (d.squaredNorm() > half_extents.squaredNorm()) return false;
  const double c = cos(yaw), s = sin(yaw);
  return std::abs(c * d.x() + s * d.y()) <= half_extents.x() &&
         std::abs(c * d.y() - s * d.x()) <= half_extents.y();
}

double Plate::give() const { return std::max(0.0, kPointLoad / stiffness - kPointLoad / Plate().stiffness); }

const Plate* Scene::plate_under(const Vector3d& p, double reach) const {
  const Plate* under = nullptr;
  for (const Plate& plate : plates)
    if (p.z() + reach > plate.height && (!under || plate.height > under->height) && plate.spans(p))
      under = &plate;
  return under;
}

double Scene::height_under(const Vector3d& p, double reach) const {
  const Plate* plate = plate_under(p, reach);
  return plate ? plate->height : 0.0;
}

double Scene::clearance(const Vector3d& p, const Vector3d& above) const {
  const Plate* plate = plate_under(above, kReach);
  if (!plate) return p.z();
  const double z = p.z() - plate->height;
  return z < 0.0 ? std::min(0.0, z + plate->give()) : z;
}

WayOut Scene::way_out(const Vector3d& centre, double radius) const {
  WayOut deepest;
  for (const Plate& plate : plates) {
    if (plate.stiffness < kSolid) continue;
    const Vector3d first(cos(plate.yaw), sin(plate.yaw), 0.0), second(-first.y(), first.x(), 0.0);
    const Vector3d from = centre - Vector3d(plate.centre.x(), plate.centre.y(), plate.height - kReach);
    const double x = from.dot(first), y = from.dot(second);
    const WayOut along{plate.half_extents.x() + radius - std::abs(x), x < 0.0 ? Vector3d(-first) : first},
        across{plate.half_extents.y() + radius - std::abs(y), y < 0.0 ? Vector3d(-second) : second},
        up{radius - from.z(), Vector3d::UnitZ()},
        down{radius + from.z() + kSides - kReach, -Vector3d::UnitZ()};
    const WayOut shortest = std::min({along, across, up, down},
                                     [](const WayOut& a, const WayOut& b) { return a.depth < b.depth; });
    if (shortest.depth > deepest.depth) deepest = shortest;
  }
  return deepest;
}

void require_scene(const Scene& scene, const std::string& name) {
  if (scene.plates.count() > kMaxPlates)
    raise(DataError(name, "", "at most " + std::to_string(kMaxPlates) + " plates",
                    std::to_string(scene.plates.count())));
  for (int k = 0; k < scene.plates.count(); ++k) {
    const auto require = [&](double value, double least, double most, const char* what, const char* unit) {
      if (value >= least && value <= most) return;
      raise(DataError(name, "plate " + std::to_string(k + 1),
                      std::string(what) + " from " + text_of(least) + " to " + text_of(most) + ' ' + unit,
                      text_of(value)));
    };
    const Plate& plate = scene.plates[k];
    for (int axis = 0; axis < 2; ++axis) {
      require(plate.centre[axis], -1e4, 1e4, "a centre", "m");
      require(plate.half_extents[axis], 0.01, 1e3, "half extents", "m");
    }
    require(plate.yaw, -7.0, 7.0, "a yaw", "radians");
    require(plate.height, 0.01, 10.0, "a height", "m");
    require(plate.stiffness, 2e3, 1e7, "a stiffness", "N/m");
    require(plate.damping, 1.0, 1e6, "a damping", "N s/m");
  }
}

}  // namespace mimicx
