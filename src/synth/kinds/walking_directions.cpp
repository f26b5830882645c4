// Walking in every direction: one walker whose steps are given one by one.

#include "core/elementary.h"
#include "synth/choreography.h"

namespace mimicx::synth {
namespace {

/// A pair of steps in the walker's own frame.
struct WalkSegment {
  double ahead, aside;  ///< m, x forward and y left
  double turn;          ///< rad, to the left
  double swing, both;   ///< s, a foot in the air, and both on the floor after it
  double half_width;    ///< of the middle to each foot, m
};

/// Position and heading of the walker's middle.
struct Walker {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double yaw = 0.0, toes_out = 0.0;

  /// A foot goes to its side of where the walker is now.
  void put(Choreography& c, int side, const WalkSegment& stretch) const {
    const double mirror = side == 0 ? 1.0 : -1.0;
    const Eigen::Vector2d left(-sin(yaw), cos(yaw));
    c.step(side, middle + mirror * stretch.half_width * left, yaw + mirror * toes_out, stretch.swing);
    c.pause(stretch.both);
  }
};

/// A pair of steps. The foot on the side that the pair goes or turns to begins and takes all of that way, so
/// that feet never cross; what goes ahead is shared.
void pair_of_steps(Choreography& c, Walker& walker, const WalkSegment& stretch) {
  const double to_side = stretch.aside != 0.0 ? stretch.aside : stretch.turn;
  const int lead = to_side > 0.0 ? 0 : to_side < 0.0 ? 1 : static_cast<int>(c.random().below(2));
  walker.yaw += stretch.turn;
  const Eigen::Rotation2Dd own(walker.yaw);
  walker.middle += own * Eigen::Vector2d(0.5 * stretch.ahead, stretch.aside);
  walker.put(c, lead, stretch);
  walker.middle += own * Eigen::Vector2d(0.5 * stretch.ahead, 0.0);
  walker.put(c, 1 - lead, stretch);
}

/// The feet side by side again.
void close_feet(Choreography& c, const Walker& walker, const WalkSegment& stretch, int side) {
  walker.put(c, side, stretch);
}

WalkSegment random_pace(const PlanRequest& request) {
  Random& random = request.random;
  WalkSegment pace{};
  pace.swing = random.uniform(0.42, 0.52);
  pace.both = random.uniform(0.12, 0.20);
  pace.half_width = rest_half_width(request.character) * random.uniform(0.95, 1.08);
  return pace;
}

GaitStyle random_style(Random& random, double arms) {
  const double swing = arms * random.uniform(10.0, 24.0) * kDegree, turn = random.uniform(2.0, 5.0) * kDegree;
  const double drop = random.uniform(1.5, 3.0) * kDegree, lean = random.uniform(0.0, 3.0) * kDegree;
  return {swing, turn, drop, lean};
}

Choreography at_ease(const PlanRequest& request) {
  Choreography c(request, random_stance(request, 0.95, 1.08, 4.0, 8.0), 0.55);
  c.pause(request.random.uniform(0.3, 0.4));
  c.settle();
  return c;
}

constexpr double kClosing = 0.9;  ///< kept for the last step, s

/// Walks by `next` until the time is over. @param next  the pair of steps to take
template <class Next>
PerFrame<PlanFrame> walked(const PlanRequest& request, double arms, const Next& next) {
  Choreography c = at_ease(request);
  Walker walker;
  walker.toes_out = c.feet()[0].yaw;
  WalkSegment last{};
  for (int pair = 0;; ++pair) {
    const WalkSegment stretch = next(c, pair);
    if (2.0 * (stretch.swing + stretch.both) + kClosing > c.left()) break;
    pair_of_steps(c, walker, stretch);
    last = stretch;
  }
  if (last.ahead != 0.0) {
    // The foot that is behind comes up to the other one.
    const Eigen::Vector2d ahead(cos(walker.yaw), sin(walker.yaw));
    const double way = ahead.dot(c.feet()[0].place - c.feet()[1].place) * (last.ahead > 0.0 ? 1.0 : -1.0);
    close_feet(c, walker, last, way < 0.0 ? 0 : 1);
  }
  return c.finished(random_style(request.random, arms));
}

}  // namespace

PerFrame<PlanFrame> plan_walk_back(const PlanRequest& request) {
  const double leg = leg_length(request.character);
  WalkSegment pace = random_pace(request);
  const double step = request.random.uniform(0.25, 0.42) * leg;
  const double curve = request.random.uniform(-10.0, 10.0) * kDegree;
  return walked(request, 0.6, [&](Choreography&, int pair) {
    pace.ahead = -step * (pair == 0 ? 1.4 : 2.0);
    pace.turn = pair == 0 ? 0.0 : curve;
    return pace;
  });
}

PerFrame<PlanFrame> plan_walk_diagonal(const PlanRequest& request) {
  const double leg = leg_length(request.character);
  WalkSegment pace = random_pace(request);
  const double ahead = request.random.uniform(-0.4, 0.5) * leg;
  const double side = request.random.below(2) == 0 ? 1.0 : -1.0,
               aside = side * request.random.uniform(0.10, 0.26) * leg;
  return walked(request, 0.5, [&](Choreography&, int) {
    pace.ahead = ahead;
    pace.aside = aside;
    return pace;
  });
}

PerFrame<PlanFrame> plan_walk_curve(const PlanRequest& request) {
  const double leg = leg_length(request.character);
  WalkSegment pace = random_pace(request);
  const double step = request.random.uniform(0.30, 0.50) * leg;
  const double side = request.random.below(2) == 0 ? 1.0 : -1.0;
  double curve = side * request.random.uniform(12.0, 32.0) * kDegree;
  const bool weaves = request.random.below(2) == 0;
  return walked(request, 1.0, [&](Choreography&, int pair) {
    pace.ahead = step * (pair == 0 ? 1.4 : 2.0);
    if (weaves && pair > 0 && pair % 3 == 0) curve = -curve;
    pace.turn = curve;
    return pace;
  });
}

PerFrame<PlanFrame> plan_walk_stop(const PlanRequest& request) {
  const double leg = leg_length(request.character);
  WalkSegment pace = random_pace(request);
  int left = 0;
  double step = 0.0;
  return walked(request, 0.8, [&](Choreography& c, int) {
    if (left-- == 0) {  // another speed, perhaps after a pause
      if (step != 0.0 && c.random().below(2) == 0) c.pause(c.random().uniform(0.3, 0.9));
      left = 1 + static_cast<int>(c.random().below(2));
      step = c.random().uniform(-0.25, 0.45) * leg;
      pace.swing = c.random().uniform(0.42, 0.55);
      pace.turn = c.random().uniform(-14.0, 14.0) * kDegree;
    }
    pace.ahead = 1.6 * step;
    return pace;
  });
}

PerFrame<PlanFrame> plan_shuffle(const PlanRequest& request) {
  const double leg = leg_length(request.character);
  WalkSegment pace = random_pace(request);
  return walked(request, 0.3, [&](Choreography& c, int) {
    pace.ahead = c.random().uniform(-0.25, 0.25) * leg;
    pace.aside = c.random().uniform(-0.15, 0.15) * leg;
    pace.turn = c.random().uniform(0.0, 20.0) * kDegree * (pace.aside < 0.0 ? -1.0 : 1.0);
    pace.swing = c.random().uniform(0.36, 0.46);
    pace.both = c.random().uniform(0.12, 0.40);
    return pace;
  });
}

PerFrame<PlanFrame> plan_turn_around(const PlanRequest& request) {
  WalkSegment pace = random_pace(request);
  pace.swing += 0.06;
  double turn = 0.0;
  int left = 0;
  return walked(request, 0.3, [&](Choreography& c, int) {
    if (left-- == 0) {
      left = 1 + static_cast<int>(c.random().below(3));
      const double side = c.random().below(2) == 0 ? 1.0 : -1.0;
      turn = side * c.random().uniform(15.0, 58.0) * kDegree;
    }
    pace.turn = turn;
    return pace;
  });
}

PerFrame<PlanFrame> plan_walk_crouched(const PlanRequest& request) {
  const double leg = leg_length(request.character);
  Choreography c = at_ease(request);
  Walker walker;
  walker.toes_out = c.feet()[0].yaw;
  WalkSegment pace = random_pace(request);
  PlanFrame low = c.stand();
  low.pelvis.x() = c.random().uniform(8.0, 24.0) * kDegree;
  low.trunk.x() = c.random().uniform(4.0, 22.0) * kDegree;
  low.head.x() = -0.8 * (low.pelvis.x() + low.trunk.x());
  for (ArmPosture& arm : low.arm) arm.forward = c.random().uniform(0.0, 40.0) * kDegree;
  low = c.crouched(low, c.random().uniform(35.0, 62.0));
  c.pose(low, c.random().uniform(0.8, 1.1));
  const double step = c.random().uniform(0.18, 0.36) * leg;
  while (2.0 * (pace.swing + pace.both) + kClosing + 1.0 < c.left()) {
    pace.ahead = 2.0 * step;
    pace.turn = c.random().uniform(-8.0, 8.0) * kDegree;
    pair_of_steps(c, walker, pace);
  }
  const Eigen::Vector2d ahead(cos(walker.yaw), sin(walker.yaw));
  close_feet(c, walker, pace, ahead.dot(c.feet()[0].place - c.feet()[1].place) < 0.0 ? 0 : 1);
  c.pose(c.stand(), 0.9);
  return c.finished(random_style(request.random, 0.4));
}

}  // namespace mimicx::synth
