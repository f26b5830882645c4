// Optimal control on the motion of 5_follow: iLQR beside PPO, and the forces of the floor.
//
// You learn: what derivatives are worth: a plan in a second where PPO took many; what a plan is (controls
// of one way through one motion) and what it is not (a policy); how the floor's force follows from momentum.
// Belongs to: docs/control.md §1, §3, §4, §6 (LQR and gains, iLQR, contacts, momentum).
// Questions: 1. The mean of the floor's force over the motion is the weight to a few per cent. Why must
//               it be?
//            2. Add 0.1 to every residual of one frame. What happens, and what would gains change?
//            3. Plan a jump ("jump", 1). What does the force show, and what is its mean now?
#include <filesystem>

#include "control/plan.h"
#include "motions.h"
#include "plot.h"

using namespace mimicx;
using rl::tracking::TrackingRollout;

// The floor's vertical force over the weight, frame by frame.
tour::Curve force_of(const TrackingRollout& rolled, double weight, tour::Curve curve) {
  for (std::size_t t = 1; t < rolled.forces.size(); ++t) {
    double force = 0.0;
    for (const Vector6d& wrench : rolled.forces[t].ground) force += wrench[5];
    tour::add(curve, static_cast<double>(t) / 30.0, force / weight);
  }
  return curve;
}

void tell(const char* who, const TrackingRollout& rolled, const tour::Curve& force) {
  double mean = 0.0, rough = 0.0;
  for (std::size_t t = 0; t < force.y.size(); ++t) mean += force.y[t] / static_cast<double>(force.y.size());
  for (std::size_t t = 1; t < force.y.size(); ++t)
    rough += std::abs(force.y[t] - force.y[t - 1]) / static_cast<double>(force.y.size() - 1);
  std::printf("%s: %s; the floor's force: mean %.2f weights, change from frame to frame %.3f\n", who,
              tour::in_words(rolled).c_str(), mean, rough);
}

int main() {
  const motion::Reference reference = tour::motion_of_kind("squat", 1);
  const rl::tracking::TrackingConfig config;
  const auto clip = rl::tracking::make_tracking_clip(reference, config);
  const double weight = reference.character.total_mass() * kGravity;

  const control::System system = control::make_system(
      reference.character, config.simulation, rl::tracking::simulator_states(reference), reference.fps);
  const control::Plan plan = control::make_plan(system, {}, {.threads = 1});
  std::printf("the plan: %d of %d frames, %d iterations, cost %.2f\n", plan.states.count(), reference.size(),
              plan.iterations, plan.cost);
  // Its residuals are actions: replayed in the tracking task they give the planned motion.
  int frame = 0;
  const TrackingRollout planned = roll_out(clip, config, [&](int, const float*, float* action) {
    for (int dof = 0; dof < kDofs; ++dof) action[dof] = plan.residuals[frame][dof];
    ++frame;
  });
  const tour::Curve plan_force = force_of(planned, weight, tour::line("plan", 0));
  tell("plan", planned, plan_force);
  std::vector<tour::Curve> curves = {plan_force};

  if (std::filesystem::exists("out/tour/5_follow.npz")) {
    const rl::Agent agent = rl::load_agent(read_npz("out/tour/5_follow.npz"), "agent.");
    const TrackingRollout followed = roll_out(clip, config, rl::tracking::mean_action({agent}));
    curves.push_back(force_of(followed, weight, tour::line("PPO", 1)));
    tell("PPO ", followed, curves.back());
  } else {
    std::printf("PPO : run 5_follow first\n");
  }
  tour::save_picture("8_plan", "The floor's force under a squat, planned and learnt",
                     {{"the floor's force", "time, s", "over the weight", curves, false, true}});
}
