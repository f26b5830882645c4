#include <numbers>

#include "core/elementary.h"
#include "synth/kinds.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

/// Rises from 0 to 1 over the first and falls back over the last `ramp` seconds.
MinJerkTrack fade(double seconds, double ramp) {
  return MinJerkTrack({{0.0, 0.0}, {ramp, 1.0}, {seconds - ramp, 1.0}, {seconds, 0.0}});
}

/// A slow wander within about ±1: three sines of random frequency and phase.
struct Wander {
  Array<double, 3> frequency, phase;
  explicit Wander(Random& random) {
    for (int i = 0; i < 3; ++i) {
      frequency[i] = random.uniform(0.12, 0.45);
      phase[i] = random.uniform(0.0, 2.0 * std::numbers::pi);
    }
  }
  double at(double time) const {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += sin(2.0 * std::numbers::pi * frequency[i] * time + phase[i]);
    return sum / 3.0;
  }
};

}  // namespace

PerFrame<PlanFrame> plan_stand(const PlanRequest& request) {
  Random& random = request.random;
  const PlanFrame stand = standing_frame(request.character, random_stance(request, 0.95, 1.2, 4.0, 14.0));
  const MinJerkTrack part = fade(request.seconds(), 0.8);
  const Wander ahead(random), aside(random), turn(random), lean(random), look(random), arms(random);
  const double shift = random.uniform(0.02, 0.035), sway = random.uniform(0.006, 0.012);
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  for (int i = 0; i < plan.count(); ++i) {
    const double t = time_of(i), on = part.at(t);
    PlanFrame& frame = plan[i];
    frame.pressure += on * Eigen::Vector2d(sway * ahead.at(t), shift * aside.at(t));
    frame.com_height -= 0.004 * on * (1.0 + lean.at(t));
    // The pelvis drops away from the loaded leg; the trunk stays upright over it.
    frame.pelvis += on * kDegree * Vector3d(1.5 * lean.at(t), 4.0 * turn.at(t), 3.0 * aside.at(t));
    frame.trunk += on * kDegree * Vector3d(-1.5 * lean.at(t), 5.0 * turn.at(t), -2.5 * aside.at(t));
    frame.head += on * kDegree * Vector3d(4.0 * lean.at(t), 18.0 * look.at(t), 2.0 * aside.at(t));
    frame.arm[0].forward += on * kDegree * (3.0 + 4.0 * arms.at(t));
    frame.arm[1].forward += on * kDegree * (3.0 - 4.0 * arms.at(t));
  }
  return plan;
}

PerFrame<PlanFrame> plan_squat(const PlanRequest& request) {
  Random& random = request.random;
  const PlanFrame stand = standing_frame(request.character, random_stance(request, 1.35, 1.6, 14.0, 20.0));
  PlanFrame low = stand;  // hips back, arms to the front as a counterweight, looking ahead
  low.pelvis.x() = random.uniform(20.0, 26.0) * kDegree;
  low.trunk.x() = random.uniform(12.0, 18.0) * kDegree;
  low.head.x() = -0.7 * (low.pelvis.x() + low.trunk.x());
  for (ArmPosture& arm : low.arm) arm = {random.uniform(95.0, 110.0) * kDegree, 6.0 * kDegree, 0.0, 0.2};
  low.com_height =
      com_height_for_knee(request.character, low, low.pressure, random.uniform(88.0, 100.0) * kDegree);
  const double begin = random.uniform(0.25, 0.40), down = random.uniform(0.95, 1.10);
  const double hold = random.uniform(0.15, 0.35), up = random.uniform(0.85, 1.00),
               pause = random.uniform(0.20, 0.35);
  std::vector<PostureKey> keys = {{0.0, stand}};
  std::vector<Knot> height = {{0.0, stand.com_height}};
  for (double t = begin; t + down + hold + up < request.seconds() - 0.1; t += down + hold + up + pause) {
    const double bottom = t + down, rise = bottom + hold, top = rise + up;
    keys.insert(keys.end(), {{t, stand}, {bottom, low}, {rise, low}, {top, stand}});
    height.insert(
        height.end(),
        {{t, stand.com_height}, {bottom, low.com_height}, {rise, low.com_height}, {top, stand.com_height}});
  }
  const MinJerkTrack com_height(height);
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  for (int i = 0; i < plan.count(); ++i) {
    hold_postures(keys, time_of(i), plan[i]);
    plan[i].com_height = com_height.at(time_of(i));
  }
  return plan;
}

PerFrame<PlanFrame> plan_wave(const PlanRequest& request) {
  Random& random = request.random;
  const PlanFrame stand = standing_frame(request.character, random_stance(request, 0.95, 1.15, 4.0, 12.0));
  const int side = static_cast<int>(random.below(2));
  const double mirror = side == 0 ? 1.0 : -1.0;
  PlanFrame raised = stand;  // upper arm out, forearm up
  raised.arm[side] = {15.0 * kDegree, random.uniform(70.0, 90.0) * kDegree, 85.0 * kDegree,
                      random.uniform(75.0, 90.0) * kDegree};
  raised.trunk.z() = mirror * 3.0 * kDegree;
  raised.head.y() = mirror * 8.0 * kDegree;
  const double begin = random.uniform(0.4, 0.6), raise = random.uniform(0.75, 0.95);
  const double end = request.seconds() - random.uniform(0.3, 0.5);
  const std::vector<PostureKey> keys = {
      {0.0, stand}, {begin, stand}, {begin + raise, raised}, {end - raise, raised}, {end, stand}};
  const MinJerkTrack waving({{begin + 0.7 * raise, 0.0},
                             {begin + raise + 0.3, 1.0},
                             {end - raise - 0.3, 1.0},
                             {end - 0.7 * raise, 0.0}});
  const double rate = 2.0 * std::numbers::pi * random.uniform(1.2, 1.6),
               swing = random.uniform(16.0, 22.0) * kDegree;
  const Wander aside(random);
  const MinJerkTrack part = fade(request.seconds(), 0.8);
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  for (int i = 0; i < plan.count(); ++i) {
    const double t = time_of(i), wave = waving.at(t) * sin(rate * (t - begin));
    hold_postures(keys, t, plan[i]);
    plan[i].arm[side].elbow += swing * wave;
    plan[i].arm[side].out += 0.25 * swing * wave;
    plan[i].pressure.y() += part.at(t) * 0.012 * aside.at(t);
  }
  return plan;
}

PerFrame<PlanFrame> plan_bow(const PlanRequest& request) {
  Random& random = request.random;
  const PlanFrame stand = standing_frame(request.character, random_stance(request, 0.95, 1.15, 4.0, 12.0));
  const double begin = random.uniform(0.3, 0.5);
  std::vector<PostureKey> keys = {{0.0, stand}};
  for (double t = begin;;) {
    PlanFrame bowed = stand;  // hips back, arms along the sides
    bowed.pelvis.x() = random.uniform(22.0, 34.0) * kDegree;
    bowed.trunk.x() = random.uniform(18.0, 28.0) * kDegree;
    bowed.head.x() = random.uniform(0.0, 10.0) * kDegree;
    for (ArmPosture& arm : bowed.arm) arm.forward = 0.35 * (bowed.pelvis.x() + bowed.trunk.x());
    bowed.com_height = com_height_for_knee(request.character, bowed, bowed.pressure, 12.0 * kDegree);
    const double down = t + random.uniform(0.80, 1.05), up = down + random.uniform(0.25, 0.60),
                 end = up + random.uniform(0.85, 1.10);
    if (end > request.seconds() - 0.15) break;
    keys.insert(keys.end(), {{t, stand}, {down, bowed}, {up, bowed}, {end, stand}});
    t = end + random.uniform(0.20, 0.45);
  }
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  for (int i = 0; i < plan.count(); ++i) hold_postures(keys, time_of(i), plan[i]);
  return plan;
}

}  // namespace mimicx::synth
