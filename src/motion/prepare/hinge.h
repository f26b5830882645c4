/// Knees and elbows as hinges: SMPL's rotations, changed so that the skeleton's hinge joints can follow them.
///                                                                            docs/method.md, "Hinges"
///
/// What it does not do: no joint limits, no change of bones. A limb cannot be straighter than its bones at
/// rest allow, which is about 8° for a leg and 5° for an arm.
#pragma once

#include "character/character.h"

namespace mimicx::motion {

/// SMPL rotations → joint rotations whose knees and elbows turn about `hinge_axis` alone. The hinge's angle
/// and the rotation of the joint above it are solved again so that both bones point where they did; the body
/// below the hinge keeps its orientation in the world. Ankles and wrists stay in place for every limb the
/// hinge can reach. A limb that is bent by less than 30° keeps its continuity instead: its knee or elbow
/// moves by millimetres. A joint that is a hinge already stays as it is.
/// @param smpl  [frames][22] joint rotations relative to the parent; entry 0: root in world
PerFrame<PerBody<Quaterniond>> to_hinges(const Character& character,
                                         const PerFrame<PerBody<Quaterniond>>& smpl);

}  // namespace mimicx::motion
