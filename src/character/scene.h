/// The ground of a motion: the floor z = 0 and horizontal plates over it, the top faces of boxes such as
/// stairs, kerbs, chairs and beds.                                                            docs/scenes.md
///
/// A plate carries what is over it or at most `kReach` under its top face. A point that is farther below is
/// beside the box or under it, and the plate is not there for it. Where plates overlap, the highest counts.
///
/// Sides carry nothing. References and plans keep the legs out of those of stiff plates (`way_out`); softer
/// ones are seats and beds, under which feet may be.
///
/// What it does not have: slopes, ground that moves, ground below z = 0.
#pragma once

#include <string>

#include "core/containers.h"
#include "core/so3.h"

namespace mimicx {

/// The top face of a box, a rectangle.
struct Plate {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();        ///< in the world, m
  double yaw = 0.0;                                        ///< of its first side from world x, rad
  Eigen::Vector2d half_extents = Eigen::Vector2d::Zero();  ///< along its first and second side, m
  double height = 0.0;                                     ///< over the floor, m
  double stiffness = 4e5;                                  ///< of a contact point on it, N/m
  double damping = 4e3;                                    ///< of a contact point on it, N·s/m

  bool operator==(const Plate&) const = default;
  /// Whether a point is over, on or under the rectangle; only x and y count.
  bool spans(const Vector3d& p) const;
  /// How much deeper a contact point sinks into it than into the floor, where three points carry a body of
  /// 75 kg, m: 0 of wood, 2.4 cm of a cushion of 10 kN/m.
  double give() const;
};

/// The shortest way of a sphere out of the side of a box.
struct WayOut {
  double depth = 0.0;                     ///< m; 0: it is in no side
  Vector3d direction = Vector3d::Zero();  ///< by depth · direction the sphere has to move
};

struct Scene {
  List<Plate> plates;

  bool operator==(const Scene&) const = default;
  bool flat() const { return plates.empty(); }
  /// The highest plate that spans the point and whose top face is at most `reach` above it; null: the floor.
  const Plate* plate_under(const Vector3d& p, double reach) const;
  /// Height of the ground under a point, m: that plate's, or 0. @param p  in the world, m
  double height_under(const Vector3d& p, double reach) const;
  double height_under(const Vector3d& p) const { return height_under(p, kReach); }
  /// Height of a point over the ground under it, m; negative inside it. A point that is in a soft plate no
  /// deeper than it gives is on it: 0; deeper points count from there.
  double clearance(const Vector3d& p) const { return clearance(p, p); }
  /// The same over the ground under another point, of which p is part.
  double clearance(const Vector3d& p, const Vector3d& above) const;

  /// With the centre's offset (x, y) from the middle of a plate along its sides, half extents a and the top
  /// H,
  ///
  ///     depth = max(0, min(a_x + r − |x|, a_y + r − |y|, H − kReach + r − z, z + r − (H − kSides)))
  ///
  /// of the plate of at least `kSolid` that the sphere is deepest in: to the sides, up, where contact is, or
  /// down: sides are as high as a riser, and there is room under tables and landings.
  /// @param radius  r, m
  WayOut way_out(const Vector3d& centre, double radius) const;

  static constexpr double kReach = 0.08;  ///< m
  static constexpr double kSides = 0.25;  ///< the sides reach so far under the top, m
  static constexpr double kSolid = 1e5;   ///< least stiffness of a box with sides, N/m
};

inline constexpr int kMaxPlates = 64;  ///< of a scene

/// @param name  of the data, for the message
/// @throws DataError naming the plate, for a number out of its range or more than kMaxPlates plates
void require_scene(const Scene& scene, const std::string& name);

}  // namespace mimicx
