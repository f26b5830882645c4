#include <algorithm>
#include <cmath>

#include "motion/synth/balance.h"
#include "motion/synth/kinds.h"

namespace mimicx::motion::synth {
namespace {

/// A jump in numbers: times in s, heights of the centre of mass in m.
struct JumpTiming {
  double begin, crouch, leave, land, settle, end;
  double distance;
  double leave_height, land_height, velocity;

  double height_in_flight(double t) const {
    const double s = t - leave;
    return leave_height + velocity * s - 0.5 * kGravity * s * s;
  }
  double velocity_in_flight(double t) const { return velocity - kGravity * (t - leave); }
};

/// Postures the jump goes through, with the heights of those that fix the height.
struct JumpPostures {
  PlanFrame stand, crouch, leave, land, soft;
};

JumpTiming jump_timing(Random& random) {
  const auto on_frame = [](double t) { return std::round(t * kSynthFps) / kSynthFps; };
  JumpTiming jump{};
  jump.begin = random.uniform(0.5, 0.75);
  jump.crouch = jump.begin + random.uniform(0.65, 0.8);
  // Leaving and landing fall on frames: the discrete motion is then exactly ballistic in between.
  jump.leave = on_frame(jump.crouch + random.uniform(0.36, 0.40));
  jump.land = jump.leave + on_frame(random.uniform(0.30, 0.37));
  jump.settle = jump.land + 0.40;
  jump.end = jump.settle + random.uniform(0.8, 1.0);
  jump.distance = random.uniform(0.0, 0.25);
  return jump;
}

/// Arms back in the crouch, up while leaving, and down with the landing.
JumpPostures jump_postures(const Character& character, const PlanFrame& stand, Random& random) {
  JumpPostures p{stand, stand, stand, stand, stand};
  const double arms_back = random.uniform(30.0, 40.0) * kDegree,
               arms_up = random.uniform(60.0, 90.0) * kDegree;
  p.crouch.pelvis.x() = 18.0 * kDegree;
  p.crouch.trunk.x() = 16.0 * kDegree;
  p.crouch.head.x() = -18.0 * kDegree;
  p.leave.pelvis.x() = p.land.pelvis.x() = p.land.trunk.x() = 4.0 * kDegree;
  p.soft.pelvis.x() = 16.0 * kDegree;
  p.soft.trunk.x() = 14.0 * kDegree;
  p.soft.head.x() = -14.0 * kDegree;
  for (int side = 0; side < 2; ++side) {
    p.crouch.arm[side].forward = -arms_back;
    p.leave.arm[side].forward = arms_up;
    p.land.arm[side].forward = arms_up - 10.0 * kDegree;
    p.soft.arm[side].forward = 35.0 * kDegree;
  }
  const auto height = [&](const PlanFrame& frame, double knee_degrees) {
    return com_height_for_knee(character, frame, frame.pressure, knee_degrees * kDegree);
  };
  PlanFrame on_toes = p.leave;
  for (FootTarget& foot : on_toes.foot) foot.heel_rise = 18.0 * kDegree;  // a little less than when leaving
  p.leave.com_height = height(on_toes, 38.0);
  p.crouch.com_height = height(p.crouch, random.uniform(72.0, 84.0));
  p.soft.com_height = height(p.soft, random.uniform(68.0, 80.0));
  return p;
}

/// Both feet at once: up on the toes, off, and back on the toes.
FeetTracks jumping_feet(const Character& character, const PerSide<FootTarget>& start,
                        const JumpTiming& jump) {
  constexpr double kToesClear = 0.09;  // s from leaving to moving with the body
  constexpr double kStretch = 0.045;   // m by which the legs stretch after leaving
  FeetTracks feet = standing_feet(character, start);
  const double forefoot = forefoot_length(character), mid = feet.foot[0].pressure.at(0.0),
               toes = 0.87 * forefoot;
  const double up = jump.leave + kToesClear, down = jump.land - kToesClear;
  const auto lift_at = [&](double t) {
    return Knot{t, jump.height_in_flight(t) - jump.leave_height - kStretch, jump.velocity_in_flight(t),
                -kGravity};
  };
  for (int side = 0; side < 2; ++side) {
    FootTracks& foot = feet.foot[side];
    const double x = start[side].place.x();
    foot.x = MinJerkTrack({{jump.leave + 0.02, x}, {jump.land - 0.02, x + jump.distance}});
    foot.lift =
        MinJerkTrack({{jump.leave - 0.025, 0.0}, lift_at(up), lift_at(down), {jump.land + 0.025, 0.0}});
    foot.heel_rise = MinJerkTrack({{jump.leave - 0.085, 0.0},
                                   {jump.leave + 0.10, 62.0 * kDegree},
                                   {jump.land - 0.08, 55.0 * kDegree},
                                   {jump.land + 0.10, 0.0}});
    foot.pressure = MinJerkTrack({{jump.leave - 0.40, mid},
                                  {jump.leave - 0.06, toes},
                                  {jump.land + 0.04, toes},
                                  {jump.land + 0.35, mid}});
  }
  return feet;
}

}  // namespace

PerFrame<PlanFrame> plan_jump(const PlanRequest& request) {
  Random& random = request.random;
  const Character& character = request.character;
  const auto start = random_stance(request, 1.0, 1.2, 4.0, 10.0);
  JumpTiming jump = jump_timing(random);
  const PlanFrame stand = standing_frame(character, standing_feet(character, start));
  const JumpPostures p = jump_postures(character, stand, random);
  const double flight = jump.land - jump.leave;
  jump.leave_height = p.leave.com_height;
  jump.land_height = jump.leave_height - 0.02;
  jump.velocity = (jump.land_height - jump.leave_height) / flight + 0.5 * kGravity * flight;
  const FeetTracks feet = jumping_feet(character, start, jump);
  const MinJerkTrack height({{jump.begin, stand.com_height},
                             {jump.crouch, p.crouch.com_height, 0.0, 6.0},
                             {jump.leave, jump.leave_height, jump.velocity, -kGravity},
                             {jump.land, jump.land_height, jump.velocity_in_flight(jump.land), -kGravity},
                             {jump.settle, p.soft.com_height, 0.0, 1.5},
                             {jump.end, stand.com_height}});
  const std::vector<PostureKey> keys = {{0.0, stand},          {jump.begin, stand}, {jump.crouch, p.crouch},
                                        {jump.leave, p.leave}, {jump.land, p.land}, {jump.settle, p.soft},
                                        {jump.end, stand}};
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  for (int i = 0; i < plan.count(); ++i) {
    const double t = time_of(i);
    hold_postures(keys, t, plan[i]);
    place_feet(feet, t, plan[i]);
    plan[i].com_height = height.at(t);
    plan[i].flight = t > jump.leave + 0.01 && t < jump.land - 0.01;
  }
  return plan;
}

}  // namespace mimicx::motion::synth
