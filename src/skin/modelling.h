/// The shapes of which a mannequin consists: strings of balls along the character's bones.
///
/// All numbers are shares of the character's own capsules and joint offsets. The shares were chosen by eye,
/// such that the volume stays close to that of the capsules.
#pragma once

#include <vector>

#include "character/character.h"

namespace mimicx::skin {

/// A cross-section of a string: a ball, or a row of balls along x, centred at p.
struct Knot {
  Vector3d p;         ///< bind pose, m
  double radius = 0;  ///< m
  double half = 0;    ///< reach to either side, m
};

/// The solid that a ball sweeps from knot to knot. Cross-sections are perpendicular to the direction from the
/// first knot to the last; along it every knot is farther than the one before.
struct Chain {
  std::vector<Knot> knots;  ///< two or more
  std::vector<int> bodies;  ///< [knots − 1] body of each stretch between two knots; each body is contiguous
  Vector3d stretch = Vector3d::Ones();  ///< of all cross-sections, per axis
  // Derived from the members above:
  int limb = 0;
  Vector3d direction;         ///< unit
  std::vector<double> along;  ///< of the knots, in this direction, m
  Eigen::AlignedBox3d box;    ///< contains the chain
};

/// The chains of a character, limb by limb, the trunk first.
std::vector<Chain> modelled(const Character& character);

}  // namespace mimicx::skin
