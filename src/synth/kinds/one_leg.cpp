// On one leg: balancing, marching, and kicks in every direction.
#include <algorithm>

#include "synth/choreography.h"
#include "synth/kinds/random_postures.h"

namespace mimicx::synth {
namespace {

Choreography feet_together(const PlanRequest& request) {
  Choreography c(request, random_stance(request, 0.95, 1.1, 4.0, 10.0), 0.6);
  c.pause(request.random.uniform(0.2, 0.4));
  return c;
}

/// A foot in the air: before, beside or behind the body.
enum Direction { kFront, kSide, kBack };

/// The trunk leans against the leg.
void lean_against(Direction direction, int side, double amount, PlanFrame& posture) {
  const double mirror = side == 0 ? 1.0 : -1.0;
  switch (direction) {
    case kFront:
      posture.pelvis.x() -= 8.0 * amount * kDegree;
      posture.trunk.x() += 4.0 * amount * kDegree;
      break;
    case kSide:
      posture.pelvis.z() += 10.0 * amount * mirror * kDegree;
      posture.trunk.z() -= 4.0 * amount * mirror * kDegree;
      break;
    case kBack:
      posture.pelvis.x() += 26.0 * amount * kDegree;
      posture.trunk.x() += 6.0 * amount * kDegree;
      posture.head.x() -= 22.0 * amount * kDegree;
      break;
  }
}

RaisedFoot place_of(Direction direction, double leg, double amount, Random& random) {
  switch (direction) {
    case kFront: {
      const double ahead = random.uniform(0.10, 0.55) * amount, lift = random.uniform(0.12, 0.45) * amount;
      return {ahead * leg, 0.0, lift * leg, random.uniform(-18.0, 15.0) * kDegree};
    }
    case kSide: {
      const double out = random.uniform(0.15, 0.40) * amount, lift = random.uniform(0.08, 0.26) * amount;
      return {random.uniform(-0.03, 0.08) * leg, out * leg, lift * leg, random.uniform(-14.0, 6.0) * kDegree};
    }
    case kBack: {
      const double behind = random.uniform(0.12, 0.38) * amount, lift = random.uniform(0.08, 0.25) * amount;
      return {-behind * leg, 0.02 * leg, lift * leg, -random.uniform(20.0, 42.0) * kDegree};
    }
  }
  return {};
}

Direction any_direction(Random& random) { return static_cast<Direction>(random.below(3)); }

}  // namespace

PerFrame<PlanFrame> plan_balance(const PlanRequest& request) {
  Choreography c = feet_together(request);
  const double leg = leg_length(request.character);
  while (true) {
    Random& random = c.random();
    const double up = random.uniform(0.7, 1.0), hold = random.uniform(0.5, 1.6),
                 down = random.uniform(0.6, 0.8);
    if (0.7 + up + hold + down + 0.7 > c.left()) break;
    const int side = static_cast<int>(random.below(2));
    const Direction direction = any_direction(random);
    const RaisedFoot place = place_of(direction, leg, 1.0, random);
    PlanFrame held = random_posture(random, poised_posture(c.stand()), 0.35);
    lean_against(direction, side, random.uniform(0.4, 1.0), held);
    held.com_height -= 0.012 * leg;
    c.settle();
    c.raise(side, {{place, up}, {place, hold}}, {held, held}, down);
    c.pose_while(c.stand(), 0.7);
    c.settle();
    c.pause(random.uniform(0.15, 0.4));
  }
  return c.finished(kQuiet);
}

PerFrame<PlanFrame> plan_kick_around(const PlanRequest& request) {
  Choreography c = feet_together(request);
  const double leg = leg_length(request.character);
  const PlanFrame poised = poised_posture(c.stand());
  while (true) {
    Random& random = c.random();
    const double fold = random.uniform(0.28, 0.36), strike = random.uniform(0.22, 0.34),
                 back = random.uniform(0.24, 0.34), down = random.uniform(0.30, 0.40);
    if (0.7 + fold + strike + back + down + 0.7 > c.left()) break;
    const int side = static_cast<int>(random.below(2));
    const Direction direction = any_direction(random);
    RaisedFoot place = place_of(direction, leg, 1.0, random);
    place.lift = std::max(place.lift, 0.16 * leg);
    const RaisedFoot folded = {(direction == kBack ? -0.05 : 0.05) * leg, 0.02 * leg,
                               random.uniform(0.18, 0.28) * leg, -20.0 * kDegree};
    PlanFrame struck = random_posture(random, poised, 0.25);
    lean_against(direction, side, random.uniform(0.5, 1.1), struck);
    PlanFrame ready = poised;
    ready.com_height -= 0.012 * leg;
    struck.com_height = ready.com_height;
    c.pose_while(ready, 0.55);
    c.settle();
    c.raise(side, {{folded, fold}, {place, strike}, {folded, back}}, {ready, struck, ready}, down);
    c.pose_while(c.stand(), 0.7);
    c.settle();
    c.pause(random.uniform(0.1, 0.3));
  }
  return c.finished(kQuiet);
}

PerFrame<PlanFrame> plan_march(const PlanRequest& request) {
  Choreography c = feet_together(request);
  const double leg = leg_length(request.character);
  const double height = c.random().uniform(0.15, 0.34), up = c.random().uniform(0.32, 0.42),
               down = c.random().uniform(0.30, 0.38), both = c.random().uniform(0.14, 0.24);
  const double arms = c.random().uniform(10.0, 45.0) * kDegree;
  int side = static_cast<int>(c.random().below(2));
  c.settle();
  while (up + down + both + 0.7 < c.left()) {
    const RaisedFoot knee = {c.random().uniform(0.10, 0.22) * leg, 0.0,
                             height * c.random().uniform(0.85, 1.15) * leg, -25.0 * kDegree};
    PlanFrame raised = c.stand();
    raised.arm[1 - side].forward += arms;
    raised.arm[1 - side].elbow += 1.2 * arms;
    raised.arm[side].forward -= 0.6 * arms;
    raised.pelvis.x() -= 3.0 * kDegree;
    c.raise(side, {{knee, up}}, {raised}, down);
    c.pause(both);
    side = 1 - side;
  }
  c.pose_while(c.stand(), 0.6);
  return c.finished(kQuiet);
}

}  // namespace mimicx::synth
