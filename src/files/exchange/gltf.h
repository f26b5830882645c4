/// A skinned motion as glTF 2.0, for Blender, game engines and web viewers.
///
/// y up, metres; (x, y, z) of our world is glTF's (x, z, −y). Joints are nodes of the names in `kBodyNames`;
/// the bind pose is the T-pose on the floor. There is one animation with a key per frame: rotations of all
/// joints as quaternions, each with the sign nearer to the key before, and the position of the pelvis.
///
/// With arrows, there is a node per foot, and one for the rest of the body where that touches the floor: an
/// arrow from the centre of pressure along the floor's force, 1 mm per newton. Its keys are midway between
/// the frames, because the recorded forces are means over these intervals. Without a force its scale is zero.
#pragma once

#include <string>

#include "files/floor_forces.h"
#include "skin/mesh.h"

namespace mimicx::files {

/// @param mesh    skin of the clip's character @param arrows  forces to draw; null: none
/// @return the bytes of a .glb
std::string format_glb(const motion::Clip& clip, const skin::Mesh& mesh, const RecordedForces* arrows);

}  // namespace mimicx::files
