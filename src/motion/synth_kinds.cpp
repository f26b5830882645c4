#include "motion/synth_kinds.h"

#include "motion/synth_balance.h"

namespace mimicx {

const std::vector<SynthKind>& synth_kinds() {
  static const std::vector<SynthKind> kinds = {{"stand", plan_stand},
                                               {"walk", plan_walk},
                                               {"squat", plan_squat},
                                               {"wave", plan_wave},
                                               {"jump", plan_jump}};
  return kinds;
}

PlanFrame standing_frame(const Character& character, const FeetTracks& feet) {
  constexpr double kStandingKnee = 9.0 * kDegree;  // never fully straight
  PlanFrame frame = relaxed_posture(character);
  place_feet(feet, 0.0, frame);
  frame.com_height = com_height_for_knee(character, frame, frame.pressure, kStandingKnee);
  return frame;
}

}  // namespace mimicx
