/// The unit of a motion's translation, where the body's own lengths are metres: files of SMPL parameters.
///
/// In the right unit planted feet stay where they are and the floor is where the format has it, at 0. Both
/// together decide: feet alone would shrink a skater's way, the floor alone would scale whoever stands on a
/// stage.
#pragma once

#include <string>

#include "motion/clip.h"

namespace mimicx::import {

struct TranslationUnit {
  std::string name = "metres";
  double metres = 1.0;       ///< of one unit
  double support_speed = 0;  ///< of the slower foot in this unit, m/s, in the median
  std::string near;          ///< a unit that is nearly as likely; empty: none
  double near_metres = 1.0;
};
TranslationUnit decide_translation_unit(const motion::Clip& clip);

}  // namespace mimicx::import
