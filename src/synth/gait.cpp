#include "synth/gait.h"

#include "core/elementary.h"

namespace mimicx::synth {

void follow_feet(const Character& character, const GaitStyle& style, double stride, const FeetTracks& feet,
                 PerFrame<PlanFrame>& plan) {
  const std::size_t n = plan.size();
  PerFrame<double> split(n), load(n), lower(n), going(n);
  const double leg = leg_length(character) + 0.08;  // to the sole
  for (int i = 0; i < plan.count(); ++i) {
    const Eigen::Vector2d forward(cos(plan[i].heading), sin(plan[i].heading));
    const double ahead = forward.dot(plan[i].foot[0].place - plan[i].foot[1].place);
    split[i] = ahead / stride;
    load[i] = 2.0 * feet.load.at(time_of(i)) - 1.0;
    going[i] = load[i] * load[i];
    // Legs of a walker are the sides of a triangle; its height falls with the square of the base.
    lower[i] = ahead * ahead / (8.0 * leg);
  }
  split = smoothed(split, 1.8);
  load = smoothed(load, 2.5);
  lower = smoothed(lower, 2.5);
  going = smoothed(smoothed(going, 7.0), 4.0);
  for (int i = 0; i < plan.count(); ++i) {
    PlanFrame& frame = plan[i];
    frame.pelvis +=
        Vector3d(style.trunk_lean * going[i], -style.pelvis_turn * split[i], style.pelvis_drop * load[i]);
    frame.trunk += Vector3d(0.0, 1.7 * style.pelvis_turn * split[i], -style.pelvis_drop * load[i]);
    frame.head += Vector3d(-style.trunk_lean * going[i], -0.7 * style.pelvis_turn * split[i], 0.0);
    for (int side = 0; side < 2; ++side) {
      const double swing = (side == 0 ? -1.0 : 1.0) * split[i];
      frame.arm[side].forward += style.arm_swing * swing + 0.08 * going[i];
      frame.arm[side].elbow += 0.4 * style.arm_swing * (swing + going[i]);
    }
    frame.com_height -= 0.008 * leg * going[i] + 0.7 * lower[i];
  }
}

void face_along_feet(PerFrame<PlanFrame>& plan) {
  PerFrame<double> heading;
  for (const PlanFrame& frame : plan) heading.push_back(0.5 * (frame.foot[0].yaw + frame.foot[1].yaw));
  heading = smoothed(smoothed(heading, 5.0), 3.0);
  for (int i = 0; i < plan.count(); ++i) plan[i].heading = heading[i];
}

}  // namespace mimicx::synth
