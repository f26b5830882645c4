/// The unit of length of a skeleton, decided from several kinds of evidence together.
///
/// Each unit in use gets a sum of log-likelihoods (natural logarithms, by rough estimates): how common the
/// unit is, how usual the length of the legs would be for the body's proportions (children have long trunks
/// for their legs), how fast the body falls, whether it steps faster than such legs walk, and names of joints
/// by which an exporter is known. How often it is right: docs/formats.md, "What reading decides".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/landmarks.h"

namespace mimicx::import {

/// What tells the unit.
struct UnitEvidence {
  double leg = 0.0;                ///< hip to knee to ankle, file units, > 0
  double trunk = 0.0;              ///< middle of the hips to middle of the shoulders, file units
  std::optional<double> fall_leg;  ///< length of the leg with which the body falls with g, m
  std::optional<double> walk_leg;  ///< length of the leg that walks with these steps, m
  std::vector<std::string> names;  ///< of the joints
};
/// @param up  unit vector in the file @param fps  of the file
UnitEvidence unit_evidence(const PerFrame<Landmarks>& poses, const Vector3d& up, double fps,
                           std::vector<std::string> names);

/// Whether people have legs of this length, m.
bool is_human_leg(double leg);

struct UnitDecision {
  std::string name;     ///< "centimetres"
  double metres = 1.0;  ///< of one unit
  bool fits = false;    ///< people have legs of that length; else no unit in use fits
  bool usual = false;   ///< legs of that length are usual for the proportions
  double usual_leg;     ///< m, what legs of a body of these proportions measure
  std::string second;   ///< the unit that is likely next among those that fit; empty: none
  double second_metres = 1.0;
  double lead = 0.0;  ///< of the logarithms, over the second

  bool is_near() const { return !second.empty() && lead < 2.5; }
};
UnitDecision decide_unit(const UnitEvidence& evidence);

}  // namespace mimicx::import
