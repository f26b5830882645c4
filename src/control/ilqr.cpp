#include "control/ilqr.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/parallel.h"

namespace mimicx::control {
namespace {

/// The part of a frame's cost that is quadratic in (x, w, u).
void stage_cost(const System& system, const Cost& cost, const Trajectory& trajectory, int t,
                const StateQuadratic& state, StageCost& out) {
  const CostWeights& weights = cost.weights;
  const int controls = system.controls(), u = kMemory, w = kTangent;
  out.H.setZero(kMemory + controls, kMemory + controls);
  out.g.setZero(kMemory + controls);
  if (t > 0) {  // the first state is given
    out.g.head(kTangent) = state.gradient;
    out.H.topLeftCorner(kPositions, kPositions) = state.position_hessian;
    out.H.diagonal().segment(kPositions, kPositions) = state.velocity_hessian;
  }
  const Control& now = trajectory.u[static_cast<std::size_t>(t)];
  const Control& before = trajectory.previous(t);
  for (int k = 0; k < kDofs; ++k) {
    const auto n = static_cast<std::size_t>(k);
    const double value = static_cast<double>(now[n]), change = value - static_cast<double>(before[n]);
    out.g[u + k] = 2.0 * (weights.residual * value + weights.change * change);
    out.g[w + k] = -2.0 * weights.change * change;
    out.H(u + k, u + k) = 2.0 * (weights.residual + weights.change);
    out.H(w + k, w + k) = 2.0 * weights.change;
    out.H(u + k, w + k) = -2.0 * weights.change;
  }
  for (int k = kDofs; k < controls; ++k) {
    const double weight = k < kDofs + 3 ? weights.help : weights.help_spin;
    out.g[u + k] = 2.0 * weight * static_cast<double>(now[static_cast<std::size_t>(k)]);
    out.H(u + k, u + k) = 2.0 * weight;
  }
}

}  // namespace

void build_models(const System& system, const Cost& cost, const Trajectory& trajectory,
                  const Linearisation& how, int threads, std::vector<FrameModel>& models) {
  const int n = trajectory.size();
  models.resize(static_cast<std::size_t>(n + 1));
  // As many chunks whatever the threads; each keeps its scratch and takes every kChunks-th frame.
  constexpr int kChunks = 8;
  parallel_for(kChunks, threads, [&](int chunk) {
    const auto scratch = std::make_unique<LinearisationScratch>();
    for (int t = chunk; t <= n; t += kChunks) {
      const auto k = static_cast<std::size_t>(t);
      models[k].cost = state_quadratic(system, cost, trajectory.begin + t, trajectory.x[k]);
      if (t < n) models[k].F = linearise(system, trajectory.point(t), how, *scratch);
    }
  });
}

void sweep_back(const System& system, const Cost& cost, const Trajectory& trajectory,
                const std::vector<FrameModel>& models, const std::vector<Eigen::VectorXd>& gaps,
                double regularisation, Sweep& out) {
  const int n = trajectory.size();
  out.laws.resize(static_cast<std::size_t>(n));
  out.positive = true;
  out.decrease = 0;
  ValueFunction value{Eigen::MatrixXd::Zero(kMemory, kMemory), Eigen::VectorXd::Zero(kMemory)};
  const StateQuadratic& last = models[static_cast<std::size_t>(n)].cost;
  value.V.topLeftCorner(kPositions, kPositions) = last.position_hessian;
  value.V.diagonal().segment(kPositions, kPositions) = last.velocity_hessian;
  value.v.head(kTangent) = last.gradient;
  StageCost stage;
  RiccatiScratch scratch;
  const Eigen::VectorXd none;
  for (int t = n - 1; t >= 0; --t) {
    const auto k = static_cast<std::size_t>(t);
    stage_cost(system, cost, trajectory, t, models[k].cost, stage);
    const SweepResult step = riccati_step(models[k].F, gaps.empty() ? none : gaps[k + 1], kDofs,
                                          regularisation, stage, value, out.laws[k], scratch);
    if (!step.positive) {
      out.positive = false;
      return;
    }
    out.decrease += step.decrease;
  }
}

std::array<float, kLanes> step_lengths() {
  constexpr std::array<float, 16> kLengths = {1.0f,  0.9f,  0.8f,  0.7f,  0.6f,  0.5f,  0.4f,   0.32f,
                                              0.25f, 0.18f, 0.12f, 0.08f, 0.05f, 0.03f, 0.015f, 0.007f};
  std::array<float, kLanes> out;
  for (std::size_t lane = 0; lane < kLanes; ++lane) out[lane] = kLengths[lane * kLengths.size() / kLanes];
  return out;
}

Iteration improve(const System& system, const Cost& cost, const Linearisation& how, int threads, bool fresh,
                  std::vector<FrameModel>& models, Sweep& sweep, double& regularisation,
                  Trajectory& trajectory) {
  if (fresh) build_models(system, cost, trajectory, how, threads, models);
  const auto harder = [&] { regularisation = std::max(8.0 * regularisation, 0.05); };
  sweep_back(system, cost, trajectory, models, {}, regularisation, sweep);
  Iteration result;
  if (!sweep.positive) {
    harder();
    return result;
  }
  const std::array<float, kLanes> alpha = step_lengths();
  const auto scratch = std::make_unique<Data<P>>();
  const Fan fan =
      roll_out(system, cost, trajectory, sweep.laws, alpha, in_all_lanes<P>(trajectory.x[0]), *scratch);
  const auto best = std::min_element(fan.cost.begin(), fan.cost.end()) - fan.cost.begin();
  const double now = fan.cost[static_cast<std::size_t>(best)];
  if (!(now < trajectory.cost)) {
    harder();
    return result;
  }
  result.decrease = (trajectory.cost - now) / std::max(trajectory.cost, 1e-9);
  result.alpha = alpha[static_cast<std::size_t>(best)];
  if (result.alpha > 0.95f) regularisation *= 0.3;
  if (result.alpha < 0.35f) regularisation = std::max(2.0 * regularisation, 0.01);
  take_lane(fan, static_cast<int>(best), trajectory);
  return result;
}

}  // namespace mimicx::control
