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
  HorizonResult run(const Cost& cost, int backtracks, const List<Control>& guess = {}) const {
    Trajectory start;
    start.x = {as_floats(system.at(0))};
    HorizonConfig horizon = config.horizon;
    horizon.backtracks = std::min(horizon.backtracks, backtracks);
    HorizonResult found = follow_in_windows(system, cost, config.linearisation, horizon, control,
                                            std::move(start), system.frames() - 1, guess);
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

/// Largest force and moment of help within half a second of a frame.
void find_help(const System& system, const Trajectory& helped, Loss& loss) {
  const int around = static_cast<int>(std::lround(0.5 * system.fps));
  const int first = std::max(0, loss.frame - around), last = std::min(helped.size(), loss.frame + around);
  for (int t = first; t < last; ++t) {
    const Wrench<P> help = help_of(system, helped.u[t]);
    loss.help_force = std::max(loss.help_force, lane_of(help.f, 0).norm());
    loss.help_moment = std::max(loss.help_moment, lane_of(help.n, 0).norm());
  }
}

/// Plans with help, at its price and, where that is too high to stay with the reference, at a hundredth.
HorizonResult plan_softly(const Attempt& attempt, const Cost& cost) {
  HorizonResult found = attempt.run(cost, 1);
  if (found.ending != Ending::kLost) return found;
  Cost cheap = cost;
  cheap.weights.help *= 0.01;
  cheap.weights.help_spin *= 0.01;
  return attempt.run(cheap, 3);
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

/// By way of help: a soft plan, then a hard one towards it. @param lost  the plan without
/// @return what the hard one came to, or the longer of both where it was lost, too
HorizonResult plan_soft_then_hard(const Attempt& hard, const Cost& cost, HorizonResult lost, Loss& loss) {
  System soft_system = hard.system;
  soft_system.soft = true;
  const HorizonResult soft = plan_softly({soft_system, hard.config, hard.control, hard.plan}, cost);
  find_help(soft_system, soft.motion, loss);
  if (soft.ending != Ending::kFollowed) return lost;
  List<Control> guess = soft.motion.u;
  for (Control& u : guess) std::fill(u.begin() + kDofs, u.end(), 0.0f);
  HorizonResult again = hard.run(with_goal(hard.system, cost, soft.motion.x), 4, guess);
  hard.plan.by_way_of_help = again.ending == Ending::kFollowed;
  return better_of(std::move(lost), std::move(again));
}

void fill(const System& system, const Trajectory& motion, Plan& plan) {
  plan.states = motion.x;
  plan.cost = motion.cost;
  plan.worst_distance = motion.worst;
  for (const Control& u : motion.u) {
    std::copy_n(u.begin(), kDofs, plan.residuals.emplace_back().begin());
    if (system.soft) std::copy_n(u.begin() + kDofs, kHelp, plan.help.emplace_back().begin());
  }
}

}  // namespace

Plan make_plan(const System& system, const PlanConfig& config, const PlanControl& control) {
  const Cost cost = make_cost(system, config.weights, config.certainty);
  Plan plan;
  const Attempt attempt{system, config, control, plan};
  HorizonResult found =
      system.soft ? plan_softly(attempt, cost) : attempt.run(cost, config.horizon.backtracks);
  if (found.ending == Ending::kLost) {
    Loss loss{found.lost_frame, found.lost_body, found.lost_distance};
    if (!system.soft) found = better_of(std::move(found), plan_gently(attempt, cost));
    if (found.ending == Ending::kLost && config.soft_to_hard && !system.soft)
      found = plan_soft_then_hard(attempt, cost, std::move(found), loss);
    if (found.ending == Ending::kLost) {
      if (found.lost_frame > loss.frame) loss.frame = found.lost_frame;
      plan.loss = loss;
    }
  }
  plan.ending = found.ending;
  roll_plain(system, cost, found.motion);  // its cost and distances from the reference
  fill(system, found.motion, plan);
  if (config.gains && plan.ending == Ending::kFollowed)
    plan.gains = feedback_gains(system, cost, found.motion, config.gain_config, control);
  return plan;
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
