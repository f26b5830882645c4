// Random sequences of steps, postures, raised legs and crouches.

#include "synth/choreography.h"
#include "synth/kinds/random_postures.h"

namespace mimicx::synth {
namespace {

/// A foot goes somewhere near, never across the other one.
void free_step(Choreography& c, double longest) {
  Random& random = c.random();
  const double leg = leg_length(c.character());
  const int side = static_cast<int>(random.below(2));
  const double mirror = side == 0 ? 1.0 : -1.0;
  const FootTarget& other = c.feet()[1 - side];
  const double turned = mirror * random.uniform(-8.0, 28.0) * kDegree;
  const double base = other.yaw + mirror * 10.0 * kDegree;  // where the other foot looks, without its splay
  const double ahead = random.uniform(-0.75, 1.0) * longest * leg,
               apart = random.uniform(0.19, 0.34 + 0.2 * longest) * leg;
  const Eigen::Vector2d place =
      other.place + Eigen::Rotation2Dd(base) * Eigen::Vector2d(ahead, mirror * apart);
  const double way = (place - c.feet()[side].place).norm();
  const double seconds = random.uniform(0.40, 0.50) + 0.25 * way, clearance = random.uniform(0.04, 0.09);
  c.step(side, place, base + turned, seconds, clearance);
}

/// One leg up for a moment.
void free_raise(Choreography& c) {
  Random& random = c.random();
  const double leg = leg_length(c.character());
  const int side = static_cast<int>(random.below(2));
  const double ahead = random.uniform(-0.35, 0.45), outward = random.uniform(0.0, 0.30),
               lift = random.uniform(0.10, 0.34);
  const RaisedFoot place = {ahead * leg, outward * leg, lift * leg, (ahead < 0.0 ? -35.0 : 0.0) * kDegree};
  PlanFrame held = random_posture(random, poised_posture(c.stand()), 0.4);
  held.pelvis.x() += ahead < 0.0 ? -60.0 * ahead * kDegree : 0.0;
  held.com_height -= 0.02 * leg;
  const double up = random.uniform(0.35, 0.9), hold = random.uniform(0.15, 0.8);
  c.settle();
  c.raise(side, {{place, up}, {place, hold}}, {held, held}, random.uniform(0.4, 0.7));
  c.settle();
}

void free_posture(Choreography& c) {
  Random& random = c.random();
  const double bent = random.uniform(0.0, 1.0);
  PlanFrame posture = random_posture(random, c.stand(), random.uniform(0.3, 0.8));
  posture.pelvis.x() += 14.0 * bent * bent * kDegree;
  posture = c.crouched(posture, 12.0 + 60.0 * bent * bent);
  c.pose(posture, random.uniform(0.55, 0.9) + 0.5 * bent * bent);
  c.pause(random.uniform(0.0, 0.4));
}

/// Returns to standing at ease with the feet side by side, as at the beginning.
void come_to_rest(Choreography& c, double half_width) {
  const FootTarget& left = c.feet()[0];
  const double yaw = c.heading();
  const Eigen::Vector2d right = Eigen::Rotation2Dd(yaw) * Eigen::Vector2d(0.0, -2.0 * half_width);
  c.settle();
  c.pose_while(c.stand(), 0.9);
  c.step(1, left.place + right, yaw - 7.0 * kDegree, 0.55);
}

constexpr double kEnding = 1.5;  ///< for coming to rest, s

}  // namespace

PerFrame<PlanFrame> plan_free(const PlanRequest& request) {
  const double half_width = 1.05 * rest_half_width(request.character);
  Choreography c(request, random_stance(request, 0.95, 1.4, 4.0, 16.0), 0.45);
  c.pause(request.random.uniform(0.4, 0.6));
  while (c.left() > kEnding + 2.4) {
    switch (c.random().below(4)) {
      case 0:
        free_raise(c);
        break;
      case 1:
        free_posture(c);
        break;
      default: {  // one to three steps, perhaps with something for the arms to do
        c.settle();
        const int steps = 1 + static_cast<int>(c.random().below(3));
        if (c.random().below(2) == 0)
          c.pose_while(random_posture(c.random(), c.stand(), c.random().uniform(0.1, 0.45)), 0.9);
        for (int k = 0; k < steps && c.left() > kEnding + 0.8; ++k) {
          free_step(c, 0.45);
          c.pause(c.random().uniform(0.16, 0.4));
        }
        c.settle();
      }
    }
  }
  come_to_rest(c, half_width);
  return c.finished({8.0 * kDegree, 2.0 * kDegree, 2.0 * kDegree, 0.0});
}

PerFrame<PlanFrame> plan_martial(const PlanRequest& request) {
  const double half_width = 1.05 * rest_half_width(request.character), leg = leg_length(request.character);
  Choreography c(request, random_stance(request, 1.05, 1.3, 5.0, 12.0), 0.45);
  c.pause(request.random.uniform(0.2, 0.35));
  const PlanFrame guard = c.crouched(guard_posture(c.stand()), c.random().uniform(18.0, 32.0));
  c.pose(guard, 0.7);
  while (c.left() > kEnding + 2.4) {
    Random& random = c.random();
    const int side = static_cast<int>(random.below(2));
    const double mirror = side == 0 ? 1.0 : -1.0;
    switch (random.below(4)) {
      case 0: {  // a punch or a block
        PlanFrame blow = guard;
        blow.pelvis.y() = -mirror * random.uniform(4.0, 10.0) * kDegree;
        blow.trunk.y() = -mirror * random.uniform(8.0, 24.0) * kDegree;
        blow.head.y() = -blow.pelvis.y() - blow.trunk.y();
        blow.arm[side] = random.below(3) > 0 ? ArmPosture{random.uniform(60.0, 95.0) * kDegree, 5.0 * kDegree,
                                                          0.0, 20.0 * kDegree}
                                             : ArmPosture{random.uniform(60.0, 110.0) * kDegree,
                                                          35.0 * kDegree, 30.0 * kDegree, 85.0 * kDegree};
        c.pose(blow, random.uniform(0.26, 0.4));
        c.pose(guard, random.uniform(0.32, 0.45));
        break;
      }
      case 1: {  // a kick
        const double ahead = random.uniform(0.25, 0.60), outward = random.uniform(0.0, 0.35),
                     lift = random.uniform(0.15, 0.42);
        const RaisedFoot folded = {0.08 * leg, 0.02 * leg, 0.24 * leg, -20.0 * kDegree},
                         struck = {ahead * leg, outward * leg, lift * leg, 20.0 * kDegree};
        PlanFrame kick = guard;
        kick.pelvis.x() = -6.0 * kDegree;
        kick.pelvis.z() = 8.0 * mirror * outward * kDegree;
        c.settle();
        const std::vector<Choreography::Raise> places = {
            {folded, random.uniform(0.28, 0.36)}, {struck, random.uniform(0.22, 0.30)}, {folded, 0.26}};
        c.raise(side, places, {guard, kick, guard}, random.uniform(0.30, 0.38));
        c.settle();
        break;
      }
      default: {  // steps in the stance
        c.settle();
        c.pose_while(guard, 0.5);
        const int steps = 1 + static_cast<int>(random.below(2));
        for (int k = 0; k < steps; ++k) {
          free_step(c, 0.40);
          c.pause(random.uniform(0.16, 0.3));
        }
        c.settle();
      }
    }
  }
  come_to_rest(c, half_width);
  return c.finished({0.0, 2.0 * kDegree, 1.0 * kDegree, 0.0});
}

}  // namespace mimicx::synth
