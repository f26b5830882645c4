/// Body shape from lengths: the β whose bones are as long as those of a skeleton.
///
/// Rest joints are affine in β (character/character.h); lengths are matched by damped Gauss-Newton steps with
/// a weak pull to β = 0, each |β_k| ≤ 5.
#pragma once

#include <array>

#include "character/character.h"

namespace mimicx::import {

/// Lengths that say something of the shape, m; left and right are averaged. 0: not known.
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

/// Those of a body with these rest offsets. The trunk reaches from the middle of the hips to the middle of
/// the shoulders.
BodyLengths lengths_of(const PerBody<Vector3d>& offset);

/// @return β; the components that change none of these lengths (girth, head) are 0
std::array<double, kBetas> fit_betas(const BodyLengths& lengths);

/// The β whose rest offsets are nearest to the given ones. @param error  largest difference that is left, m
std::array<double, kBetas> fit_betas(const PerBody<Vector3d>& offsets, double& error);

}  // namespace mimicx::import
