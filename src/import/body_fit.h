/// Body shape from lengths: the β whose bones are as long as those of a skeleton.
///
/// Rest joints are affine in β (character/character.h). Damped Gauss-Newton steps with a weak prior towards
/// β = 0 match the lengths, with |β_k| ≤ 5.
#pragma once

#include <array>

#include "character/character.h"

namespace mimicx::import {

/// Lengths that depend on the shape, m, means of left and right. 0: not known.
enum Length : int {
  kThigh,
  kShank,
  kFootLength,
  kUpperArm,
  kForearm,
  kHipWidth,
  kShoulderWidth,
  kTrunk,
  kLengths
};
using BodyLengths = Array<double, kLengths>;

/// Lengths of a body with these rest offsets. The trunk reaches from the middle of the hips to the middle of
/// the shoulders.
BodyLengths lengths_of(const PerBody<Vector3d>& offset);

/// @return β; the components that change none of these lengths (girth, head) are 0
std::array<double, kBetas> fit_betas(const BodyLengths& lengths);

/// The β whose rest offsets are nearest to the given ones. @param error  gets the largest difference left, m
std::array<double, kBetas> fit_betas(const PerBody<Vector3d>& offsets, double& error);

}  // namespace mimicx::import
