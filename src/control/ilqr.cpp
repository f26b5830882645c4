#include "control/ilqr.h"

#include <algorithm>
#include <memory>

#include "control/shooting.h"
#include "core/parallel.h"

namespace mimicx::control {
namespace {

/// Adds the cost of the torques at frame t of a trajectory, a function of z = (x, w).
template <class Matrix>
void add_torques(const ControlProblem& problem, const Trajectory& trajectory, int t, double factor, Matrix& H,
                 Eigen::VectorXd& g) {
  const Cost& cost = problem.cost;
  if (!(cost.weights.torque > 0.0)) return;
  const Array<double, kDofs> e =
      target_distances(problem.system, cost, trajectory.begin + t, trajectory.x[t], trajectory.previous(t));
  for (int k = 0; k < kDofs; ++k) {
    const double weight = 2.0 * factor * cost.elastic[k];
    const Array<int, 3> at = {kJointRotation + k, kJointVelocity + k, kTangent + k};
    const Array<double, 3> by = {-1.0, -cost.lead[k], 1.0};  // derivatives of e_k
    for (int i = 0; i < 3; ++i) {
      g[at[i]] += weight * by[i] * e[k];
      for (int j = 0; j < 3; ++j) H(at[i], at[j]) += weight * by[i] * by[j];
    }
  }
}

/// The part of a frame's cost that is quadratic in (x, w, u).
void stage_cost(const ControlProblem& problem, const Trajectory& trajectory, int t,
                const StateQuadratic& state, StageCost& out) {
  const CostWeights& weights = problem.cost.weights;
  const int controls = problem.system.controls(), u = kMemory, w = kTangent;
  out.H.resize(kMemory + controls, kMemory + controls);
  out.H.triangularView<Eigen::Lower>().setZero();
  out.g.setZero(kMemory + controls);
  if (t > 0) {  // the first state is fixed
    out.g.head(kTangent) = state.gradient;
    out.H.topLeftCorner(kTangent, kTangent) = state.hessian;
  }
  const Control& now = trajectory.u[t];
  const Control& before = trajectory.previous(t);
  for (int k = 0; k < kDofs; ++k) {
    const double value = static_cast<double>(now[k]), change = value - static_cast<double>(before[k]);
    out.g[u + k] = 2.0 * (weights.residual * value + weights.change * change);
    out.g[w + k] = -2.0 * weights.change * change;
    out.H(u + k, u + k) = 2.0 * (weights.residual + weights.change);
    out.H(w + k, w + k) = 2.0 * weights.change;
    out.H(u + k, w + k) = -2.0 * weights.change;
  }
  for (int k = kDofs; k < controls; ++k) {
    const double weight = k < kDofs + 3 ? weights.assistance : weights.assistance_spin;
    out.g[u + k] = 2.0 * weight * static_cast<double>(now[k]);
    out.H(u + k, u + k) = 2.0 * weight;
  }
  if (t > 0) add_torques(problem, trajectory, t, 1.0, out.H, out.g);
}

}  // namespace

void build_models(const ControlProblem& problem, const Trajectory& trajectory, int threads,
                  List<FrameModel>& models, const std::function<void(int t)>& sweep) {
  const System& system = problem.system;
  const Cost& cost = problem.cost;
  const int n = trajectory.size();
  models.resize(n + 1);
  const auto build_cost = [&](int t) {
    models[t].cost = state_quadratic(system, cost, trajectory.begin + t, trajectory.x[t]);
  };
  build_cost(n);
  models[n].cost.scale(cost.last_weight(trajectory.begin + n));
  List<std::unique_ptr<LinearisationScratch>> scratch(std::max(threads, 1));  // one per worker
  const auto build = [&](int k, int worker) {
    const int t = n - 1 - k;
    if (!scratch[worker]) scratch[worker] = std::make_unique<LinearisationScratch>();
    build_cost(t);
    models[t].F = problem.smoothing ? linearise_smoothed(system, trajectory.point(t), *problem.smoothing)
                                    : linearise(system, trajectory.point(t), *scratch[worker]);
  };
  parallel_chain(n, threads, build, [&](int k) {
    if (sweep) sweep(n - 1 - k);
  });
}

ValueFunction last_value(const ControlProblem& problem, const Trajectory& trajectory,
                         const StateQuadratic& last) {
  ValueFunction value{Eigen::MatrixXd::Zero(kMemory, kMemory), Eigen::VectorXd::Zero(kMemory)};
  value.V.topLeftCorner(kTangent, kTangent) = last.hessian.selfadjointView<Eigen::Lower>();
  value.v.head(kTangent) = last.gradient;
  const int n = trajectory.size();
  add_torques(problem, trajectory, n, problem.cost.last_weight(trajectory.begin + n), value.V, value.v);
  return value;
}

SweepResult sweep_frame(const ControlProblem& problem, const Trajectory& trajectory, int t,
                        const FrameModel& model, SweepState& state, Feedback& law) {
  const Eigen::VectorXd none;
  stage_cost(problem, trajectory, t, model.cost, state.stage);
  const Eigen::VectorXd& gap = trajectory.gaps.empty() ? none : trajectory.gaps[t + 1];
  return riccati_step({model.F, gap, kDofs}, state.regularisation, state.stage, state.value, law,
                      state.scratch);
}

namespace {

/// A sweep in progress, from the last frame to the first.
struct BackwardSweep {
  const ControlProblem& problem;
  const Trajectory& trajectory;
  const List<FrameModel>& models;
  Sweep& out;
  SweepState state;

  /// Sweeps frame t, after t + 1. Once Q_uu was not positive definite, does nothing for earlier frames.
  void frame(int t) {
    const int n = trajectory.size();
    if (t == n - 1) {
      out.laws.resize(n);
      out.positive = true;
      out.decrease = 0;
      state.value = last_value(problem, trajectory, models[n].cost);
    }
    if (!out.positive) return;
    const SweepResult step = sweep_frame(problem, trajectory, t, models[t], state, out.laws[t]);
    out.positive = step.positive;
    if (step.positive) out.decrease += step.decrease;
  }
};

}  // namespace

void sweep_back(const ControlProblem& problem, const Trajectory& trajectory, const List<FrameModel>& models,
                double regularisation, Sweep& out) {
  BackwardSweep sweep{problem, trajectory, models, out, {regularisation}};
  for (int t = trajectory.size() - 1; t >= 0; --t) sweep.frame(t);
}

Array<float, kLanes> step_lengths() {
  constexpr Array<float, 16> kLengths = {1.0f,  0.9f,  0.8f,  0.7f,  0.6f,  0.5f,  0.4f,   0.32f,
                                         0.25f, 0.18f, 0.12f, 0.08f, 0.05f, 0.03f, 0.015f, 0.007f};
  Array<float, kLanes> out;
  for (std::size_t lane = 0; lane < kLanes; ++lane) out[lane] = kLengths[lane * kLengths.size() / kLanes];
  return out;
}

namespace {

/// Takes the lane that follows the reference for most frames; of several, the one of least cost.
void close_gaps(const System& system, const Fan& fan, Trajectory& trajectory, int& lane) {
  const int n = trajectory.size();
  lane = 0;
  for (int other = 1; other < kLanes; ++other) {
    const bool longer = fan.frames_kept[other] > fan.frames_kept[lane];
    const bool cheaper = fan.frames_kept[other] == fan.frames_kept[lane] && fan.cost[other] < fan.cost[lane];
    if (longer || cheaper) lane = other;
  }
  const int kept = fan.frames_kept[lane];
  if (kept == n) return take_lane(fan, lane, trajectory);
  Trajectory spliced = trajectory;
  take_lane(fan, lane, spliced);
  for (int t = 1; t <= kept; ++t) {
    trajectory.x[t] = spliced.x[t];
    trajectory.u[t - 1] = spliced.u[t - 1];
  }
  trajectory.gaps = find_gaps(system, trajectory);
}

}  // namespace

Iteration improve(const ControlProblem& problem, double trusted, int threads, IterationState& state,
                  Trajectory& trajectory) {
  Sweep& sweep = state.sweep;
  double& regularisation = state.regularisation;
  if (state.models_current) {
    sweep_back(problem, trajectory, state.models, regularisation, sweep);
  } else {
    BackwardSweep backwards{problem, trajectory, state.models, sweep, {regularisation}};
    build_models(problem, trajectory, threads, state.models, [&](int t) { backwards.frame(t); });
    state.models_current = true;
  }
  Iteration result;
  const auto failed = [&] {
    regularisation = std::max(8.0 * regularisation, 0.05);
    return result;
  };
  if (!sweep.positive) return failed();
  const Array<float, kLanes> alpha = step_lengths();
  RollConfig config;
  config.failure_distance = trusted;
  const Fan fan = roll_out(problem.system, problem.cost, trajectory, sweep.laws, alpha, config);
  int lane = 0;
  if (!trajectory.gaps.empty()) {
    close_gaps(problem.system, fan, trajectory, lane);
    result.decrease = 1.0;
  } else {
    lane = static_cast<int>(std::min_element(fan.cost.begin(), fan.cost.end()) - fan.cost.begin());
    const double now = fan.cost[lane];
    if (!(now < trajectory.cost)) return failed();
    result.decrease = (trajectory.cost - now) / std::max(trajectory.cost, 1e-9);
    take_lane(fan, lane, trajectory);
  }
  state.models_current = false;
  result.alpha = alpha[lane];
  if (result.alpha > 0.95f) regularisation *= 0.3;
  if (result.alpha < 0.35f) regularisation = std::max(2.0 * regularisation, 0.01);
  return result;
}

}  // namespace mimicx::control
