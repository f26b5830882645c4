#include <algorithm>
#include <cmath>

#include "motion/synth_balance.h"
#include "motion/synth_kinds.h"

namespace mimicx {
namespace {

/// How a gait looks, beyond where the feet go.
struct GaitStyle {
  double arm_swing, pelvis_turn, pelvis_drop, trunk_lean;  ///< rad
};

/// Pelvis, trunk, arms and height follow the feet: what swings the arms is which foot is ahead.
/// @param plan  feet placed; posture and height those of standing
/// @param stride  distance of the feet in a full step, m
void follow_feet(const Character& character, const GaitStyle& style, double stride, const FeetTracks& feet,
                 std::vector<PlanFrame>& plan) {
  const std::size_t n = plan.size();
  std::vector<double> split(n), load(n), lower(n), going(n);
  const double leg = leg_length(character) + 0.08;  // to the sole
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d forward(std::cos(plan[i].heading), std::sin(plan[i].heading));
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
  for (std::size_t i = 0; i < n; ++i) {
    PlanFrame& frame = plan[i];
    frame.pelvis +=
        Vector3d(style.trunk_lean * going[i], -style.pelvis_turn * split[i], style.pelvis_drop * load[i]);
    frame.trunk += Vector3d(0.0, 1.7 * style.pelvis_turn * split[i], -style.pelvis_drop * load[i]);
    frame.head += Vector3d(-style.trunk_lean * going[i], -0.7 * style.pelvis_turn * split[i], 0.0);
    for (std::size_t side = 0; side < 2; ++side) {
      const double swing = (side == 0 ? -1.0 : 1.0) * split[i];
      frame.arm[side].forward += style.arm_swing * swing + 0.08 * going[i];
      frame.arm[side].elbow += 0.4 * style.arm_swing * (swing + going[i]);
    }
    frame.com_height -= 0.008 * leg * going[i] + 0.7 * lower[i];
  }
}

}  // namespace

std::vector<PlanFrame> plan_walk(const PlanRequest& request) {
  Random& random = request.random;
  const double half_width = rest_half_width(request.character) * random.uniform(0.72, 0.85);
  const double toes_out = random.uniform(4.0, 8.0) * kDegree;
  const double speed = random.uniform(1.10, 1.20),
               step = 0.75 * random.uniform(0.96, 1.04) * leg_length(request.character);
  const double period = step / speed, swing = random.uniform(0.80, 0.82) * period;
  const double begin = random.uniform(0.85, 0.95), rest = 0.90;
  const int first = static_cast<int>(random.below(2));
  const auto start = feet_apart(half_width, toes_out);
  std::vector<FootSwing> swings;
  const int steps = static_cast<int>((request.seconds() - begin - rest) / period);
  double ahead = 0.0;
  for (int k = 0; k < steps; ++k) {
    // The first step is shorter, the last one brings the feet together.
    ahead += k == 0 ? 0.7 * step : k + 1 < steps ? step : 0.0;
    const int side = (first + k) % 2;
    const double mirror = side == 0 ? 1.0 : -1.0, t = begin + k * period;
    swings.push_back({side, t, t + swing, {ahead, mirror * half_width}, mirror * toes_out, 0.05});
  }
  const FeetTracks feet = stepping_feet(request.character, start, swings, 0.55);
  std::vector<PlanFrame> plan(static_cast<std::size_t>(request.frames),
                              standing_frame(request.character, feet));
  for (std::size_t i = 0; i < plan.size(); ++i) place_feet(feet, time_of(i), plan[i]);
  const GaitStyle style = {random.uniform(18.0, 26.0) * kDegree, random.uniform(4.0, 6.0) * kDegree,
                           random.uniform(2.0, 3.5) * kDegree, random.uniform(2.0, 4.0) * kDegree};
  follow_feet(request.character, style, step, feet, plan);
  return plan;
}

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
  jump.leave = on_frame(jump.crouch + random.uniform(0.30, 0.34));
  jump.land = jump.leave + on_frame(random.uniform(0.30, 0.37));
  jump.settle = jump.land + 0.36;
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
  for (std::size_t side = 0; side < 2; ++side) {
    p.crouch.arm[side].forward = -arms_back;
    p.leave.arm[side].forward = arms_up;
    p.land.arm[side].forward = arms_up - 10.0 * kDegree;
    p.soft.arm[side].forward = 35.0 * kDegree;
  }
  const auto height = [&](const PlanFrame& frame, double knee_degrees) {
    return com_height_for_knee(character, frame, frame.pressure, knee_degrees * kDegree);
  };
  PlanFrame on_toes = p.leave;
  for (FootTarget& foot : on_toes.foot) foot.heel_rise = 36.0 * kDegree;
  p.leave.com_height = height(on_toes, 38.0);
  p.crouch.com_height = height(p.crouch, random.uniform(72.0, 84.0));
  p.soft.com_height = height(p.soft, random.uniform(68.0, 80.0));
  return p;
}

/// Both feet at once: up on the toes, off, and back on the toes.
FeetTracks jumping_feet(const Character& character, const std::array<FootTarget, 2>& start,
                        const JumpTiming& jump) {
  constexpr double kToesClear = 0.09;  // s from leaving to moving with the body
  constexpr double kStretch = 0.045;   // m by which the legs stretch after leaving
  FeetTracks feet = standing_feet(character, start);
  const double forefoot = forefoot_length(character), mid = feet.foot[0].pressure.at(0.0),
               toes = 0.95 * forefoot;
  const double up = jump.leave + kToesClear, down = jump.land - kToesClear;
  const auto lift_at = [&](double t) {
    return Knot{t, jump.height_in_flight(t) - jump.leave_height - kStretch, jump.velocity_in_flight(t),
                -kGravity};
  };
  for (std::size_t side = 0; side < 2; ++side) {
    FootTracks& foot = feet.foot[side];
    const double x = start[side].place.x();
    foot.x = MinJerkTrack({{jump.leave + 0.02, x}, {jump.land - 0.02, x + jump.distance}});
    foot.lift =
        MinJerkTrack({{jump.leave - 0.025, 0.0}, lift_at(up), lift_at(down), {jump.land + 0.025, 0.0}});
    foot.heel_rise = MinJerkTrack({{jump.leave - 0.17, 0.0},
                                   {jump.leave + 0.10, 62.0 * kDegree},
                                   {jump.land - 0.08, 55.0 * kDegree},
                                   {jump.land + 0.14, 0.0}});
    foot.pressure = MinJerkTrack({{jump.leave - 0.40, mid},
                                  {jump.leave - 0.06, toes},
                                  {jump.land + 0.04, toes},
                                  {jump.land + 0.35, mid}});
  }
  return feet;
}

}  // namespace

std::vector<PlanFrame> plan_jump(const PlanRequest& request) {
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
  std::vector<PlanFrame> plan(static_cast<std::size_t>(request.frames), stand);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const double t = time_of(i);
    hold_postures(keys, t, plan[i]);
    place_feet(feet, t, plan[i]);
    plan[i].com_height = height.at(t);
    plan[i].flight = t > jump.leave - 0.01 && t < jump.land + 0.01;
  }
  return plan;
}

}  // namespace mimicx
