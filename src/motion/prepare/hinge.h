/// Knees and elbows as hinges: SMPL's rotations, changed so that the skeleton's hinge joints can follow them.
///                                                                            docs/method.md, "Hinges"
///
/// What it does not do: no joint limits, no change of bones. A limb cannot be straighter than its bones at
/// rest allow, which is about 8° for a leg and 5° for an arm.
#pragma once

#include "character/character.h"

namespace mimicx::motion {

/// SMPL rotations → joint rotations whose knees and elbows turn about `hinge_axis` only. The hinge's angle
/// and the rotation of the joint above it are solved again so that both bones keep their directions; the body
/// below the hinge keeps its orientation in the world. Ankles and wrists keep their positions where the hinge
/// can reach them. A limb bent by less than 30° stays continuous instead: its knee or elbow moves by
/// millimetres. A joint that is already a hinge stays unchanged.
/// @param smpl  [frames][22] joint rotations relative to the parent; entry 0: root in world
PerFrame<PerBody<Quaterniond>> to_hinges(const Character& character,
                                         const PerFrame<PerBody<Quaterniond>>& smpl);

}  // namespace mimicx::motion
