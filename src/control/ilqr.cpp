#include "control/ilqr.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "control/shooting.h"
#include "core/parallel.h"

namespace mimicx::control {
namespace {

/// The part of a frame's cost that is quadratic in (x, w, u).
void stage_cost(const System& system, const Cost& cost, const Trajectory& trajectory, int t,
                const StateQuadratic& state, StageCost& out) {
  const CostWeights& weights = cost.weights;
  const int controls = system.controls(), u = kMemory, w = kTangent;
  out.H.resize(kMemory + controls, kMemory + controls);
  out.H.triangularView<Eigen::Lower>().setZero();
  out.g.setZero(kMemory + controls);
  if (t > 0) {  // the first state is given
    out.g.head(kTangent) = state.gradient;
    out.H.topLeftCorner(kPositions, kPositions) = state.position_hessian;
    out.H.diagonal().segment(kPositions, kPositions) = state.velocity_hessian;
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
    const double weight = k < kDofs + 3 ? weights.help : weights.help_spin;
    out.g[u + k] = 2.0 * weight * static_cast<double>(now[k]);
    out.H(u + k, u + k) = 2.0 * weight;
  }
}

}  // namespace

void build_models(const System& system, const Cost& cost, const Trajectory& trajectory, int threads,
                  List<FrameModel>& models, const std::function<void(int t)>& sweep,
                  const std::optional<DifferenceSteps>& smoothing) {
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
    const FramePoint point = trajectory.point(t);
    models[t].F = smoothing ? linearise_smoothed(system, point, *smoothing)
                            : linearise(system, point, *scratch[worker]);
  };
  parallel_chain(n, threads, build, [&](int k) {
    if (sweep) sweep(n - 1 - k);
  });
}

ValueFunction last_value(const StateQuadratic& last) {
  ValueFunction value{Eigen::MatrixXd::Zero(kMemory, kMemory), Eigen::VectorXd::Zero(kMemory)};
  value.V.topLeftCorner(kPositions, kPositions) = last.position_hessian;
  value.V.diagonal().segment(kPositions, kPositions) = last.velocity_hessian;
  value.v.head(kTangent) = last.gradient;
  return value;
}

SweepResult sweep_frame(const System& system, const Cost& cost, const Trajectory& trajectory, int t,
                        const FrameModel& model, double regularisation, ValueFunction& value, Feedback& law,
                        StageCost& stage, RiccatiScratch<float>& scratch) {
  const Eigen::VectorXd none;
  stage_cost(system, cost, trajectory, t, model.cost, stage);
  const Eigen::VectorXd& gap = trajectory.gaps.empty() ? none : trajectory.gaps[t + 1];
  return riccati_step(model.F, gap, kDofs, regularisation, stage, value, law, scratch);
}

namespace {

/// A sweep under way, from the last frame to the first.
struct Backwards {
  const System& system;
  const Cost& cost;
  const Trajectory& trajectory;
  const List<FrameModel>& models;
  double regularisation;
  Sweep& out;
  ValueFunction value = {};
  StageCost stage = {};
  RiccatiScratch<float> scratch = {};

  /// Frame t, after t + 1. Where Q_uu is not positive, the sweep ends: nothing is done for the frames before.
  void frame(int t) {
    const int n = trajectory.size();
    if (t == n - 1) {
      out.laws.resize(n);
      out.positive = true;
      out.decrease = 0;
      value = last_value(models[n].cost);
    }
    if (!out.positive) return;
    const SweepResult step = sweep_frame(system, cost, trajectory, t, models[t], regularisation, value,
                                         out.laws[t], stage, scratch);
    out.positive = step.positive;
    if (step.positive) out.decrease += step.decrease;
  }
};

}  // namespace

void sweep_back(const System& system, const Cost& cost, const Trajectory& trajectory,
                const List<FrameModel>& models, double regularisation, Sweep& out) {
  Backwards sweep{system, cost, trajectory, models, regularisation, out};
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

/// Takes the lane that follows longest, and of those that follow to the end the cheapest.
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

Iteration improve(const System& system, const Cost& cost, int threads, bool fresh, double trusted,
                  List<FrameModel>& models, Sweep& sweep, double& regularisation, Trajectory& trajectory) {
  if (fresh) {
    Backwards backwards{system, cost, trajectory, models, regularisation, sweep};
    build_models(system, cost, trajectory, threads, models, [&](int t) { backwards.frame(t); });
  } else {
    sweep_back(system, cost, trajectory, models, regularisation, sweep);
  }
  const auto harder = [&] { regularisation = std::max(8.0 * regularisation, 0.05); };
  Iteration result;
  if (!sweep.positive) {
    harder();
    return result;
  }
  const Array<float, kLanes> alpha = step_lengths();
  const auto scratch = std::make_unique<Data<P>>();
  RollConfig config;
  config.lost = trusted;
  const Fan fan = roll_out(system, cost, trajectory, sweep.laws, alpha, in_all_lanes<P>(trajectory.x[0]),
                           *scratch, config);
  int lane = 0;
  if (!trajectory.gaps.empty()) {
    close_gaps(system, fan, trajectory, lane);
    result.decrease = 1.0;
  } else {
    lane = static_cast<int>(std::min_element(fan.cost.begin(), fan.cost.end()) - fan.cost.begin());
    const double now = fan.cost[lane];
    if (!(now < trajectory.cost)) {
      harder();
      return result;
    }
    result.decrease = (trajectory.cost - now) / std::max(trajectory.cost, 1e-9);
    take_lane(fan, lane, trajectory);
  }
  result.alpha = alpha[lane];
  if (result.alpha > 0.95f) regularisation *= 0.3;
  if (result.alpha < 0.35f) regularisation = std::max(2.0 * regularisation, 0.01);
  return result;
}

}  // namespace mimicx::control
