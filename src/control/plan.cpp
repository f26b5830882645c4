#include "control/plan.h"

#include <algorithm>
#include <cmath>

namespace mimicx::control {
namespace {

/// One attempt to plan the whole reference.
struct Attempt {
  const System& system;
  const PlanConfig& config;
  const PlanControl& control;
  Plan& plan;  ///< accumulates the counts

  /// @param backtracks  limit, beside that of the configuration
  HorizonResult run(const Cost& cost, int backtracks, const Trajectory& guess = {}) const {
    Trajectory start;
    start.x = {as_floats(system.at(0))};
    HorizonConfig horizon = config.horizon;
    horizon.backtracks = std::min(horizon.backtracks, backtracks);
    HorizonResult found =
        follow_in_windows({system, cost}, horizon, control, std::move(start), system.frames() - 1, guess);
    plan.iterations += found.iterations;
    plan.linearised += found.linearised;
    plan.backtracks += found.backtracks;
    return found;
  }
};

/// Of a failed attempt and its repetition: the repetition if it followed to the end, otherwise the longer
/// one, with the repetition's ending.
HorizonResult better_of(HorizonResult lost, HorizonResult again) {
  if (again.ending == Ending::kFollowed || again.motion.size() > lost.motion.size()) return again;
  lost.ending = again.ending;
  return lost;
}

List<Array<float, kAssistance>> assistance_in(const Trajectory& motion) {
  List<Array<float, kAssistance>> assistance;
  for (const Control& u : motion.u)
    std::copy_n(u.begin() + kDofs, kAssistance, assistance.emplace_back().begin());
  return assistance;
}

/// The cost with assistive forces weighted by the factor `price`.
Cost with_price(const Cost& cost, double price) {
  Cost out = cost;
  out.weights.assistance *= price;
  out.weights.assistance_spin *= price;
  return out;
}

/// A plan with assistive forces, and the factor on their weight.
struct AssistedPlan {
  HorizonResult found;
  double price;
};

/// Plans with assistive forces at their weight; if that fails, at a hundredth of it.
AssistedPlan plan_with_assistance(const Attempt& attempt, const Cost& cost) {
  constexpr double kCheap = 0.01;
  HorizonResult found = attempt.run(cost, 1);
  if (found.ending != Ending::kLost) return {std::move(found), 1.0};
  return {attempt.run(with_price(cost, kCheap), 3), kCheap};
}

/// Raises the weight of assistive forces from stage to stage until almost none are left. Each stage starts
/// from the motion of the previous stage and follows it instead of the reference, so that the motion leaves
/// the reference only as far as the body needs. If a stage fails, the factor becomes its square root. The
/// stages end when the smallest factor fails.
Trajectory stiffen(const Attempt& assisted, const Cost& cost, Trajectory motion, double price) {
  constexpr double kDear = 4.0;
  double factor = assisted.config.stiffening;
  const double least = std::min(1.5, factor);
  while (price < kDear && factor >= least) {
    const Cost dearer = with_goal(assisted.system, with_price(cost, price * factor), motion.x);
    HorizonResult stage = assisted.run(dearer, 2, motion);
    if (stage.ending == Ending::kStopped) break;
    if (stage.ending == Ending::kLost) {
      factor = std::sqrt(factor);
      continue;
    }
    motion = std::move(stage.motion);
    price *= factor;
  }
  return motion;
}

/// Follows with low weights on distances and changes of controls. A body that must stay close to an
/// infeasible reference falls; one that may deviate from it does not.
HorizonResult plan_gently(const Attempt& attempt, const Cost& cost) {
  constexpr double kGentle = 1.0 / 32;
  Cost gentle = cost;
  gentle.weights.position *= kGentle;
  gentle.weights.change *= kGentle;
  gentle.weights.last = 1.0;
  return attempt.run(gentle, attempt.config.horizon.backtracks);
}

/// Plans in stages with assistive forces, then an unassisted plan that follows the last stage. Windows of a
/// stage end earlier, because its motion is only where the next one begins. @return the unassisted plan, or
/// the first state alone if the first stage did not reach the end
HorizonResult plan_in_stages(const Attempt& unassisted, const Cost& cost) {
  constexpr double kStageStop = 0.08;
  System assisted_system = unassisted.system;
  assisted_system.assisted = true;
  PlanConfig rough = unassisted.config;
  rough.horizon.stop = std::max(rough.horizon.stop, kStageStop);
  const Attempt assisted{assisted_system, rough, unassisted.control, unassisted.plan};
  AssistedPlan first = plan_with_assistance(assisted, cost);
  unassisted.plan.stage_assistance = assistance_in(first.found.motion);
  if (first.found.ending != Ending::kFollowed) {
    first.found.motion = {};
    first.found.motion.x = {as_floats(unassisted.system.at(0))};
    return std::move(first.found);
  }
  Trajectory stiff = stiffen(assisted, cost, std::move(first.found.motion), first.price);
  for (Control& u : stiff.u) std::fill(u.begin() + kDofs, u.end(), 0.0f);
  HorizonResult found = unassisted.run(with_goal(unassisted.system, cost, stiff.x), 4, stiff);
  unassisted.plan.by_assisted_stages = found.ending == Ending::kFollowed;
  return found;
}

void fill(const System& system, const Trajectory& motion, Plan& plan) {
  plan.states = motion.x;
  plan.cost = motion.cost;
  plan.worst_distance = motion.worst;
  for (const Control& u : motion.u) std::copy_n(u.begin(), kDofs, plan.residuals.emplace_back().begin());
  if (system.assisted) plan.assistance = assistance_in(motion);
}

}  // namespace

Plan make_plan(const System& system, const PlanConfig& config, const PlanControl& control) {
  const Cost cost = make_cost(system, config.weights, config.factors);
  Plan plan;
  const Attempt attempt{system, config, control, plan};
  HorizonResult found = system.assisted ? plan_with_assistance(attempt, cost).found
                                        : attempt.run(cost, config.horizon.backtracks);
  const auto failure_of = [](const HorizonResult& lost) {
    return Failure{lost.lost_frame, lost.lost_body, lost.lost_distance};
  };
  Failure failure = failure_of(found);
  if (found.ending == Ending::kLost && config.assisted_stages && !system.assisted)
    found = better_of(std::move(found), plan_in_stages(attempt, cost));
  if (found.ending == Ending::kLost && !system.assisted)
    found = better_of(std::move(found), plan_gently(attempt, cost));
  if (found.ending == Ending::kLost) {
    if (found.lost_frame > failure.frame) failure = failure_of(found);
    plan.failure = failure;
  }
  plan.ending = found.ending;
  replay_controls(system, cost, found.motion);  // cost and distances with respect to the reference
  fill(system, found.motion, plan);
  return plan;
}

List<Vector6d> wrenches_of(const List<Array<float, kAssistance>>& assistance, double mass) {
  List<Vector6d> wrenches;
  for (const Array<float, kAssistance>& row : assistance) {
    Vector6d& wrench = wrenches.emplace_back();
    for (int k = 0; k < 3; ++k) {
      wrench[k] = mass * kAssistanceRadius * kAssistanceRadius * static_cast<double>(row[3 + k]);
      wrench[3 + k] = mass * static_cast<double>(row[k]);
    }
  }
  return wrenches;
}

Trajectory trajectory_of(const Plan& plan) {
  Trajectory out;
  out.x = plan.states;
  for (std::size_t t = 0; t < plan.residuals.size(); ++t) {
    Control& u = out.u.emplace_back();
    u.fill(0.0f);
    std::copy(plan.residuals[t].begin(), plan.residuals[t].end(), u.begin());
    if (!plan.assistance.empty())
      std::copy(plan.assistance[t].begin(), plan.assistance[t].end(), u.begin() + kDofs);
  }
  out.cost = plan.cost;
  out.worst = plan.worst_distance;
  return out;
}

}  // namespace mimicx::control
