// Low postures: crouches, picking up, sitting without a chair, lunges in every direction.
#include <cmath>

#include "core/elementary.h"
#include "synth/choreography.h"
#include "synth/kinds/random_postures.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

Choreography wide(const PlanRequest& request) {
  Choreography c(request, random_stance(request, 1.2, 1.6, 8.0, 20.0), 0.5);
  c.pause(request.random.uniform(0.25, 0.45));
  return c;
}

/// Hips back, arms ahead, looking ahead.
PlanFrame crouch(Choreography& c, double knee_degrees) {
  Random& random = c.random();
  const double deep = knee_degrees / 90.0;
  PlanFrame low = c.stand();
  low.pelvis.x() = deep * random.uniform(16.0, 26.0) * kDegree;
  low.trunk.x() = deep * random.uniform(8.0, 24.0) * kDegree;
  low.head.x() = -0.7 * (low.pelvis.x() + low.trunk.x());
  for (ArmPosture& arm : low.arm) {
    arm.forward = deep * random.uniform(50.0, 110.0) * kDegree;
    arm.out = random.uniform(6.0, 25.0) * kDegree;
    arm.elbow = random.uniform(8.0, 60.0) * kDegree;
  }
  return c.crouched(low, knee_degrees);
}

}  // namespace

PerFrame<PlanFrame> plan_crouch(const PlanRequest& request) {
  Choreography c = wide(request);
  while (true) {
    Random& random = c.random();
    const double knee = random.uniform(50.0, 98.0), down = random.uniform(0.85, 1.2) * (0.6 + knee / 200.0);
    const int moves = static_cast<int>(random.below(3));
    if (2.0 * down + 0.8 * moves + 0.6 > c.left()) break;
    const PlanFrame low = crouch(c, knee);
    c.pose(low, down);
    for (int k = 0; k < moves; ++k) {
      PlanFrame busy = random_posture(random, low, 0.4);
      busy.pelvis = low.pelvis;
      busy.com_height = low.com_height;
      c.pose(busy, random.uniform(0.55, 0.8));
    }
    c.pause(random.uniform(0.1, 0.4));
    c.pose(c.stand(), down);
    c.pause(random.uniform(0.15, 0.4));
  }
  return c.finished(kQuiet);
}

PerFrame<PlanFrame> plan_sit(const PlanRequest& request) {
  Choreography c = wide(request);
  while (true) {
    Random& random = c.random();
    const double down = random.uniform(1.1, 1.6), hold = random.uniform(0.3, 1.2),
                 up = random.uniform(0.9, 1.3);
    if (down + hold + up > c.left()) break;
    PlanFrame seat = c.stand();  // as on a chair: the trunk balances the hips
    seat.pelvis.x() = random.uniform(18.0, 30.0) * kDegree;
    seat.trunk.x() = random.uniform(14.0, 26.0) * kDegree;
    seat.head.x() = -0.75 * (seat.pelvis.x() + seat.trunk.x());
    for (ArmPosture& arm : seat.arm)
      arm = {random.uniform(55.0, 90.0) * kDegree, 16.0 * kDegree, 0.0, random.uniform(10.0, 70.0) * kDegree};
    seat = c.crouched(seat, random.uniform(70.0, 92.0));
    c.pose(seat, down);
    c.pause(hold);
    c.pose(c.stand(), up);
    c.pause(random.uniform(0.2, 0.5));
  }
  return c.finished(kQuiet);
}

PerFrame<PlanFrame> plan_pick_up(const PlanRequest& request) {
  Choreography c = wide(request);
  while (true) {
    Random& random = c.random();
    const double down = random.uniform(1.0, 1.4), hold = random.uniform(0.2, 0.5),
                 up = random.uniform(1.0, 1.3), carry = random.uniform(0.6, 0.9);
    if (down + hold + up + 2.0 * carry > c.left()) break;
    const int hand = static_cast<int>(random.below(3));  // left, right, both
    const double aside = random.uniform(-22.0, 22.0) * kDegree;
    PlanFrame low = c.stand();
    low.pelvis.x() = random.uniform(30.0, 44.0) * kDegree;
    low.trunk.x() = random.uniform(26.0, 44.0) * kDegree;
    low.trunk.y() = aside;
    low.head.x() = -random.uniform(0.0, 20.0) * kDegree;
    for (int side = 0; side < 2; ++side)
      low.arm[side] = hand == 2 || hand == side
                          ? ArmPosture{low.pelvis.x() + low.trunk.x() + random.uniform(-5.0, 20.0) * kDegree,
                                       8.0 * kDegree, 0.0, 12.0 * kDegree}
                          : ArmPosture{-10.0 * kDegree, 22.0 * kDegree, 0.0, 30.0 * kDegree};
    low = c.crouched(low, random.uniform(35.0, 80.0));
    PlanFrame lifted = c.stand();
    for (int side = 0; side < 2; ++side)
      if (hand == 2 || hand == side)
        lifted.arm[side] = {random.uniform(20.0, 60.0) * kDegree, 10.0 * kDegree, 0.0,
                            random.uniform(40.0, 90.0) * kDegree};
    c.pose(low, down);
    c.pause(hold);
    c.pose(lifted, up);
    c.pause(0.1);
    c.pose(c.stand(), carry);
    c.pause(random.uniform(0.1, 0.3));
  }
  return c.finished(kQuiet);
}

PerFrame<PlanFrame> plan_lunge_around(const PlanRequest& request) {
  Choreography c(request, random_stance(request, 1.0, 1.2, 5.0, 10.0), 0.5);
  const double leg = leg_length(request.character);
  c.pause(request.random.uniform(0.4, 0.6));
  while (true) {
    Random& random = c.random();
    const double swing = random.uniform(0.50, 0.60), down = random.uniform(0.65, 0.85),
                 hold = random.uniform(0.1, 0.4), up = random.uniform(0.65, 0.85);
    if (1.1 + 2.0 * swing + down + hold + up > c.left()) break;
    const int side = static_cast<int>(random.below(2));
    const double mirror = side == 0 ? 1.0 : -1.0;
    const FootTarget home = c.feet()[side];
    // Anywhere but across the other foot.
    const double angle = mirror * random.uniform(0.0, 150.0) * kDegree,
                 length = random.uniform(0.30, 0.55) * leg;
    const Eigen::Vector2d there = home.place + length * Eigen::Vector2d(cos(angle), sin(angle));
    const double yaw = home.yaw + mirror * 0.25 * std::abs(angle) * (std::abs(angle) < 1.8 ? 1.0 : 0.0);
    PlanFrame split = poised_posture(c.stand());
    split.com_height -= (0.03 + 0.10 * length / leg) * leg;
    c.settle();
    c.pose_while(split, swing);
    c.step(side, there, yaw, swing);
    PlanFrame low = random_posture(random, split, 0.3);
    low.pelvis = Vector3d(random.uniform(4.0, 16.0) * kDegree, 0.0, 0.0);
    low.com_height = split.com_height - random.uniform(0.05, 0.14) * leg;
    c.pose(low, down);
    c.pause(hold);
    c.pose(split, up);
    c.pose_while(c.stand(), swing + 0.3);
    c.step(side, home.place, home.yaw, swing);
    c.settle();
  }
  return c.finished(kQuiet);
}

}  // namespace mimicx::synth
