/// Which shapes the mannequin of a character is made of: strings of balls along its bones.
///
/// All numbers are shares of the character's own capsules and joint offsets; what the shares are was decided
/// by eye, so that the volume stays near that of the capsules.
#pragma once

#include <vector>

#include "character/character.h"

namespace mimicx::skin {

/// A cross-section of a string of shapes: a ball, or a bar of balls that reaches as far to both sides along
/// x.
struct Knot {
  Vector3d p;         ///< bind pose, m
  double radius = 0;  ///< m
  double half = 0;    ///< reach to either side, m
};

/// What a ball sweeps on its way from knot to knot. Cross-sections are square to one direction, that from the
/// first knot to the last, along which every knot is farther than the one before.
struct Chain {
  std::vector<Knot> knots;              ///< two or more
  std::vector<int> bodies;              ///< of the way behind each knot but the last; each body in one piece
  Vector3d stretch = Vector3d::Ones();  ///< of all cross-sections, per axis
  // What follows from them:
  int limb = 0;
  Vector3d direction;         ///< unit
  std::vector<double> along;  ///< of the knots, in this direction, m
  Eigen::AlignedBox3d box;    ///< holds it
};

/// Limb by limb, from the trunk on.
std::vector<Chain> modelled(const Character& character);

}  // namespace mimicx::skin
