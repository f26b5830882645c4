/// The character as a MuJoCo model, to compare dynamics and speed with an established simulator.
///
/// Same tree, joints, inertias, armature and gravity; every contact point is a sphere that meets a plane and
/// nothing else (a point of the sole gets a sphere of 5 mm that ends in it); PD gains are joint stiffness and
/// damping. Everything that is not said in the file is MuJoCo's default: Euler with implicit damping, Newton
/// solver, pyramidal cones. Torque bounds, ranges and self contact are left out.
#pragma once

#include <string>

#include "physics/model.h"

namespace mimicx {

std::string to_mjcf(const Character& character, const SimulationOptions& options);

}  // namespace mimicx
