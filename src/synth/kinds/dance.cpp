#include <algorithm>

#include "synth/gait.h"
#include "synth/kinds.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

constexpr int kBeats = 4;  ///< of a figure
constexpr double kBegin = 0.85, kDanceRest = 0.75;

/// A dance under construction: position of the dancer and steps so far.
struct Dance {
  const PlanRequest& request;
  PerSide<FootTarget> stance;  ///< about the dancer's middle
  PlanFrame stand;
  double beat;                                       ///< s
  double time = kBegin;                              ///< beginning of the next figure
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< of the feet
  double yaw = 0.0;
  std::vector<FootSwing> swings;
  std::vector<PostureKey> keys;

  double at(double beats) const { return time + beats * beat; }
  /// One foot goes to its place in the stance at `to`, `turned`.
  void step(int side, double beats, const Eigen::Vector2d& to, double turned) {
    const FootTarget& foot = stance[side];
    swings.push_back({side, at(beats), at(beats + 0.74), to + Eigen::Rotation2Dd(turned) * foot.place,
                      turned + foot.yaw, 0.05});
  }
  void hold(double beats, const PlanFrame& posture) { keys.push_back({at(beats), posture}); }
  /// A direction of the dancer's own, x forward and y left, on the floor.
  Eigen::Vector2d own(double x, double y) const { return Eigen::Rotation2Dd(yaw) * Eigen::Vector2d(x, y); }
};

PlanFrame with_arms(const PlanFrame& frame, const ArmPosture& left, const ArmPosture& right) {
  PlanFrame posture = frame;
  posture.arm = {left, right};
  return posture;
}

constexpr ArmPosture kOut = {10.0 * kDegree, 72.0 * kDegree, 20.0 * kDegree, 30.0 * kDegree};
constexpr ArmPosture kUp = {10.0 * kDegree, 112.0 * kDegree, 60.0 * kDegree, 50.0 * kDegree};
constexpr ArmPosture kAhead = {75.0 * kDegree, 8.0 * kDegree, 0.0, 25.0 * kDegree};

/// Aside and together, there and back; the arms open with each step.
void side_steps(Dance& d) {
  const int lead = static_cast<int>(d.request.random.below(2));
  const double mirror = lead == 0 ? 1.0 : -1.0;
  const double width = d.request.random.uniform(0.26, 0.34) * leg_length(d.request.character);
  const Eigen::Vector2d there = d.middle + d.own(0.0, mirror * width);
  d.step(lead, 0.0, there, d.yaw);
  d.step(1 - lead, 1.0, there, d.yaw);
  d.step(1 - lead, 2.0, d.middle, d.yaw);
  d.step(lead, 3.0, d.middle, d.yaw);
  d.hold(0.0, d.stand);
  d.hold(1.0, with_arms(d.stand, kOut, kOut));
  d.hold(2.0, d.stand);
  d.hold(3.0, with_arms(d.stand, kOut, kOut));
}

/// Forward and back; the arms reach ahead in turn.
void steps_ahead(Dance& d) {
  const int lead = static_cast<int>(d.request.random.below(2));
  const double length = d.request.random.uniform(0.28, 0.40) * leg_length(d.request.character);
  const Eigen::Vector2d there = d.middle + d.own(length, 0.0);
  d.step(lead, 0.0, there, d.yaw);
  d.step(1 - lead, 1.0, there, d.yaw);
  d.step(lead, 2.0, d.middle, d.yaw);
  d.step(1 - lead, 3.0, d.middle, d.yaw);
  d.hold(0.0, d.stand);
  d.hold(1.0, with_arms(d.stand, kAhead, d.stand.arm[1]));
  d.hold(2.0, with_arms(d.stand, d.stand.arm[0], kAhead));
  d.hold(3.0, with_arms(d.stand, kOut, kOut));
}

/// A turn in place in two pairs of steps, one arm up.
void turning_steps(Dance& d) {
  const int inner = static_cast<int>(d.request.random.below(2));
  const double part = (inner == 0 ? 1.0 : -1.0) * d.request.random.uniform(24.0, 34.0) * kDegree;
  for (int pair = 0; pair < 2; ++pair) {
    d.yaw += part;
    d.step(inner, 2.0 * pair, d.middle, d.yaw);
    d.step(1 - inner, 2.0 * pair + 1.0, d.middle, d.yaw);
  }
  d.hold(0.0, d.stand);
  d.hold(1.5, inner == 0 ? with_arms(d.stand, kUp, kOut) : with_arms(d.stand, kOut, kUp));
  d.hold(3.0, inner == 0 ? with_arms(d.stand, kUp, kOut) : with_arms(d.stand, kOut, kUp));
}

/// Down into the knees and up with the arms, twice.
void dips(Dance& d) {
  PlanFrame low = with_arms(d.stand, kAhead, kAhead), high = with_arms(d.stand, kUp, kUp);
  low.pelvis.x() = 12.0 * kDegree;
  low.trunk.x() = 10.0 * kDegree;
  low.head.x() = -12.0 * kDegree;
  const double knee = d.request.random.uniform(45.0, 60.0) * kDegree;
  const PlanFrame& stand = d.stand;
  low.com_height = com_height_for_knee(d.request.character, low, stand.pressure, knee);
  d.hold(0.15, d.stand);
  d.hold(1.2, low);
  d.hold(2.3, high);
  d.hold(3.3, low);
}

/// A bow to the audience, the arms spread.
void bow(Dance& d) {
  PlanFrame bowed = with_arms(d.stand, kOut, kOut);
  bowed.pelvis.x() = d.request.random.uniform(16.0, 24.0) * kDegree;
  bowed.trunk.x() = d.request.random.uniform(14.0, 20.0) * kDegree;
  bowed.com_height -= 0.012;
  d.hold(0.15, d.stand);
  d.hold(1.5, bowed);
  d.hold(2.2, bowed);
  d.hold(3.4, d.stand);
}

}  // namespace

PerFrame<PlanFrame> plan_dance(const PlanRequest& request) {
  Random& random = request.random;
  const auto stance = random_stance(request, 1.0, 1.15, 5.0, 9.0);
  const double beat = random.uniform(0.56, 0.60);
  PlanFrame stand = standing_frame(request.character, stance);
  Dance dance{request, stance, stand, beat, kBegin, Eigen::Vector2d::Zero(), 0.0, {}, {{0.0, stand}}};
  constexpr int kFigures = 5;
  Array<void (*)(Dance&), kFigures> figures = {side_steps, steps_ahead, turning_steps, dips, bow};
  const int count =
      std::max(1, static_cast<int>((request.seconds() - kBegin - kDanceRest) / (kBeats * beat)));
  for (int k = 0; k < count; ++k) {
    // Every figure once before any comes again.
    const int left = kFigures - k % kFigures;
    const int chosen = static_cast<int>(random.below(static_cast<std::uint32_t>(left)));
    figures[chosen](dance);
    std::swap(figures[chosen], figures[left - 1]);
    dance.time += kBeats * beat;
  }
  dance.hold(0.0, stand);
  const FeetTracks feet = stepping_feet(request.character, stance, dance.swings, 0.45);
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  hold_postures(dance.keys, feet, plan);
  face_along_feet(plan);
  const GaitStyle style = {6.0 * kDegree, 2.0 * kDegree, random.uniform(2.0, 4.0) * kDegree,
                           random.uniform(0.0, 2.0) * kDegree};
  follow_feet(request.character, style, leg_length(request.character), feet, plan);
  return plan;
}

}  // namespace mimicx::synth
