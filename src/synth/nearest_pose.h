/// The pose nearest to a nominal one that brings contact points and the centre of mass to their targets.
///
/// Gauss-Newton on a weighted sum of squares over all joints and the root: differences from the nominal
/// angles, distances of points from their targets, depths of other contact points below the ground, distance
/// of the centre of mass from its target. What it does not do: no joint ranges, no contact of the body with
/// itself.
#pragma once

#include <optional>

#include "synth/whole_body_balance.h"

namespace mimicx::synth {

/// Target of the lowest point of a contact point's sphere.
struct PointTarget {
  Vector3d place;         ///< m
  bool anywhere = false;  ///< only the height counts
};

struct PoseTargets {
  SynthPose nominal;
  List<std::optional<PointTarget>> point;  ///< one per contact point of the character
  Scene scene;                             ///< other points stay above its ground
  Eigen::Vector2d com;                     ///< m; a soft target, missed by centimetres where others conflict
};

/// @param start  initial pose, which selects among several minima
SynthPose nearest_pose(const Character& character, const PoseTargets& wanted, const SynthPose& start);

}  // namespace mimicx::synth
