#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "synth/gait.h"
#include "synth/kinds.h"

namespace mimicx::synth {
namespace {

constexpr double kSettle = 0.55;     ///< from standing to the first step and back, s
constexpr double kRest = 0.90;       ///< standing after the last step, s
constexpr double kClearance = 0.05;  ///< of the sole in mid-swing, m

/// A standing plan with the given feet.
PerFrame<PlanFrame> frames_on(const PlanRequest& request, const FeetTracks& feet) {
  PerFrame<PlanFrame> plan = request.every_frame(standing_frame(request.character, feet));
  for (int i = 0; i < plan.count(); ++i) place_feet(feet, time_of(i), plan[i]);
  return plan;
}

/// A straight or curved walk. The turn happens over the middle steps.
/// @param width  of the track in units of the rest pose's
PerFrame<PlanFrame> walk_along(const PlanRequest& request, double speed, double turn, double width) {
  Random& random = request.random;
  const double half_width = width * rest_half_width(request.character) * random.uniform(0.92, 1.08);
  const double toes_out = random.uniform(4.0, 8.0) * kDegree;
  // Steps grow with the square root of the speed; slow walkers stand on both feet longer.
  const double step =
      0.75 * std::sqrt(speed / 1.15) * random.uniform(0.96, 1.04) * leg_length(request.character);
  const double period = step / speed, swing = (random.uniform(0.80, 0.82) + 0.2 * (speed - 1.15)) * period;
  const double begin = random.uniform(0.85, 0.95);
  const int first = static_cast<int>(random.below(2));
  const int steps = static_cast<int>((request.seconds() - begin - kRest) / period);
  const MinJerkTrack heading({{0.5, 0.0}, {std::max(1.0, steps - 1.5), turn}});
  std::vector<FootSwing> swings;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (int k = 0; k < steps; ++k) {
    const double yaw = heading.at(k);
    const Eigen::Vector2d ahead(cos(yaw), sin(yaw)), left(-ahead.y(), ahead.x());
    // The first step is shorter, the last one brings the feet together.
    middle += (k == 0 ? 0.7 * step : k + 1 < steps ? step : 0.0) * ahead;
    const int side = (first + k) % 2;
    const double mirror = side == 0 ? 1.0 : -1.0, t = begin + k * period;
    swings.push_back(
        {side, t, t + swing, middle + mirror * half_width * left, yaw + mirror * toes_out, kClearance});
  }
  const FeetTracks feet = stepping_feet(request.character, feet_apart(half_width, toes_out), swings, kSettle);
  PerFrame<PlanFrame> plan = frames_on(request, feet);
  face_along_feet(plan);
  const double vigour = speed / 1.15;
  const GaitStyle style = {vigour * random.uniform(18.0, 26.0) * kDegree,
                           vigour * random.uniform(4.0, 6.0) * kDegree, random.uniform(2.0, 3.5) * kDegree,
                           vigour * random.uniform(2.0, 4.0) * kDegree};
  follow_feet(request.character, style, step, feet, plan);
  return plan;
}

}  // namespace

PerFrame<PlanFrame> plan_walk(const PlanRequest& request) {
  return walk_along(request, request.random.uniform(0.85, 1.25), 0.0, 0.785);
}

PerFrame<PlanFrame> plan_walk_turn(const PlanRequest& request) {
  const double side = request.random.below(2) == 0 ? 1.0 : -1.0;
  const double turn = side * request.random.uniform(35.0, 75.0) * kDegree;
  return walk_along(request, request.random.uniform(0.85, 1.05), turn, 1.05);
}

PerFrame<PlanFrame> plan_side_step(const PlanRequest& request) {
  Random& random = request.random;
  const auto start = random_stance(request, 0.95, 1.1, 4.0, 9.0);
  const int away = static_cast<int>(random.below(2));  // which side the first half goes to
  const double width = random.uniform(0.28, 0.38) * leg_length(request.character);
  const double swing = random.uniform(0.42, 0.48), both = random.uniform(0.18, 0.24), turning = 0.35;
  const double begin = random.uniform(0.85, 0.95), pair = 2.0 * (swing + both);
  const int pairs = std::max(1, static_cast<int>((request.seconds() - begin - kRest - turning) / pair));
  std::vector<FootSwing> swings;
  double t = begin, y = 0.0;
  for (int k = 0; k < pairs; ++k) {
    const bool back = k >= (pairs + 1) / 2;
    if (k > 0 && k == (pairs + 1) / 2) t += turning;
    const int lead = back ? 1 - away : away;
    y += (lead == 0 ? 1.0 : -1.0) * width;
    for (int side : {lead, 1 - lead}) {
      const FootTarget& from = start[side];
      swings.push_back({side, t, t + swing, from.place + Eigen::Vector2d(0.0, y), from.yaw, kClearance});
      t += swing + both;
    }
  }
  const FeetTracks feet = stepping_feet(request.character, start, swings, kSettle);
  PerFrame<PlanFrame> plan = frames_on(request, feet);
  const GaitStyle style = {0.0, 0.0, random.uniform(1.5, 3.0) * kDegree, random.uniform(1.0, 3.0) * kDegree};
  follow_feet(request.character, style, width, feet, plan);
  return plan;
}

PerFrame<PlanFrame> plan_turn_in_place(const PlanRequest& request) {
  Random& random = request.random;
  const auto start = random_stance(request, 1.0, 1.15, 4.0, 9.0);
  const int inner = static_cast<int>(random.below(2));  // steps first
  const double turn = (inner == 0 ? 1.0 : -1.0) * random.uniform(26.0, 38.0) * kDegree;
  const double swing = random.uniform(0.40, 0.46), both = random.uniform(0.16, 0.22);
  const double begin = random.uniform(0.85, 0.95);
  const int pairs = static_cast<int>((request.seconds() - begin - kRest) / (2.0 * (swing + both)));
  std::vector<FootSwing> swings;
  double t = begin;
  for (int k = 1; k <= pairs; ++k)
    for (int side : {inner, 1 - inner}) {
      const FootTarget& from = start[side];
      const Eigen::Vector2d place = Eigen::Rotation2Dd(k * turn) * from.place;
      swings.push_back({side, t, t + swing, place, from.yaw + k * turn, kClearance});
      t += swing + both;
    }
  const FeetTracks feet = stepping_feet(request.character, start, swings, kSettle);
  PerFrame<PlanFrame> plan = frames_on(request, feet);
  face_along_feet(plan);
  const GaitStyle style = {0.0, 0.0, random.uniform(1.5, 3.0) * kDegree, random.uniform(0.5, 2.0) * kDegree};
  follow_feet(request.character, style, leg_length(request.character), feet, plan);
  return plan;
}

}  // namespace mimicx::synth
