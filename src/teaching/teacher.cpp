#include "teaching/teacher.h"

#include "physics/lanes.h"

namespace mimicx::teaching {
namespace {

using physics::kLanes;

/// The residual on one joint rotation that gives a target: u with to · exp(u) = target.
Vector3d residual_for(const Quaterniond& to, const Quaterniond& target) {
  return log_map(Quaterniond(to.conjugate() * target));
}

/// Scales all matrices by one number, so that the mean of their diagonals is 1.
void scale_to_one(List<Eigen::MatrixXf>& matrices) {
  double sum = 0.0, count = 0.0;
  for (const Eigen::MatrixXf& m : matrices) {
    sum += static_cast<double>(m.trace());
    count += static_cast<double>(m.rows());
  }
  if (!(sum > 0.0)) return;
  for (Eigen::MatrixXf& m : matrices) m *= static_cast<float>(count / sum);
}

/// Sets the feedback gains and tests them with pushes. @return false if it was stopped
bool take_feedback(const control::System& system, const control::Cost& cost, const TeacherConfig& config,
                   const control::GainConfig& gains, const control::PlanControl& control, Teacher& teacher) {
  teacher.gains = control::feedback_gains(system, cost, teacher.motion, gains, control, &teacher.importance);
  if (teacher.gains.empty()) return false;
  teacher.followed =
      control::test_pushes(system, cost, teacher.motion, teacher.gains, config.pushes).followed;
  return true;
}

}  // namespace

control::Trajectory on_own_states(const motion::Reference& reference, const control::Plan& plan) {
  control::Trajectory own;
  own.x = plan.states;
  for (std::size_t t = 0; t < plan.residuals.size(); ++t) {
    control::Control& u = own.u.emplace_back();
    u.fill(0.0f);
    const motion::ReferenceFrame& next = reference.frames[t + 1];
    for (int body = 1; body < kBodies; ++body) {
      const Vector3d rotation =
          physics::action_rotation(body, 3.0, [&](int dof) { return plan.residuals[t][dof]; });
      const Quaterniond planned = physics::to_eigen(plan.states[t + 1].q[body]);
      const Vector3d residual = residual_for(planned, physics::residual_target(next.q[body], rotation));
      const int dof = first_dof(body);
      if (is_hinge(body))
        u[dof] = static_cast<float>(residual.dot(hinge_axis(body)));
      else
        for (int k = 0; k < 3; ++k) u[dof + k] = static_cast<float>(residual[k]);
    }
  }
  return own;
}

std::optional<Teacher> make_teacher(const motion::Reference& reference, const control::Plan& plan,
                                    const TeacherConfig& config, const rl::tracking::TrackingConfig& task,
                                    const control::PlanControl& control) {
  const motion::Reference planned = rl::tracking::reference_of_states(reference, plan.states);
  const control::System system =
      control::make_system(planned.character, task.simulation, rl::tracking::simulator_states(planned),
                           planned.fps, planned.scene);
  const control::Cost cost = control::make_cost(system, config.weights);
  control::Trajectory start;
  start.x = {control::as_floats(system.at(0))};
  control::HorizonResult found =
      control::follow_in_windows({system, cost}, config.horizon, control, std::move(start),
                                 system.frames() - 1, on_own_states(reference, plan));
  if (found.ending != control::Ending::kFollowed) return {};
  Teacher teacher;
  teacher.clip = rl::tracking::make_tracking_clip(planned, task);
  teacher.motion = std::move(found.motion);
  teacher.max_correction = config.max_correction;
  if (!take_feedback(system, cost, config, config.gains, control, teacher)) return {};
  if (teacher.followed < config.enough * config.pushes.trials) {
    Teacher other = teacher;
    control::GainConfig gains = config.gains;
    gains.smoothing = control::DifferenceSteps{}.scaled(config.less_smoothing);
    if (!take_feedback(system, cost, config, gains, control, other)) return {};
    if (other.followed > teacher.followed) teacher = std::move(other);
  }
  scale_to_one(teacher.importance);
  return teacher;
}

LaneActions ask(const Teacher& teacher, int t, const physics::State<control::P>& x,
                const LaneActions& before) {
  control::LaneControls last;
  last.setZero();
  for (int lane = 0; lane < kLanes; ++lane)
    for (int k = 0; k < kDofs; ++k) last(k, lane) = before[lane][k];
  const control::LaneMemory dz =
      control::memory_difference(x, last, teacher.motion.x[t], teacher.motion.previous(t));
  const auto limit = static_cast<float>(teacher.max_correction);
  const Eigen::Matrix<float, kDofs, kLanes> correction =
      (teacher.gains[t] * dz).cwiseMin(limit).cwiseMax(-limit);
  LaneActions advice;
  for (int lane = 0; lane < kLanes; ++lane)
    for (int k = 0; k < kDofs; ++k) advice[lane][k] = teacher.motion.u[t][k] + correction(k, lane);
  return advice;
}

}  // namespace mimicx::teaching
