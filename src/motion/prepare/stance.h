/// Stance: which parts of the feet stand, frame by frame.
///
/// Heel, ball and toes of a foot are decided each for themselves: a foot that strikes with its heel or pushes
/// off with its toes stands with that part alone. A part begins to stand when it is low and slow, and goes on
/// as long as it is not clearly high or fast (hysteresis), so that noise does not lift it for single frames.
/// A foot that stands goes on standing where an estimate moves it to another place at once.
///
/// What it does not do: only the floor and the plates of the scene carry feet; a motion must have been put on
/// them (floor_correction.h).
#pragma once

#include "motion/reference.h"

namespace mimicx::motion {

/// World positions of the points of the soles, m (character.h).
using SolePositions = Array<Vector3d, kFootPoints>;
SolePositions sole_positions(const Character& character, const BodyPoses& poses);

/// Which points of the soles stand in a frame (character.h).
using Stance = Array<bool, kFootPoints>;

/// A part begins to stand under 25 mm, 0.10 m/s over the floor and 0.04 m/s up or down, and ends over 35 mm,
/// 0.15 or 0.06 m/s; it stands for three frames or not at all. Both points of a part have the same answer.
PerFrame<Stance> find_stance(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                             const Scene& scene = {});

/// Who stands on one foot can move it only by a hop, and no leg moves a foot from rest to rest by 30 mm
/// within 1/30 s. An estimate that does so is wrong, and the foot stands on: a point that stands before and
/// after at most `longest` frames stands in them, too, if the floor carries the body, the point is below 50
/// mm and moves by less than 100 mm, and if the other foot does not stand meanwhile or most of the way is
/// made within 1/30 s.
/// @param points   [frames], m
/// @param carried  [frames] whether the floor carries the body
void stand_through_jumps(const PerFrame<SolePositions>& points, const PerFrame<bool>& carried, double fps,
                         int longest, const Scene& scene, PerFrame<Stance>& stance);

}  // namespace mimicx::motion
