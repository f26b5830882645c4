
#include "synth/kinds.h"
#include "synth/kinds/random_postures.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

/// Height with the straighter knee at `knee_degrees`, the centre of mass over the centre of pressure.
double height_at(const Character& character, const PlanFrame& frame, double knee_degrees) {
  return com_height_for_knee(character, frame, frame.pressure, knee_degrees * kDegree);
}

/// When the parts of a kick begin, s.
struct Kick {
  int side;
  double shift, leave, chamber, strike, recoil, land;
};

std::vector<Kick> draw_kicks(const PlanRequest& request) {
  Random& random = request.random;
  constexpr double kSettle = 0.75;
  std::vector<Kick> kicks;
  double t = random.uniform(0.25, 0.40);
  while (true) {
    Kick kick{};
    kick.side = static_cast<int>(random.below(2));
    kick.shift = t;
    kick.leave = t + random.uniform(0.55, 0.65);
    kick.chamber = kick.leave + random.uniform(0.28, 0.32);
    kick.strike = kick.chamber + random.uniform(0.22, 0.27);
    kick.recoil = kick.strike + random.uniform(0.22, 0.26);
    kick.land = kick.recoil + random.uniform(0.30, 0.36);
    t = kick.land + kSettle;
    if (t > request.seconds() - 0.1) return kicks;
    kicks.push_back(kick);
  }
}

/// Up with a bent knee, out to the front, back and down.
FeetTracks kicking_feet(const PlanRequest& request, const PerSide<FootTarget>& start,
                        const std::vector<Kick>& kicks) {
  const double leg = leg_length(request.character);
  FeetTracks feet = standing_feet(request.character, start);
  PerSide<std::vector<Knot>> x, lift, toes_up, toes_down;
  std::vector<Knot> load = {{0.0, 0.5}};
  for (int side = 0; side < 2; ++side) {
    x[side] = {{0.0, start[side].place.x()}};
    lift[side] = toes_up[side] = toes_down[side] = {{0.0, 0.0}};
  }
  for (const Kick& k : kicks) {
    const double reach = request.random.uniform(0.58, 0.66) * leg,
                 height = request.random.uniform(0.30, 0.42) * leg;
    const double home = start[k.side].place.x(), folded = home + 0.06 * leg;
    x[k.side].insert(x[k.side].end(), {{k.leave + 0.03, home},
                                       {k.chamber, folded},
                                       {k.strike, home + reach},
                                       {k.recoil, folded},
                                       {k.land - 0.06, home}});
    lift[k.side].insert(
        lift[k.side].end(),
        {{k.leave, 0.0}, {k.chamber, 0.26 * leg}, {k.strike, height}, {k.recoil, 0.24 * leg}, {k.land, 0.0}});
    toes_up[k.side].insert(toes_up[k.side].end(),
                           {{k.chamber, 0.0}, {k.strike, 30.0 * kDegree}, {k.recoil, 0.0}});
    toes_down[k.side].insert(toes_down[k.side].end(), {{k.leave, 0.0},
                                                       {k.chamber, 25.0 * kDegree},
                                                       {k.strike, 0.0},
                                                       {k.recoil, 20.0 * kDegree},
                                                       {k.land, 0.0}});
    const double standing = k.side == 0 ? 0.0 : 1.0;
    load.insert(load.end(), {{k.shift, 0.5}, {k.leave, standing}, {k.land, standing}, {k.land + 0.7, 0.5}});
  }
  for (int side = 0; side < 2; ++side) {
    feet.foot[side].x = MinJerkTrack(x[side]);
    feet.foot[side].lift = MinJerkTrack(lift[side]);
    feet.foot[side].toe_rise = MinJerkTrack(toes_up[side]);
    feet.foot[side].heel_rise = MinJerkTrack(toes_down[side]);
  }
  feet.load = MinJerkTrack(load);
  return feet;
}

/// Both feet as in a step, the knees bent, one foot ahead.
PerSide<FootTarget> fighting_stance(const PlanRequest& request, int lead) {
  auto feet = random_stance(request, 1.05, 1.25, 5.0, 9.0);
  const double half = request.random.uniform(0.15, 0.20) * leg_length(request.character);
  feet[lead].place.x() = half;
  feet[1 - lead].place.x() = -half;
  feet[1 - lead].yaw *= 4.0;
  return feet;
}

}  // namespace

PerFrame<PlanFrame> plan_kick(const PlanRequest& request) {
  Random& random = request.random;
  const auto start = random_stance(request, 0.95, 1.1, 4.0, 9.0);
  const std::vector<Kick> kicks = draw_kicks(request);
  const FeetTracks feet = kicking_feet(request, start, kicks);
  const PlanFrame stand = standing_frame(request.character, feet);
  PlanFrame poised = stand;  // arms out for balance
  for (ArmPosture& arm : poised.arm) arm = {20.0 * kDegree, 28.0 * kDegree, 10.0 * kDegree, 55.0 * kDegree};
  poised.com_height -= 0.012 * leg_length(request.character);
  std::vector<PostureKey> keys = {{0.0, stand}};
  for (const Kick& k : kicks) {
    PlanFrame strike = poised;
    const double mirror = k.side == 0 ? 1.0 : -1.0;
    strike.pelvis = kDegree * Vector3d(-random.uniform(5.0, 9.0), -6.0 * mirror, 0.0);
    strike.trunk = kDegree * Vector3d(3.0, 10.0 * mirror, 0.0);
    strike.arm[k.side].forward = -10.0 * kDegree;
    strike.arm[1 - k.side].forward = 40.0 * kDegree;
    keys.insert(keys.end(), {{k.shift, stand},
                             {k.leave, poised},
                             {k.chamber, poised},
                             {k.strike, strike},
                             {k.land, poised},
                             {k.land + 0.7, stand}});
  }
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  hold_postures(keys, feet, plan);
  return plan;
}

PerFrame<PlanFrame> plan_punch(const PlanRequest& request) {
  Random& random = request.random;
  const int lead = static_cast<int>(random.below(2));
  const PlanFrame stand = standing_frame(request.character, fighting_stance(request, lead));
  PlanFrame guard = guard_posture(stand);
  guard.com_height = height_at(request.character, guard, random.uniform(24.0, 32.0));
  double t = random.uniform(0.25, 0.40);
  std::vector<PostureKey> keys = {{0.0, stand}, {t, stand}, {t + 0.8, guard}};
  const double end = request.seconds() - 1.1;
  t += 0.8 + random.uniform(0.05, 0.25);
  int side = lead;
  while (true) {
    const double out = random.uniform(0.28, 0.33), back = random.uniform(0.32, 0.40),
                 pause = random.uniform(0.10, 0.30);
    if (t + out + back > end) break;
    PlanFrame punch = guard;
    const double mirror = side == 0 ? 1.0 : -1.0;
    punch.pelvis.y() = -mirror * random.uniform(5.0, 9.0) * kDegree;
    punch.trunk.y() = -mirror * random.uniform(12.0, 20.0) * kDegree;
    punch.head.y() = -punch.pelvis.y() - punch.trunk.y();
    punch.arm[side] = {random.uniform(80.0, 92.0) * kDegree, 4.0 * kDegree, 0.0, 24.0 * kDegree};
    keys.insert(keys.end(), {{t, guard}, {t + out, punch}, {t + out + back, guard}});
    t += out + back + pause;
    side = random.uniform() < 0.7 ? 1 - side : side;
  }
  keys.insert(keys.end(), {{end + 0.1, guard}, {end + 0.95, stand}});
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  for (int i = 0; i < plan.count(); ++i) hold_postures(keys, time_of(i), plan[i]);
  return plan;
}

PerFrame<PlanFrame> plan_lunge(const PlanRequest& request) {
  Random& random = request.random;
  const Character& character = request.character;
  const double leg = leg_length(character);
  const auto start = random_stance(request, 1.05, 1.25, 4.0, 8.0);
  const int front = static_cast<int>(random.below(2)), rear = 1 - front;
  const double length = random.uniform(0.62, 0.74) * leg;
  const double swing = random.uniform(0.52, 0.60), down = random.uniform(0.75, 0.90),
               hold = random.uniform(0.10, 0.30), up = random.uniform(0.70, 0.85),
               pause = random.uniform(0.95, 1.10);
  const double cycle = swing + down + hold + up + swing + pause;
  // The stance of the lunge fixes how low it goes.
  auto apart = start;
  apart[front].place.x() += length;
  PlanFrame low = standing_frame(character, apart);
  const double heel = 46.0 * kDegree, knee = random.uniform(64.0, 78.0);
  low.pelvis.x() = 4.0 * kDegree;
  low.trunk.x() = random.uniform(2.0, 8.0) * kDegree;
  for (ArmPosture& arm : low.arm) arm = {12.0 * kDegree, 22.0 * kDegree, 0.0, 40.0 * kDegree};
  PlanFrame rolled = low;
  rolled.foot[rear].heel_rise = heel;
  low.com_height = height_at(character, rolled, knee);
  const PlanFrame stand = standing_frame(character, start);
  PlanFrame split = stand;  // just landed, or about to step back
  split.arm = low.arm;
  split.com_height -= 0.09 * leg;
  std::vector<FootSwing> swings;
  std::vector<PostureKey> keys = {{0.0, stand}};
  std::vector<Knot> heel_rise = {{0.0, 0.0}}, pressure = {{0.0, feet_middle(character)}};
  for (double t = random.uniform(0.85, 0.95); t + cycle - pause < request.seconds() - 0.75; t += cycle) {
    const double land = t + swing, bottom = land + down, rise = bottom + hold, leave = rise + up;
    swings.push_back({front, t, land, apart[front].place, apart[front].yaw, 0.06});
    swings.push_back({front, leave, leave + swing, start[front].place, start[front].yaw, 0.06});
    heel_rise.insert(heel_rise.end(),
                     {{land + 0.15, 0.0}, {land + 0.60, heel}, {leave - 0.60, heel}, {leave - 0.05, 0.0}});
    const double toes = 0.85 * forefoot_length(character), middle = feet_middle(character);
    pressure.insert(
        pressure.end(),
        {{land - 0.10, middle}, {land + 0.30, toes}, {leave - 0.20, toes}, {leave + 0.10, middle}});
    keys.insert(keys.end(), {{t - 0.4, stand},
                             {land, split},
                             {bottom, low},
                             {rise, low},
                             {leave, split},
                             {leave + swing + 0.3, stand}});
  }
  FeetTracks feet = stepping_feet(character, start, swings, 0.45);
  feet.foot[rear].heel_rise = MinJerkTrack(heel_rise);
  feet.foot[rear].pressure = MinJerkTrack(pressure);
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  hold_postures(keys, feet, plan);
  return plan;
}

}  // namespace mimicx::synth
