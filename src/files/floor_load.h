/// What the floor does to each foot and to the rest of a body, of recorded wrenches.
///
/// Wrenches (n_i; f_i) about the bodies' joint centres p_i, world axes, sum to f = Σ f_i and, about the
/// world's origin, n = Σ n_i + p_i × f_i. The point of the floor z = 0 about which n has no horizontal part
/// is the centre of pressure (P. Sardain, G. Bessonnet, IEEE Trans. Syst. Man Cybern. A 34 (2004), §II):
///     x = −n_y / f_z,  y = n_x / f_z.
#pragma once

#include "character/character.h"

namespace mimicx::files {

/// What carries the body: feet with their toes, and everything else.
enum Carrier : int { kOnRightFoot, kOnLeftFoot, kOnTheRest };
inline constexpr int kCarriers = 3;
Carrier carrier_of(int body);

/// Upward force under which there is no telling where it acts, N.
inline constexpr double kLeastLoad = 1.0;

/// [carrier] (moment about the world's origin; force), world axes, N·m, N.
/// @param wrenches  (moment; force) about the joint centres, world axes
/// @param joints    the joint centres in world, m
Array<Vector6d, kCarriers> floor_wrenches(const PerBody<Vector6d>& wrenches, const PerBody<Vector3d>& joints);

/// Of a wrench about the world's origin that presses with at least kLeastLoad; z = 0, m.
Vector3d centre_of_pressure(const Vector6d& wrench);

}  // namespace mimicx::files
