#include "control/gains.h"

#include <algorithm>
#include <numbers>

#include "core/elementary.h"
#include "core/random.h"

namespace mimicx::control {
namespace {

/// The frames first … last of a motion.
Trajectory piece(const Trajectory& motion, int first, int last) {
  Trajectory out;
  out.begin = motion.begin + first;
  out.before = motion.previous(first);
  out.x.assign(motion.x.begin() + first, motion.x.begin() + last + 1);
  out.u.assign(motion.u.begin() + first, motion.u.begin() + last);
  return out;
}

}  // namespace

List<Eigen::MatrixXf> feedback_gains(const System& system, const Cost& cost, const Trajectory& motion,
                                     const GainConfig& config, const PlanControl& control,
                                     List<Eigen::MatrixXf>* curvature) {
  Cost soft = cost;
  soft.weights.residual = config.residual;
  soft.weights.change = config.change;
  const int n = motion.size();
  List<Eigen::MatrixXf> gains(n);
  if (curvature) *curvature = List<Eigen::MatrixXf>(n);
  const ControlProblem problem{system, soft, config.smoothing};
  List<FrameModel> models;
  SweepState sweep;
  Feedback law;
  for (int last = n; last > 0; last -= config.block) {
    if (control.should_stop && control.should_stop()) return {};
    const int first = std::max(0, last - config.block);
    const Trajectory block = piece(motion, first, last);
    build_models(problem, block, control.threads, models, [&](int k) {
      const int t = first + k;
      if (t == n - 1) sweep.value = last_value(problem, block, models.back().cost);
      const SweepResult step = sweep_frame(problem, motion, t, models[k], sweep, law);
      if (curvature) {
        const Eigen::MatrixXd Quu = sweep.stage.H.bottomRightCorner(system.controls(), system.controls());
        (*curvature)[t] = Eigen::MatrixXd(Quu.selfadjointView<Eigen::Lower>()).cast<float>();
      }
      gains[t] = step.positive ? law.K : Eigen::MatrixXf::Zero(system.controls(), kMemory);
    });
  }
  return gains;
}

PushResult test_pushes(const System& system, const Cost& cost, const Trajectory& motion,
                       const List<Eigen::MatrixXf>& gains, const PushTest& test) {
  List<Feedback> laws;
  for (const Eigen::MatrixXf& K : gains) laws.push_back({K, Eigen::VectorXf::Zero(K.rows())});
  PushResult result;
  for (int done = 0; done < test.trials; done += kLanes) {
    List<Random> random;
    for (int lane = 0; lane < kLanes; ++lane)
      random.emplace_back(test.seed,
                          std::initializer_list<std::uint64_t>{static_cast<std::uint64_t>(done + lane)});
    RollConfig config;
    config.failure_distance = test.failure_distance;
    config.disturbance = [&](int frame, State<P>& x) {
      if (frame % test.every != test.every / 2) return;
      for (int lane = 0; lane < kLanes; ++lane) {
        const double angle = random[lane].uniform(0.0, 2.0 * std::numbers::pi);
        const Vector3d push = test.speed * Vector3d(cos(angle), sin(angle), 0.0);
        set_lane(x.v_root, lane, Vector3d(physics::lane_of(x.v_root, lane) + push));
      }
    };
    const Fan fan = roll_out(system, cost, motion, laws, {}, config);
    for (int lane = 0; lane < std::min(kLanes, test.trials - done); ++lane) {
      const int kept = fan.frames_kept[lane];
      result.followed += kept == motion.size() ? 1 : 0;
      result.frames_kept += static_cast<double>(kept) / test.trials;
    }
  }
  return result;
}

}  // namespace mimicx::control
