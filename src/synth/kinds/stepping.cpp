// Steps onto stairs, kerbs and boxes.
#include <algorithm>

#include "synth/gait.h"
#include "synth/kinds.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

constexpr double kStepsSettle = 0.55, kStepsBegin = 0.9, kStepsRest = 0.9;  ///< as in walking.cpp, s
constexpr double kPlateWidth = 1.2;                                         ///< of a plate, m

/// How far a flat foot reaches before and behind its ankle, m.
struct FootReach {
  double heel, toe;
  double length() const { return heel + toe; }
};
FootReach foot_reach(const Character& c) {
  const double ball = c.joint_offset[kLeftFoot].z();
  return {-c.contact_points[0].p_B.z(),
          ball + std::max(c.contact_points[4].p_B.z(), c.contact_points[5].p_B.z())};
}

/// A place for one foot: m ahead of the start, height of its ground, m; seconds to wait before it is taken.
struct Footfall {
  double ahead, ground, wait = 0.0;
};

Plate step_plate(double begin, double end, double height) {
  Plate plate;
  plate.centre = {0.5 * (begin + end), 0.0};
  plate.half_extents = {0.5 * (end - begin), 0.5 * kPlateWidth};
  plate.height = height;
  return plate;
}

/// Both feet on ground of one height; the feet take the places in turn; the body follows them.
SceneMotion walk_over(const PlanRequest& request, double start_height, const std::vector<Footfall>& falls,
                      const std::vector<Plate>& plates) {
  Random& random = request.random;
  const Character& character = request.character;
  const double half_width = rest_half_width(character) * random.uniform(0.9, 1.05);
  const double toes_out = random.uniform(3.0, 6.0) * kDegree;
  const int first = static_cast<int>(random.below(2));
  double waits = 0.0;
  for (const Footfall& fall : falls) waits += fall.wait;
  const double period =
      (request.seconds() - kStepsBegin - kStepsRest - waits) / static_cast<double>(falls.size());
  const double swing = 0.78 * period;
  PerSide<FootTarget> start = feet_apart(half_width, toes_out);
  const PlanFrame stand = standing_frame(character, start);
  for (FootTarget& foot : start) foot.lift = start_height;

  std::vector<FootSwing> swings;
  double t = kStepsBegin;
  for (std::size_t k = 0; k < falls.size(); ++k) {
    t += falls[k].wait;
    const int side = (first + static_cast<int>(k)) % 2;
    FootSwing step{
        side, t, t + swing, start[side].place + Eigen::Vector2d(falls[k].ahead, 0.0), start[side].yaw, 0.05};
    step.ground = falls[k].ground;
    swings.push_back(step);
    t += period;
  }
  const FeetTracks feet = stepping_feet(character, start, swings, kStepsSettle);
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  PerFrame<double> ground;
  for (int i = 0; i < plan.count(); ++i) {
    place_feet(feet, time_of(i), plan[i]);
    ground.push_back(plan[i].pressure_height);
  }
  const double lean = random.uniform(2.0, 4.0) * kDegree;
  const GaitStyle style = {random.uniform(8.0, 14.0) * kDegree, 3.0 * kDegree,
                           random.uniform(1.0, 2.5) * kDegree, lean};
  follow_feet(character, style, 0.75 * leg_length(character), feet, plan);
  ground = smoothed(ground, 0.25 * period * kSynthFps);  // the body rises while both feet stand and before
  for (int i = 0; i < plan.count(); ++i) plan[i].com_height += ground[i];
  SceneMotion motion;
  motion.poses = solve_plan(character, std::move(plan), kSynthFps);
  for (const Plate& plate : plates) motion.scene.plates.push_back(plate);
  return motion;
}

SceneMotion stairs(const PlanRequest& request, bool up) {
  Random& random = request.random;
  const FootReach foot = foot_reach(request.character);
  const int steps = 3 + static_cast<int>(random.below(2));
  const double rise = random.uniform(0.14, 0.18);
  const double tread = std::max(0.27, foot.length() + 0.03) + random.uniform(0.0, 0.04);
  const double edge = foot.toe + random.uniform(0.03, 0.06), landing = 1.3;
  const double in_tread = foot.heel + 0.5 * (tread - foot.length());
  const auto height = [&](int k) { return rise * (up ? k : steps - k); };  // after k steps
  std::vector<Plate> plates;
  if (!up) plates.push_back(step_plate(edge - landing, edge, height(0)));
  std::vector<Footfall> falls;
  for (int k = 1; k <= steps; ++k) {
    const double begin = edge + (k - 1) * tread, end = begin + (k < steps ? tread : landing);
    if (height(k) > 0.0) plates.push_back(step_plate(begin, end, height(k)));
    falls.push_back({begin + in_tread, height(k)});
  }
  falls.push_back({falls.back().ahead + 0.3, height(steps)});
  falls.push_back(falls.back());
  return walk_over(request, height(0), falls, plates);
}

}  // namespace

SceneMotion climb_stairs(const PlanRequest& request) { return stairs(request, true); }
SceneMotion descend_stairs(const PlanRequest& request) { return stairs(request, false); }

SceneMotion cross_kerb(const PlanRequest& request) {
  Random& random = request.random;
  const FootReach foot = foot_reach(request.character);
  const double height = random.uniform(0.10, 0.16);
  const double step = random.uniform(0.60, 0.68) * leg_length(request.character);
  const double gap = step - foot.length();  // between the toes of one step and the heel of the next
  std::vector<Footfall> falls;
  for (int k = 1; k <= 7; ++k) falls.push_back({k * step, k >= 3 && k <= 5 ? height : 0.0});
  falls.push_back(falls.back());
  const double begin = 2.0 * step + foot.toe + 0.5 * gap, end = 5.0 * step + foot.toe + 0.5 * gap;
  return walk_over(request, 0.0, falls, {step_plate(begin, end, height)});
}

SceneMotion cross_box(const PlanRequest& request) {
  Random& random = request.random;
  const FootReach foot = foot_reach(request.character);
  const double height = random.uniform(0.20, 0.27);
  const double begin = foot.toe + random.uniform(0.08, 0.11),
               end = begin + foot.length() + random.uniform(0.10, 0.16);
  const double on = 0.5 * (begin + end) + 0.5 * (foot.heel - foot.toe), off = end + foot.heel + 0.06;
  const double hold = random.uniform(0.9, 1.3);
  return walk_over(request, 0.0, {{on, height}, {on, height}, {off, 0.0, hold}, {off, 0.0}},
                   {step_plate(begin, end, height)});
}

}  // namespace mimicx::synth
