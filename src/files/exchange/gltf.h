/// A motion as glTF 2.0, with a skin: what Blender, game engines, web viewers and slides open.
///
/// y up, metres; (x, y, z) of our world is glTF's (x, z, −y). Joints are nodes of the names in `kBodyNames`;
/// at rest they stand in the T-pose on the floor, in which the skin is bound. One animation, a key per frame:
/// rotations of all joints as quaternions that never take the long way round, and the place of the pelvis.
///
/// With arrows, a node per foot, and one for the rest of the body where that touches the floor, is an arrow
/// from the centre of pressure along the force of the floor, a millimetre per newton. Its keys stand in the
/// middle between the frames, where the recorded means are true; without a force it has no size.
#pragma once

#include <string>

#include "files/floor_forces.h"
#include "skin/mesh.h"

namespace mimicx::files {

/// @param mesh    skin of the clip's character @param arrows  forces to draw; null: none
/// @return the bytes of a .glb
std::string format_glb(const motion::Clip& clip, const skin::Mesh& mesh, const RecordedForces* arrows);

}  // namespace mimicx::files
