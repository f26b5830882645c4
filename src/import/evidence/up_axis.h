/// The axis that points up in a file, decided from several kinds of evidence together.
///
/// Each of the six directions gets a sum of log-likelihoods (natural logarithms, by rough estimates): the
/// body stands along it; its lowest points stay at one height; what is lowest is at rest; bodies fall along
/// it; the floor is at 0; the centre of mass is over what is lowest; the rest pose stands along it; the
/// format's custom. None decides alone: a crawler lies along the floor, a sleeper is still in every
/// direction, in a handstand the hands are lowest and at rest. How often it is right: docs/formats.md, "What
/// reading decides".
#pragma once

#include <optional>
#include <string>

#include "import/landmarks.h"

namespace mimicx::import {

struct UpDecision {
  char axis = 'z';    ///< 'x', 'y', 'z'; capital letters: the negative axes
  char second = 'y';  ///< the direction that is likely next
  double lead = 0.0;  ///< of the logarithms
  std::string why;    ///< what speaks for it, e.g. "the body stands along it; the floor is at 0"

  /// Whether the second direction is nearly as likely, so that a person should look.
  bool is_near() const { return lead < 1.0; }
};

/// The warning where `is_near`.
std::string near_up_warning(const UpDecision& decision);

/// @param poses   of the motion, any unit and axes
/// @param rest    the skeleton's rest pose, in the same unit and axes; none: there is none
/// @param custom  the axis that is usual for the format
UpDecision decide_up(const PerFrame<Landmarks>& poses, const std::optional<Landmarks>& rest, char custom);

}  // namespace mimicx::import
