/// A motion and the scene it is to stand on: the constant shift that puts standing feet on the floor or on
/// plates, and whether the two belong together.
#pragma once

#include <string>

#include "motion/clip.h"

namespace mimicx::import {

/// Feet that hardly move stand on the floor or on a plate. Of the shifts that put a low, middle or high one
/// of them on the floor or a plate, the one that leaves slow feet nearest to the ground; 0 where the motion
/// as it is leaves them within a centimetre of that. Preparation does the rest.
/// @return height to add, m; 0 for a flat scene
double scene_lift(const motion::Clip& clip);

/// A warning where no point of the body comes near any plate of the clip's scene; else empty.
std::string scene_doubt(const motion::Clip& clip);

}  // namespace mimicx::import
