/// The axis about which two segments turn against each other, from the motion of markers on both.
///
/// Source: R. M. Ehrig, W. R. Taylor, G. N. Duda, M. O. Heller, "A survey of formal methods for determining
/// functional joint axes", J. Biomech. 40 (2007): the symmetrical axis of rotation approach (SARA). A point
/// at rest in both segments solves R₁ c₁ + t₁ = R₂ c₂ + t₂ over all frames; of a hinge every point of the
/// axis does, so that the axis is the direction in which this system is least determined.
#pragma once

#include <optional>

#include "import/opensim/markers.h"

namespace mimicx::import {

/// A line that moves with a joint.
struct JointLine {
  Track point;      ///< on the line, always the same one, m
  Track direction;  ///< unit vector
};

/// @param upper, lower  the markers on each segment, three or more, in every frame
/// @return none where the joint turns too little (an angle of which the RMS is under 3°), or a segment's
///         markers stand in one line
std::optional<JointLine> functional_axis(const std::vector<Track>& upper, const std::vector<Track>& lower);

}  // namespace mimicx::import
