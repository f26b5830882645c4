#include "synth/kinds/random_postures.h"

#include "core/units.h"

namespace mimicx::synth {
namespace {

double degrees(Random& random, double least, double most) { return random.uniform(least, most) * kDegree; }

}  // namespace

ArmPosture random_arm(Random& random) {
  ArmPosture arm;
  arm.forward = degrees(random, -25.0, 140.0);
  arm.out = degrees(random, 8.0, arm.forward > 90.0 * kDegree ? 50.0 : 95.0);
  arm.rotation = degrees(random, -5.0, 60.0);
  arm.elbow = degrees(random, 8.0, 105.0);
  return arm;
}

PlanFrame random_posture(Random& random, const PlanFrame& stand, double amount) {
  PlanFrame posture = stand;
  const double lean = degrees(random, -4.0, 22.0), turn = degrees(random, -14.0, 14.0),
               side = degrees(random, -4.0, 4.0);
  const double bend = degrees(random, -6.0, 26.0), twist = degrees(random, -28.0, 28.0),
               tilt = degrees(random, -14.0, 14.0);
  const double nod = degrees(random, -20.0, 14.0), look = degrees(random, -35.0, 35.0);
  posture.pelvis += amount * Vector3d(lean, turn, side);
  posture.trunk += amount * Vector3d(bend, twist, tilt);
  posture.head += amount * Vector3d(nod, look, -0.5 * tilt);
  for (ArmPosture& arm : posture.arm) {
    const ArmPosture there = random_arm(random);
    arm.forward += amount * (there.forward - arm.forward);
    arm.out += amount * (there.out - arm.out);
    arm.rotation += amount * (there.rotation - arm.rotation);
    arm.elbow += amount * (there.elbow - arm.elbow);
  }
  return posture;
}

PlanFrame guard_posture(const PlanFrame& stand) {
  PlanFrame guard = stand;
  for (ArmPosture& arm : guard.arm) arm = {42.0 * kDegree, 14.0 * kDegree, 4.0 * kDegree, 112.0 * kDegree};
  guard.pelvis.x() = guard.trunk.x() = 4.0 * kDegree;
  return guard;
}

PlanFrame poised_posture(const PlanFrame& stand) {
  PlanFrame poised = stand;
  for (ArmPosture& arm : poised.arm) arm = {20.0 * kDegree, 35.0 * kDegree, 10.0 * kDegree, 50.0 * kDegree};
  return poised;
}

}  // namespace mimicx::synth
