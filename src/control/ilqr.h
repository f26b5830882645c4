/// One iteration of iLQR: linearise along a trajectory, sweep backwards, search along the step length.
///
/// Source: Tassa, Erez, Todorov (2012), §II. Deviations: Gauss–Newton (no second derivatives of the
/// dynamics); all step lengths are tried at once, in the lanes of a pack; the regularisation is proximal in
/// the controls.
#pragma once

#include <optional>

#include "control/linearisation.h"
#include "control/trajectory.h"

namespace mimicx::control {

/// What every iteration on a trajectory has in common. Refers to its parts.
struct ControlProblem {
  const System& system;
  const Cost& cost;
  std::optional<DifferenceSteps> smoothing =
      {};  ///< derivatives smoothed over these steps (differences.h); none: exact
};

/// The linear-quadratic model of one frame.
struct FrameModel {
  FrameMatrix F;        ///< of the step that starts here
  StateQuadratic cost;  ///< of the state here
};

/// Models of all frames 0 … n of a trajectory: F of all but the last, costs of all. Frames in parallel, same
/// bytes for any number of threads.
/// @param sweep  called with t = n − 1, …, 0, one after the other, as soon as the models of t and of all
///               later frames are there: it runs beside the models of earlier frames; may be empty
void build_models(const ControlProblem& problem, const Trajectory& trajectory, int threads,
                  List<FrameModel>& models, const std::function<void(int t)>& sweep = {});

/// The result of a backward sweep.
struct Sweep {
  List<Feedback> laws;    ///< [n]
  bool positive = false;  ///< Q_uu was positive definite everywhere
  double decrease = 0;    ///< promised for a full step
};

/// What a backward sweep carries from frame to frame.
struct SweepState {
  double regularisation = 0;  ///< proximal weight on changes of the controls
  ValueFunction value = {};   ///< of the frame swept last; at the start `last_value`
  StageCost stage = {};       ///< Q of the frame swept last
  RiccatiScratch<float> scratch = {};
};

/// The value of a trajectory's last state. @param last  the model of its cost
ValueFunction last_value(const ControlProblem& problem, const Trajectory& trajectory,
                         const StateQuadratic& last);

/// One frame backwards: the law at frame t of the trajectory. @param state  after frame t + 1
SweepResult sweep_frame(const ControlProblem& problem, const Trajectory& trajectory, int t,
                        const FrameModel& model, SweepState& state, Feedback& law);

/// All frames backwards. @param regularisation  proximal weight on changes of the controls
void sweep_back(const ControlProblem& problem, const Trajectory& trajectory, const List<FrameModel>& models,
                double regularisation, Sweep& out);

/// Step lengths in the lanes, the full one first.
Array<float, kLanes> step_lengths();

/// What one iteration on a trajectory passes on to the next.
struct IterationState {
  List<FrameModel> models;
  bool models_current = false;  ///< `models` are those of the trajectory as it is now
  Sweep sweep;
  double regularisation = 0;  ///< adapted: less after a full step, more after a short step or none
};

struct Iteration {
  double decrease = -1;  ///< relative to the cost before; < 0: none was found; of a trajectory with gaps: 1
  float alpha = 0;       ///< the step length taken
};

/// Improves a trajectory. The cost of a roll-out never rises. Of a trajectory with gaps, as many frames from
/// the start as stay within `trusted` metres of the reference become a roll-out, and later frames keep their
/// states; when all frames stay within, no gap is left.
Iteration improve(const ControlProblem& problem, double trusted, int threads, IterationState& state,
                  Trajectory& trajectory);

}  // namespace mimicx::control
