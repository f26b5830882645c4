#include "control/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace mimicx::control {
namespace {

/// Controls of every lane under the law of one frame.
LaneControls controls_of(const System& system, const Control& nominal, const Feedback* law,
                         const LaneMemory& dz, const Array<float, kLanes>& alpha) {
  LaneControls u;
  for (int k = 0; k < kMaxControls; ++k) u.row(k).setConstant(nominal[k]);
  if (law == nullptr) return u;
  const auto n = law->k.size();
  u.topRows(n).noalias() += law->K * dz;
  for (int lane = 0; lane < kLanes; ++lane) u.col(lane).head(n) += alpha[lane] * law->k;
  const auto limit = static_cast<float>(system.max_residual);
  u.topRows(kDofs) = u.topRows(kDofs).cwiseMin(limit).cwiseMax(-limit);
  return u;
}

Control lane_of(const LaneControls& u, int lane) {
  Control out;
  for (int k = 0; k < kMaxControls; ++k) out[k] = u(k, lane);
  return out;
}

}  // namespace

LaneMemory memory_difference(const State<P>& x, const LaneControls& before, const State<double>& nominal_x,
                             const Control& nominal_before) {
  constexpr float kFarthest = 10.0f;
  LaneMemory out;
  const Tangent<P> d = difference(x, in_all_lanes<P>(nominal_x));
  for (int k = 0; k < kTangent; ++k)
    for (int lane = 0; lane < kLanes; ++lane) {
      const float value = d[k][lane];
      out(k, lane) = std::isfinite(value) ? std::clamp(value, -kFarthest, kFarthest) : 0.0f;
    }
  for (int k = 0; k < kDofs; ++k) out.row(kTangent + k) = before.row(k).array() - nominal_before[k];
  return out;
}

Fan roll_out(const System& system, const Cost& cost, const Trajectory& nominal,
             std::span<const Feedback> laws, const Array<float, kLanes>& alpha, const RollConfig& config) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Fan fan;
  const int n = nominal.size();
  fan.frames_kept.fill(n);
  const auto scratch = std::make_unique<Data<P>>();
  State<P> x = in_all_lanes<P>(nominal.x[0]);
  Target<P> from = target_of(system, nominal.begin, nominal.before), to{};
  Wrench<P> assistance = assistance_of(system, Control{});
  LaneControls before;
  for (int k = 0; k < kMaxControls; ++k) before.row(k).setConstant(nominal.before[k]);
  LaneMemory dz = LaneMemory::Zero();
  fan.x.push_back(x);
  for (int t = 0; t < n; ++t) {
    const int frame = nominal.begin + t;
    if (config.disturbance) config.disturbance(frame, x);
    const Feedback* law = laws.empty() ? nullptr : &laws[static_cast<std::size_t>(t)];
    if (law != nullptr) dz = memory_difference(x, before, nominal.x[t], nominal.previous(t));
    const LaneControls u = controls_of(system, nominal.u[t], law, dz, alpha);
    for (int lane = 0; lane < kLanes; ++lane) {
      set_target(
          system, frame + 1, [&](int dof) { return u(dof, lane); }, lane, to);
      if (system.assisted)
        set_assistance(
            system, [&](int e) { return u(kDofs + e, lane); }, lane, assistance);
    }
    const MaskOf<P> wrong = advance(system, from, to, assistance, x, *scratch);
    const LaneCost now = state_cost(system, cost, frame + 1, x, *scratch);
    const auto torques = torque_cost(system, cost, frame + 1, x, [&](int k, int lane) { return u(k, lane); });
    const double weight = t + 1 == n ? cost.last_weight(frame + 1) : 1.0;
    for (int lane = 0; lane < kLanes; ++lane) {
      const double value = weight * (static_cast<double>(now.cost[lane]) + torques[lane]);
      const double distance = std::sqrt(static_cast<double>(now.worst[lane]));
      const bool broken = wrong[lane] != 0 || !std::isfinite(value);
      fan.cost[lane] +=
          broken ? kInfinity : value + control_cost(system, cost, lane_of(u, lane), lane_of(before, lane));
      fan.worst[lane] = std::max(fan.worst[lane], broken ? kInfinity : distance);
      if (!(fan.worst[lane] <= config.failure_distance))
        fan.frames_kept[lane] = std::min(fan.frames_kept[lane], t);
    }
    from = to;
    before = u;
    fan.x.push_back(x);
    fan.u.push_back(u);
  }
  return fan;
}

void take_lane(const Fan& fan, int lane, Trajectory& trajectory) {
  trajectory.x.resize(fan.x.size());
  trajectory.u.resize(fan.u.size());
  for (std::size_t t = 0; t < fan.x.size(); ++t) trajectory.x[t] = lane_of(fan.x[t], lane);
  for (std::size_t t = 0; t < fan.u.size(); ++t) trajectory.u[t] = lane_of(fan.u[t], lane);
  trajectory.gaps.clear();
  trajectory.cost = fan.cost[lane];
  trajectory.worst = fan.worst[lane];
}

}  // namespace mimicx::control
