#include "control/plan.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace mimicx::control {
namespace {

/// Planning a whole reference once.
struct Attempt {
  const System& system;
  const PlanConfig& config;
  const PlanControl& control;
  Plan& plan;  ///< counts what it took

  /// @param backtracks  at most so many, where the configuration allows more
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

/// Of two tries, the second of which was made because the first was lost: the second where it was followed or
/// stopped, else the longer.
HorizonResult better_of(HorizonResult lost, HorizonResult again) {
  return again.ending != Ending::kLost || again.motion.size() > lost.motion.size() ? again : lost;
}

List<Array<float, kHelp>> help_in(const Trajectory& motion) {
  List<Array<float, kHelp>> help;
  for (const Control& u : motion.u) std::copy_n(u.begin() + kDofs, kHelp, help.emplace_back().begin());
  return help;
}

/// @param price  factor on the price of help
Cost with_price(const Cost& cost, double price) {
  Cost out = cost;
  out.weights.help *= price;
  out.weights.help_spin *= price;
  return out;
}

/// A plan with help, and the factor on the price of help that it took.
struct SoftPlan {
  HorizonResult found;
  double price;
};

/// Plans with help, at its price and, where that is too high to stay with the reference, at a hundredth.
SoftPlan plan_softly(const Attempt& attempt, const Cost& cost) {
  constexpr double kCheap = 0.01;
  HorizonResult found = attempt.run(cost, 1);
  if (found.ending != Ending::kLost) return {std::move(found), 1.0};
  return {attempt.run(with_price(cost, kCheap), 3), kCheap};
}

/// Makes help dearer from stage to stage until next to none is left. Each stage begins with the motion of the
/// one before and follows that instead of the reference: so the motion moves away from the reference no
/// faster than the body needs. Where a stage is lost, the step was too long: it and those after it make help
/// dearer by the root of the factor. A stage that is lost by the shortest step is the last.
Trajectory stiffen(const Attempt& soft, const Cost& cost, Trajectory motion, double price) {
  constexpr double kDear = 4.0;
  double factor = soft.config.stiffening;
  const double least = std::min(1.5, factor);
  while (price < kDear && factor >= least) {
    const Cost dearer = with_goal(soft.system, with_price(cost, price * factor), motion.x);
    HorizonResult stage = soft.run(dearer, 2, motion);
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

/// Follows from farther away: nearly the same motion, but distances and changes of the controls cost little
/// beside the rest. A body that has to stay close to what it cannot do falls; one that may leave it does not.
HorizonResult plan_gently(const Attempt& attempt, const Cost& cost) {
  constexpr double kGentle = 1.0 / 32;
  Cost gentle = cost;
  gentle.weights.position *= kGentle;
  gentle.weights.change *= kGentle;
  gentle.weights.last = 1.0;
  return attempt.run(gentle, attempt.config.horizon.backtracks);
}

/// By way of help: a soft plan, stiffened, then a hard one towards it. @return what the hard one came to, or
/// the first state alone where the soft one did not come to the end
HorizonResult plan_soft_to_hard(const Attempt& hard, const Cost& cost) {
  System soft_system = hard.system;
  soft_system.soft = true;
  const Attempt soft{soft_system, hard.config, hard.control, hard.plan};
  SoftPlan first = plan_softly(soft, cost);
  hard.plan.soft_help = help_in(first.found.motion);
  if (first.found.ending != Ending::kFollowed) {
    first.found.motion = {};
    first.found.motion.x = {as_floats(hard.system.at(0))};
    return std::move(first.found);
  }
  Trajectory stiff = stiffen(soft, cost, std::move(first.found.motion), first.price);
  for (Control& u : stiff.u) std::fill(u.begin() + kDofs, u.end(), 0.0f);
  HorizonResult found = hard.run(with_goal(hard.system, cost, stiff.x), 4, stiff);
  hard.plan.by_way_of_help = found.ending == Ending::kFollowed;
  return found;
}

void fill(const System& system, const Trajectory& motion, Plan& plan) {
  plan.states = motion.x;
  plan.cost = motion.cost;
  plan.worst_distance = motion.worst;
  for (const Control& u : motion.u) std::copy_n(u.begin(), kDofs, plan.residuals.emplace_back().begin());
  if (system.soft) plan.help = help_in(motion);
}

}  // namespace

Plan make_plan(const System& system, const PlanConfig& config, const PlanControl& control) {
  const Cost cost = make_cost(system, config.weights, config.certainty);
  Plan plan;
  const Attempt attempt{system, config, control, plan};
  HorizonResult found =
      system.soft ? plan_softly(attempt, cost).found : attempt.run(cost, config.horizon.backtracks);
  Loss loss{found.lost_frame, found.lost_body, found.lost_distance};
  if (found.ending == Ending::kLost && config.soft_to_hard && !system.soft)
    found = better_of(std::move(found), plan_soft_to_hard(attempt, cost));
  if (found.ending == Ending::kLost && !system.soft)
    found = better_of(std::move(found), plan_gently(attempt, cost));
  if (found.ending == Ending::kLost) {
    loss.frame = std::max(loss.frame, found.lost_frame);
    plan.loss = loss;
  }
  plan.ending = found.ending;
  replay_controls(system, cost, found.motion);  // its cost and distances from the reference
  fill(system, found.motion, plan);
  return plan;
}

List<Vector6d> wrenches_of(const List<Array<float, kHelp>>& help, double mass) {
  List<Vector6d> wrenches;
  for (const Array<float, kHelp>& row : help) {
    Vector6d& wrench = wrenches.emplace_back();
    for (int k = 0; k < 3; ++k) {
      wrench[k] = mass * kHelpRadius * kHelpRadius * static_cast<double>(row[3 + k]);
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
    if (!plan.help.empty()) std::copy(plan.help[t].begin(), plan.help[t].end(), u.begin() + kDofs);
  }
  out.cost = plan.cost;
  out.worst = plan.worst_distance;
  return out;
}

}  // namespace mimicx::control
