/// Trajectories, and roll-outs in the lanes of a pack.
#pragma once

#include <functional>
#include <span>

#include "control/cost/cost.h"
#include "control/differences.h"
#include "control/riccati.h"

namespace mimicx::control {

/// A piece of a motion: states of the frames begin … begin + n and the n controls between them.
struct Trajectory {
  int begin = 0;
  List<State<double>> x;       ///< [n + 1] values that the simulator's floats can hold
  List<Control> u;             ///< [n]
  Control before{};            ///< the control before u[0]; only its residuals matter
  List<Eigen::VectorXd> gaps;  ///< [n + 1], or empty for a roll-out (shooting.h)
  double cost = 0;             ///< of the states 1 … n and the controls
  double worst = 0;            ///< distance of any body from the reference in these frames, m

  int size() const { return static_cast<int>(u.size()); }
  const Control& previous(int k) const { return k == 0 ? before : u[k - 1]; }
  FramePoint point(int k) const { return {begin + k, x[k], previous(k), u[k]}; }
};

/// Controls of all lanes.
using LaneControls = Eigen::Matrix<float, kMaxControls, kLanes, Eigen::RowMajor>;

/// z − z̄ of all lanes.
using LaneMemory = Eigen::Matrix<float, kMemory, kLanes, Eigen::RowMajor>;

/// z − z̄ of every lane, entries clamped to ± 10: a law means nothing that far away, and infinities must not
/// spread.
LaneMemory memory_difference(const State<P>& x, const LaneControls& before, const State<double>& nominal_x,
                             const Control& nominal_before);

/// kLanes roll-outs side by side.
struct Fan {
  List<State<P>> x;                  ///< [n + 1]
  List<LaneControls> u;              ///< [n]
  Array<double, kLanes> cost{};      ///< infinite if the simulation went wrong
  Array<double, kLanes> worst{};     ///< largest distance of a body, m; infinite likewise
  Array<int, kLanes> frames_kept{};  ///< frames until a body is farther than `failure_distance` from its goal
};

/// Called before the step that starts at a frame; may change the lanes' states (pushes).
using Disturbance = std::function<void(int frame, State<P>& x)>;

struct RollConfig {
  double failure_distance = 0.5;  ///< distance of a body beyond which a lane has failed, m
  Disturbance disturbance;
};

/// Rolls a trajectory out again from its first state, every lane under its own share α of the new controls:
///     u = ū + α k + K (z − z̄)                                                  docs/control.md §3, (4)
/// @param laws  [n] or empty: u = ū
Fan roll_out(const System& system, const Cost& cost, const Trajectory& nominal,
             std::span<const Feedback> laws, const Array<float, kLanes>& alpha,
             const RollConfig& config = {});

/// Replaces the trajectory's states and controls by those of one lane of a fan.
void take_lane(const Fan& fan, int lane, Trajectory& trajectory);

}  // namespace mimicx::control
