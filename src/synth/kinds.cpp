#include "synth/kinds.h"

#include "synth/whole_body_balance.h"

namespace mimicx::synth {

const std::vector<SynthKind>& synth_kinds() {
  static const std::vector<SynthKind> kinds = {{"stand", 4.4, 5.4, plan_stand},
                                               {"walk", 5.0, 6.5, plan_walk},
                                               {"squat", 5.7, 6.0, plan_squat},
                                               {"wave", 4.4, 5.4, plan_wave},
                                               {"jump", 4.0, 4.4, plan_jump},
                                               {"walk_turn", 6.0, 7.5, plan_walk_turn},
                                               {"side_step", 6.0, 7.5, plan_side_step},
                                               {"kick", 5.5, 7.0, plan_kick},
                                               {"lunge", 6.0, 8.0, plan_lunge},
                                               {"punch", 5.0, 6.5, plan_punch},
                                               {"bow", 4.6, 6.0, plan_bow},
                                               {"turn_in_place", 5.5, 7.5, plan_turn_in_place},
                                               {"dance", 8.0, 10.0, plan_dance},
                                               {"jog", 5.0, 6.5, plan_jog},
                                               {"walk_back", 5.0, 7.5, plan_walk_back},
                                               {"walk_diagonal", 5.0, 7.5, plan_walk_diagonal},
                                               {"walk_curve", 5.5, 8.0, plan_walk_curve},
                                               {"walk_stop", 6.0, 9.0, plan_walk_stop},
                                               {"shuffle", 5.0, 8.0, plan_shuffle},
                                               {"turn_around", 5.5, 8.0, plan_turn_around},
                                               {"walk_crouched", 6.5, 9.0, plan_walk_crouched},
                                               {"balance", 6.0, 9.0, plan_balance},
                                               {"kick_around", 5.5, 8.0, plan_kick_around},
                                               {"march", 5.0, 7.5, plan_march},
                                               {"crouch", 5.5, 8.0, plan_crouch},
                                               {"sit", 5.0, 7.5, plan_sit},
                                               {"pick_up", 5.5, 8.0, plan_pick_up},
                                               {"lunge_around", 6.0, 9.0, plan_lunge_around},
                                               {"reach", 5.0, 7.5, plan_reach},
                                               {"talk", 5.0, 8.0, plan_talk},
                                               {"stretch", 6.0, 9.0, plan_stretch},
                                               {"arm_swings", 4.5, 6.5, plan_arm_swings},
                                               {"jumps", 5.5, 8.0, plan_jumps},
                                               {"martial", 6.5, 9.5, plan_martial},
                                               {"free", 6.5, 10.0, plan_free}};
  return kinds;
}

const std::vector<SketchedKind>& sketched_kinds() {
  static const std::vector<SketchedKind> kinds = {{"kneel", 11.0, 14.0, sketch_kneel},
                                                  {"crawl", 16.0, 20.0, sketch_crawl},
                                                  {"lie_down", 19.0, 23.0, sketch_lie_down}};
  return kinds;
}

const std::vector<SceneKind>& scene_kinds() {
  static const std::vector<SceneKind> kinds = {
      {"stairs_up", 5.6, 6.8, climb_stairs}, {"stairs_down", 5.6, 6.8, descend_stairs},
      {"kerb", 7.0, 8.5, cross_kerb},        {"box", 7.0, 8.5, cross_box},
      {"sit_down", 8.0, 10.0, sit_down},     {"sit_and_reach", 11.0, 14.0, sit_and_reach},
      {"lie_on_bed", 15.0, 18.0, lie_on_bed}};
  return kinds;
}

PerSide<FootTarget> random_stance(const PlanRequest& request, double narrow, double wide, double least_out,
                                  double most_out) {
  const double half_width = rest_half_width(request.character) * request.random.uniform(narrow, wide);
  const double toes_out = kDegree * request.random.uniform(least_out, most_out);
  return feet_apart(half_width, toes_out);
}

PlanFrame standing_frame(const Character& character, const FeetTracks& feet) {
  constexpr double kStandingKnee = 9.0 * kDegree;  // never fully straight
  PlanFrame frame = relaxed_posture(character);
  place_feet(feet, 0.0, frame);
  frame.com_height = com_height_for_knee(character, frame, frame.pressure, kStandingKnee);
  return frame;
}

PlanFrame standing_frame(const Character& character, const PerSide<FootTarget>& start) {
  return standing_frame(character, standing_feet(character, start));
}

}  // namespace mimicx::synth
