/// The ground of a motion from the motion itself: plates where feet stand, and seats, each accepted only if a
/// force is missing without it.                                          docs/scenes.md, "Finding the scene"
///
/// A force is missing at a frame if the wrench that the whole body needs (audit/pose_needs.h) is not what
/// floor forces inside friction cones at the points near the ground can give. The size of the rest counts
/// 1 N·m as much as 1 N and is given in parts of the weight W.
///
/// *Steps.* A foot stands if it is slow and level for at least 0.13 s. Feet that stand one after the other at
/// nearly the same height, more than 9 cm over the lowest height at which a foot stands, are one candidate,
/// unless a foot stands lower at another time without having stepped: such an estimate drifts. It is a
/// plate if it carries more than 0.6 W and the rest falls from more than 0.15 W without it to less than 0.1
/// W, or less than three tenths, with it. Heights are corrected for an estimate that has one foot higher than
/// the other, and those of a flight of three or more steps for unequal rises.
///
/// *Seats.* Where a rest remains although every slow foot may push, for at least 0.3 s, while hips are slow
/// and the thighs nearly level, a seat under pelvis and thighs is tried by the same two bounds.
///
/// What it does not do: no beds, tables, handrails or slopes; no plate that is touched only in passing, or
/// under anything but feet, pelvis and thighs; no extent of a plate beyond the place that is used.
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx::audit {

struct FoundScene {
  Scene scene;         ///< its floor is where the lowest feet stand, or z = 0 of a clip that is `on_floor`
  double floor = 0.0;  ///< height of that floor in the motion's world, m
  /// One per plate: "a seat of 0.43 m under the pelvis, frames 0 to 40: 0.94 of the weight".
  std::vector<std::string> words;
};

/// @throws DataError for fewer than 3 frames
FoundScene find_scene(const motion::Clip& clip);

}  // namespace mimicx::audit
