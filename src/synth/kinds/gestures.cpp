// Gestures of the arms while standing: reaching, talking, stretching, swinging.

#include "synth/choreography.h"
#include "synth/kinds/random_postures.h"

namespace mimicx::synth {
namespace {

Choreography standing(const PlanRequest& request, double wide) {
  Choreography c(request, random_stance(request, 0.95, wide, 4.0, 16.0), 0.5);
  c.pause(request.random.uniform(0.2, 0.4));
  return c;
}

}  // namespace

PerFrame<PlanFrame> plan_reach(const PlanRequest& request) {
  Choreography c = standing(request, 1.4);
  while (true) {
    Random& random = c.random();
    const double out = random.uniform(0.6, 1.0), hold = random.uniform(0.1, 0.5),
                 back = random.uniform(0.6, 0.9);
    if (out + hold + back + 0.8 > c.left()) break;
    const int side = static_cast<int>(random.below(3));
    const double high = random.uniform(20.0, 138.0) * kDegree, aside = random.uniform(8.0, 55.0) * kDegree;
    PlanFrame there = random_posture(random, c.stand(), 0.5);
    for (int arm = 0; arm < 2; ++arm)
      there.arm[arm] = side == 2 || side == arm
                           ? ArmPosture{high, aside, 0.0, random.uniform(6.0, 25.0) * kDegree}
                           : c.stand().arm[arm];
    if (side < 2) there.trunk.y() = (side == 0 ? -1.0 : 1.0) * random.uniform(0.0, 20.0) * kDegree;
    there = c.crouched(there, random.uniform(9.0, 30.0));
    c.pose(there, out);
    c.pause(hold);
    if (random.below(2) == 0) c.pose(c.stand(), back);
  }
  c.pose(c.stand(), 0.8);
  return c.finished(kQuiet);
}

PerFrame<PlanFrame> plan_talk(const PlanRequest& request) {
  Choreography c = standing(request, 1.2);
  while (c.left() > 2.0) {
    Random& random = c.random();
    PlanFrame said = random_posture(random, c.stand(), 0.22);
    for (ArmPosture& arm : said.arm)
      arm = {random.uniform(0.0, 55.0) * kDegree, random.uniform(8.0, 35.0) * kDegree,
             random.uniform(-5.0, 40.0) * kDegree, random.uniform(15.0, 100.0) * kDegree};
    c.pose(said, random.uniform(0.40, 0.8));
    c.pause(random.uniform(0.0, 0.4));
  }
  c.pose(c.stand(), 0.7);
  return c.finished(kQuiet);
}

PerFrame<PlanFrame> plan_stretch(const PlanRequest& request) {
  Choreography c = standing(request, 1.6);
  while (c.left() > 4.1) {
    Random& random = c.random();
    PlanFrame bent = c.stand();
    const double lean = random.uniform(-8.0, 10.0), twist = random.uniform(-34.0, 34.0),
                 tilt = random.uniform(-24.0, 24.0);
    bent.trunk = kDegree * Vector3d(lean, twist, tilt);
    bent.pelvis.z() = 0.15 * bent.trunk.z();
    for (ArmPosture& arm : bent.arm)
      arm = {random.uniform(0.0, 40.0) * kDegree, random.uniform(20.0, 130.0) * kDegree,
             random.uniform(0.0, 60.0) * kDegree, random.uniform(8.0, 60.0) * kDegree};
    c.pose(bent, random.uniform(0.8, 1.2));
    c.pause(random.uniform(0.2, 0.6));
    if (random.below(2) == 0) {
      bent.trunk = Vector3d(bent.trunk.x(), -bent.trunk.y(), -bent.trunk.z());
      bent.pelvis.z() = -bent.pelvis.z();
      c.pose(bent, random.uniform(1.0, 1.3));
    }
  }
  c.pose(c.stand(), 0.9);
  return c.finished(kQuiet);
}

PerFrame<PlanFrame> plan_arm_swings(const PlanRequest& request) {
  Choreography c = standing(request, 1.3);
  Random& random = c.random();
  const double pace = random.uniform(0.40, 0.65);
  PlanFrame first = c.stand(), second = c.stand();
  const bool crossed = random.below(2) == 0;  // one arm ahead, the other behind
  const double out = random.uniform(15.0, 110.0), ahead = random.uniform(20.0, 100.0),
               behind = random.uniform(10.0, 35.0);
  for (int side = 0; side < 2; ++side) {
    const bool forward = !crossed || side == 0;
    first.arm[side] = {(forward ? ahead : -behind) * kDegree, 10.0 * kDegree, 0.0, 20.0 * kDegree};
    second.arm[side] =
        crossed ? ArmPosture{(forward ? -behind : ahead) * kDegree, 10.0 * kDegree, 0.0, 20.0 * kDegree}
                : ArmPosture{0.0, out * kDegree, 10.0 * kDegree, 15.0 * kDegree};
  }
  const double twist = random.uniform(0.0, 18.0) * kDegree;
  first.trunk.y() = twist;
  second.trunk.y() = -twist;
  first = c.crouched(first, random.uniform(10.0, 35.0));
  while (c.left() > 2.0 * pace + 0.8) {
    c.pose(first, pace);
    c.pose(second, pace);
  }
  c.pose(c.stand(), 0.7);
  return c.finished(kQuiet);
}

}  // namespace mimicx::synth
