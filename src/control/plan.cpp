#include "control/plan.h"

#include <algorithm>
#include <memory>

namespace mimicx::control {
namespace {

void fill(const System& system, const Trajectory& motion, Plan& plan) {
  plan.states = motion.x;
  for (const Control& u : motion.u) {
    std::copy_n(u.begin(), kDofs, plan.residuals.emplace_back().begin());
    if (system.soft) std::copy_n(u.begin() + kDofs, kHelp, plan.help.emplace_back().begin());
  }
}

}  // namespace

Plan make_plan(const System& system, const PlanConfig& config, const PlanControl& control) {
  const Cost cost = make_cost(system, config.weights, config.certainty);
  Trajectory start;
  const auto scratch = std::make_unique<Data<P>>();
  start.x = {lane_of(in_all_lanes<P>(system.at(0)), 0)};  // as floats
  HorizonResult found = follow_in_windows(system, cost, config.linearisation, config.horizon, control,
                                          std::move(start), system.frames() - 1);
  Trajectory& motion = found.motion;
  Plan plan;
  if (motion.size() > 0) {
    const Fan fan =
        roll_out(system, cost, motion, {}, step_lengths(), in_all_lanes<P>(motion.x[0]), *scratch);
    take_lane(fan, 0, motion);
  }
  fill(system, motion, plan);
  plan.ending = found.ending;
  plan.cost = motion.cost;
  plan.worst_distance = motion.worst;
  plan.iterations = found.iterations;
  plan.linearised = found.linearised;
  plan.backtracks = found.backtracks;
  if (found.ending == Ending::kLost) plan.loss = Loss{found.lost_frame, -1, 0.0};
  return plan;
}

}  // namespace mimicx::control
