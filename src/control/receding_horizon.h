/// Receding horizon: follows a reference window by window, and backtracks if a window fails.
///
/// A window starts at the state that the motion has reached. A few iterations of iLQR improve it, and its
/// first frames are committed. The next window starts there, with the rest of this one as its first guess.
/// Close to a failure results are chaotic: one window length may save a falling body, another may not. So if
/// a window leaves the reference, planning goes back some frames and tries a longer window, then a shorter
/// one. When all lengths or the budget are used up, the motion ends there. Source: receding horizon as in
/// Tassa, Erez, Todorov (2012), §III; backtracking and lengths are our own.
#pragma once

#include "control/ilqr.h"
#include "control/plan_control.h"

namespace mimicx::control {

struct HorizonConfig {
  int horizon = 16;        ///< frames of a window
  int commit = 8;          ///< frames committed from it
  double easy_cost = 0.2;  ///< per frame; a window of less cost needs one iteration only
  int iterations = 2;      ///< at most, for a window below `hard_cost` per frame
  double hard_cost = 0.5;
  int hard_iterations = 8;         ///< at most, for the first window and windows above `hard_cost`
  double stop = 0.03;              ///< iterations end below this relative decrease of the cost
  double trusted = 0.2;            ///< limit of bodies' distances for closing gaps (`improve`), m
  double failure_distance = 0.35;  ///< a window fails beyond this distance of a body, m
  int back = 20;                   ///< frames to go back after a failure
  int backtracks = 12;             ///< at most, in the whole motion
  /// Limit of linearised frames per frame of the motion, over all iterations. A motion that is followed takes
  /// 4 to 20.
  double budget = 25;
};

/// How following a motion ended: at its end, by failure, or by `should_stop`.
enum class Ending { kFollowed, kLost, kStopped };

struct HorizonResult {
  Trajectory motion;  ///< as far as it was followed; after a failure the longest attempt
  Ending ending = Ending::kFollowed;
  int lost_frame = -1;  ///< first frame that no window reached; of several failures the latest frame
  int lost_body = -1;   ///< farthest from the goal there, or one frame before if the window was cut there;
                        ///< -1: nothing was reached
  double lost_distance = 0;  ///< its distance, m
  int iterations = 0;
  int linearised = 0;  ///< frames, over all iterations
  int backtracks = 0;
};

/// Follows the cost's goal from the last state of `start` to frame `end`.
/// @param start  at least one state, with the controls that led there
/// @param guess  initial guess from frame 0 on. After its end, and without one, a frame starts with the state
///               of the goal and the controls of the window's frame before it, the first one with none
HorizonResult follow_in_windows(const ControlProblem& problem, const HorizonConfig& config,
                                const PlanControl& control, Trajectory start, int end,
                                const Trajectory& guess = {});

/// Simulates a motion's controls from its first state, without feedback; replaces its states, cost and
/// distance.
void replay_controls(const System& system, const Cost& cost, Trajectory& motion);

}  // namespace mimicx::control
