/// Following a reference window by window, with a way back where a window is lost.
///
/// A window of some frames starts at the state that the motion has reached, is improved by a few iterations
/// of iLQR, and its first frames are committed; the next window starts there with the rest as its first
/// guess. Near failure results are chaotic: a body that is about to fall can be caught by one length of the
/// window and not by another. So a window that loses the reference goes back some frames and is tried longer,
/// then shorter, until these or the budget are used up; then the motion ends there. Source: receding horizon
/// as in Tassa, Erez, Todorov (2012), §III; backtracking and lengths are our own.
#pragma once

#include "control/ilqr.h"
#include "control/plan_control.h"

namespace mimicx::control {

struct HorizonConfig {
  int horizon = 20;         ///< frames of a window
  int commit = 5;           ///< frames that are settled by it
  double easy_cost = 0.02;  ///< per frame: a window that costs less after its first iteration needs no other
  int iterations = 3;       ///< at most, of a window that costs less than `hard_cost` per frame
  double hard_cost = 0.5;
  int hard_iterations = 8;  ///< at most, of the first window and of one that costs more
  double stop = 0.03;       ///< relative decrease of the cost under which iterations end
  double trusted = 0.2;     ///< a roll-out that closes gaps is kept as far as no body is farther off, m
  double lost = 0.35;       ///< distance of a body at which a window is lost, m
  int back = 20;            ///< frames to go back then
  int backtracks = 12;      ///< of the whole motion
  /// Of the whole motion: linearised frames, all iterations together, per frame. A followed motion takes 4
  /// to 20.
  double budget = 25;
};

/// How a motion ended.
enum class Ending { kFollowed, kLost, kStopped };

struct HorizonResult {
  Trajectory motion;  ///< from the first state as far as it was followed; where it was lost, the longest try
  Ending ending = Ending::kFollowed;
  int lost_frame = -1;       ///< the first frame that no window reached, of those that were ever lost
  int lost_body = -1;        ///< the one that was farthest from the goal there
  double lost_distance = 0;  ///< of it, m
  int iterations = 0;
  int linearised = 0;  ///< frames, all iterations together
  int backtracks = 0;
};

/// Follows the cost's goal from the last state of `start` to frame `end`.
/// @param start  at least one state; its controls are the history
/// @param guess  a motion from frame 0 to begin with, as far as it goes; behind its end, and without one, a
///               frame begins with the controls before it and with the goal's state
HorizonResult follow_in_windows(const ControlProblem& problem, const HorizonConfig& config,
                                const PlanControl& control, Trajectory start, int end,
                                const Trajectory& guess = {});

/// Simulates a motion's controls from its first state, without feedback; replaces its states, cost and
/// distance.
void replay_controls(const System& system, const Cost& cost, Trajectory& motion);

}  // namespace mimicx::control
