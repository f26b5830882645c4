/// The pose nearest to a nominal one in which points are at their places and the centre of mass at its own.
///
/// Gauss-Newton on a weighted sum of squares over all joints and the root: angles off the nominal ones,
/// points off their places, every other contact point below the floor, centre of mass off its place. What it
/// does not do: ranges of joints, contact of the body with itself.
#pragma once

#include <optional>

#include "synth/whole_body_balance.h"

namespace mimicx::synth {

/// Where the lowest of a contact point's sphere is wanted.
struct PointTarget {
  Vector3d place;         ///< m
  bool anywhere = false;  ///< the height alone counts
};

struct PoseTargets {
  SynthPose nominal;
  List<std::optional<PointTarget>> point;  ///< one per contact point of the character
  Eigen::Vector2d com;                     ///< m; missed by centimetres where the rest asks for it
};

/// @param start  to begin with: of several minima the near one is found
SynthPose nearest_pose(const Character& character, const PoseTargets& wanted, const SynthPose& start);

}  // namespace mimicx::synth
