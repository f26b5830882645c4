#include <cmath>

#include "synth/kinds.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

/// A jump in numbers: times in s, heights of the centre of mass in m.
struct JumpTiming {
  double begin, crouch, leave, land, settle, end;
  double ahead, aside;  ///< how far the feet go
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

/// @param from  when the jumper is ready
JumpTiming jump_timing(Random& random, double from) {
  const auto on_frame = [](double t) { return std::round(t * kSynthFps) / kSynthFps; };
  JumpTiming jump{};
  jump.begin = from + random.uniform(0.5, 0.75);
  jump.crouch = jump.begin + random.uniform(0.65, 0.8);
  // Leaving and landing fall on frames: the discrete motion is then exactly ballistic in between.
  jump.leave = on_frame(jump.crouch + random.uniform(0.36, 0.40));
  jump.land = jump.leave + on_frame(random.uniform(0.30, 0.37));
  jump.settle = jump.land + 0.40;
  jump.end = jump.settle + random.uniform(0.8, 1.0);
  jump.ahead = random.uniform(0.0, 0.25);
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

/// A jump with all that is known of it.
struct Jump {
  JumpTiming time;
  JumpPostures postures;
};

Jump make_jump(const Character& character, const PlanFrame& stand, JumpTiming time, Random& random) {
  Jump jump{time, jump_postures(character, stand, random)};
  const double flight = time.land - time.leave;
  jump.time.leave_height = jump.postures.leave.com_height;
  jump.time.land_height = jump.time.leave_height - 0.02;
  jump.time.velocity = (jump.time.land_height - jump.time.leave_height) / flight + 0.5 * kGravity * flight;
  return jump;
}

/// Both feet at once: up on the toes, off, and back on the toes.
FeetTracks jumping_feet(const Character& character, const PerSide<FootTarget>& start,
                        const std::vector<Jump>& jumps) {
  constexpr double kToesClear = 0.09;  // s from leaving to moving with the body
  constexpr double kStretch = 0.045;   // m by which the legs stretch after leaving
  FeetTracks feet = standing_feet(character, start);
  const double forefoot = forefoot_length(character), mid = feet.foot[0].pressure.at(0.0),
               toes = 0.87 * forefoot;
  for (int side = 0; side < 2; ++side) {
    std::vector<Knot> x, y, lift, heel_rise, pressure;
    Eigen::Vector2d place = start[side].place;
    for (const auto& [jump, postures] : jumps) {
      const double up = jump.leave + kToesClear, down = jump.land - kToesClear;
      const auto lift_at = [&, &jump = jump](double t) {
        return Knot{t, jump.height_in_flight(t) - jump.leave_height - kStretch, jump.velocity_in_flight(t),
                    -kGravity};
      };
      const Eigen::Vector2d there = place + Eigen::Vector2d(jump.ahead, jump.aside);
      x.insert(x.end(), {{jump.leave + 0.02, place.x()}, {jump.land - 0.02, there.x()}});
      y.insert(y.end(), {{jump.leave + 0.02, place.y()}, {jump.land - 0.02, there.y()}});
      place = there;
      lift.insert(lift.end(),
                  {{jump.leave - 0.025, 0.0}, lift_at(up), lift_at(down), {jump.land + 0.025, 0.0}});
      heel_rise.insert(heel_rise.end(), {{jump.leave - 0.085, 0.0},
                                         {jump.leave + 0.10, 62.0 * kDegree},
                                         {jump.land - 0.08, 55.0 * kDegree},
                                         {jump.land + 0.10, 0.0}});
      pressure.insert(pressure.end(), {{jump.leave - 0.40, mid},
                                       {jump.leave - 0.06, toes},
                                       {jump.land + 0.04, toes},
                                       {jump.land + 0.35, mid}});
    }
    FootTracks& foot = feet.foot[side];
    foot.x = MinJerkTrack(x);
    foot.y = MinJerkTrack(y);
    foot.lift = MinJerkTrack(lift);
    foot.heel_rise = MinJerkTrack(heel_rise);
    foot.pressure = MinJerkTrack(pressure);
  }
  return feet;
}

PerFrame<PlanFrame> plan_of(const PlanRequest& request, const PerSide<FootTarget>& start,
                            const PlanFrame& stand, const std::vector<Jump>& jumps) {
  const FeetTracks feet = jumping_feet(request.character, start, jumps);
  std::vector<Knot> heights;
  std::vector<PostureKey> keys = {{0.0, stand}};
  for (const auto& [jump, p] : jumps) {
    heights.insert(heights.end(),
                   {{jump.begin, stand.com_height},
                    {jump.crouch, p.crouch.com_height, 0.0, 6.0},
                    {jump.leave, jump.leave_height, jump.velocity, -kGravity},
                    {jump.land, jump.land_height, jump.velocity_in_flight(jump.land), -kGravity},
                    {jump.settle, p.soft.com_height, 0.0, 1.5},
                    {jump.end, stand.com_height}});
    keys.insert(keys.end(), {{jump.begin, stand},
                             {jump.crouch, p.crouch},
                             {jump.leave, p.leave},
                             {jump.land, p.land},
                             {jump.settle, p.soft},
                             {jump.end, stand}});
  }
  const MinJerkTrack height(heights);
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  for (int i = 0; i < plan.count(); ++i) {
    const double t = time_of(i);
    hold_postures(keys, t, plan[i]);
    place_feet(feet, t, plan[i]);
    plan[i].com_height = height.at(t);
    for (const Jump& jump : jumps)
      plan[i].flight = plan[i].flight || (t > jump.time.leave + 0.01 && t < jump.time.land - 0.01);
  }
  return plan;
}

}  // namespace

PerFrame<PlanFrame> plan_jump(const PlanRequest& request) {
  Random& random = request.random;
  const auto start = random_stance(request, 1.0, 1.2, 4.0, 10.0);
  const JumpTiming time = jump_timing(random, 0.0);
  const PlanFrame stand = standing_frame(request.character, start);
  return plan_of(request, start, stand, {make_jump(request.character, stand, time, random)});
}

PerFrame<PlanFrame> plan_jumps(const PlanRequest& request) {
  Random& random = request.random;
  const auto start = random_stance(request, 1.0, 1.2, 4.0, 10.0);
  const PlanFrame stand = standing_frame(request.character, start);
  std::vector<Jump> jumps;
  for (double from = -0.3;;) {
    JumpTiming time = jump_timing(random, from);
    time.ahead = random.uniform(-0.12, 0.25);
    time.aside = random.uniform(-0.12, 0.12);
    from = time.end - 0.45;
    if (time.end > request.seconds() - 0.2 && !jumps.empty()) break;
    jumps.push_back(make_jump(request.character, stand, time, random));
  }
  return plan_of(request, start, stand, jumps);
}

}  // namespace mimicx::synth
