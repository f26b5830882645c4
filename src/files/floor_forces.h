/// The floor's force on each foot and on the rest of a body: wrench, centre of pressure, free moment.
///
/// Wrenches (n_i; f_i) about the bodies' joint centres p_i, world axes, sum to f = Σ f_i and, about the
/// world's origin, n = Σ n_i + p_i × f_i. The centre of pressure is the point of the ground, at its height h
/// under the carrier, about which n has no horizontal part (P. Sardain, G. Bessonnet, IEEE Trans. Syst. Man
/// Cybern. A 34 (2004), §II):
///     x = (−n_y + h f_x) / f_z,  y = (n_x + h f_y) / f_z.
///
/// Force, centre of pressure and free moment are the whole wrench of the floor: the moment about any point p
/// is (point − p) × force + free_moment · z. A compliant floor carries a foot a little under its surface; the
/// point is where the line of that force meets the surface.
#pragma once

#include "character/character.h"
#include "files/recorded_forces.h"

namespace mimicx::files {

/// The parts of a body that the floor pushes: each foot with its toes, and everything else.
enum Carrier : int { kOnRightFoot, kOnLeftFoot, kOnTheRest };
inline constexpr int kCarriers = 3;
Carrier carrier_of(int body);

/// Under this upward force no centre of pressure is given, N.
inline constexpr double kLeastLoad = 1.0;

/// [carrier] (moment about the world's origin; force), world axes, N·m, N.
/// @param wrenches  (moment; force) about the joint centres, world axes
/// @param joints    the joint centres in world, m
Array<Vector6d, kCarriers> floor_wrenches(const PerBody<Vector6d>& wrenches, const PerBody<Vector3d>& joints);

/// m. @param wrench  about the world's origin, pressing with at least kLeastLoad @param height  of the
/// ground, m
Vector3d centre_of_pressure(const Vector6d& wrench, double height);

/// The point of the ground under a carrier: below the middle of its foot, or below the pelvis, m.
Vector3d ground_under(Carrier carrier, const PerBody<Vector3d>& joints, const Scene& scene);

struct FloorForce {
  Vector3d force = Vector3d::Zero();  ///< on the body, N
  Vector3d point = Vector3d::Zero();  ///< centre of pressure, m; where not loaded, under the carrier
  double free_moment = 0;             ///< about the vertical through the point, N·m
  bool loaded = false;                ///< pressed with at least kLeastLoad
};
using FloorForces = Array<FloorForce, kCarriers>;

/// [frames − 1] one per interval between two frames, with the joint centres midway between the two.
List<FloorForces> floor_forces(const PerFrame<BodyPoses>& poses, const RecordedForces& forces,
                               const Scene& scene);

/// A force of the floor as an arrow at its centre of pressure.
struct FloorArrow {
  Vector3d point = Vector3d::Zero();  ///< m; zero without a force
  Vector3d force = Vector3d::Zero();  ///< N; zero where the floor presses with less than kLeastLoad
};
/// Left foot, right foot (ankle and ball each), all other bodies together.
using FloorArrows = Array<FloorArrow, kCarriers>;

/// @param wrenches  (moment; force) about the joint centres of `poses`, world axes, N·m, N
FloorArrows floor_arrows(const PerBody<Vector6d>& wrenches, const BodyPoses& poses, const Scene& scene);

}  // namespace mimicx::files
