/// The character as a MuJoCo model: for a second engine to simulate, audit and show.
///
/// Same tree, joints, inertias, armature and gravity; every contact point is a sphere that meets the floor
/// and nothing else (a point of the sole gets a sphere of 5 mm that ends in it). Everything that is not said
/// in the file is MuJoCo's default: Euler with implicit damping, Newton solver, pyramidal cones. Torque
/// bounds, ranges and self contact are left out.
///
/// Coordinates (MuJoCo lists joints depth first, so the order is not that of `Body`; the file starts with a
/// comment that gives every joint's place):
///   qpos  pelvis: position in the world, m, then quaternion w x y z, pelvis → world; a ball joint:
///         quaternion w x y z, child → parent; a hinge: angle, rad, positive flexes
///   qvel  pelvis: linear velocity in the world, then angular velocity in the pelvis frame; a ball joint:
///         angular velocity in the child's frame; a hinge: its rate
/// In the rest pose of the file (qpos0) the pelvis frame is parallel to the world's: y, not z, points up the
/// spine. A standing character has the root quaternion (√½, √½, 0, 0).
#pragma once

#include <string>
#include <string_view>

#include "physics/model.h"

namespace mimicx::physics {

struct MjcfConfig {
  bool springs = false;  ///< PD gains as the joints' stiffness and damping, pulling towards the T-pose
  bool shapes = true;    ///< capsules to look at; they collide with nothing
};

/// How every file of ours begins.
inline constexpr std::string_view kMjcfOpening =
    "<!-- joint: first entry of qpos (how many), first entry of qvel (how many)\n";

/// The text of the file.
/// @param scene  its plates become the top faces of boxes, as hard as the floor
std::string to_mjcf(const Character& character, const SimulationConfig& config, const MjcfConfig& what = {},
                    const Scene& scene = {});

/// Bodies in the order of the file, depth first.
PerBody<int> mjcf_order();

}  // namespace mimicx::physics
