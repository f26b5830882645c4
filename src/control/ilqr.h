/// One iteration of iLQR: linearise along a trajectory, sweep backwards, search along the step length.
///
/// Source: Tassa, Erez, Todorov (2012), §II. Deviations: Gauss–Newton (the dynamics' second derivatives are
/// left out), step lengths tried all at once in the lanes of a pack, and the regularisation is proximal in
/// the controls.
#pragma once

#include <optional>

#include "control/linearisation.h"
#include "control/trajectory.h"

namespace mimicx::control {

/// What the sweep needs of one frame.
struct FrameModel {
  FrameMatrix F;        ///< of the step that starts here
  StateQuadratic cost;  ///< of the state here
};

/// Models of frames first … n of a trajectory: F of all but the last, costs of all. Frames in parallel, same
/// bytes for any number of threads.
/// @param sweep  called with t = n − 1, …, 0, one after the other, as soon as the models of t and of the
///               frames behind it are there: it runs beside the models of the frames before; may be empty
/// @param smoothing  none: the derivatives of the nominal motion; else those of differences.h
void build_models(const System& system, const Cost& cost, const Trajectory& trajectory, int threads,
                  List<FrameModel>& models, const std::function<void(int t)>& sweep = {},
                  const std::optional<DifferenceSteps>& smoothing = {});

struct Sweep {
  List<Feedback> laws;    ///< [n]
  bool positive = false;  ///< Q_uu was positive definite everywhere
  double decrease = 0;    ///< promised for a full step
};

/// The value of a trajectory's last state.
ValueFunction last_value(const StateQuadratic& last);

/// One frame backwards: the law at frame t of the trajectory. @param value  of frame t + 1 in, of frame t out
SweepResult sweep_frame(const System& system, const Cost& cost, const Trajectory& trajectory, int t,
                        const FrameModel& model, double regularisation, ValueFunction& value, Feedback& law,
                        StageCost& stage, RiccatiScratch<float>& scratch);

/// @param regularisation  proximal weight on changes of the controls
void sweep_back(const System& system, const Cost& cost, const Trajectory& trajectory,
                const List<FrameModel>& models, double regularisation, Sweep& out);

/// Step lengths in the lanes, the full one first.
Array<float, kLanes> step_lengths();

struct Iteration {
  double decrease = -1;  ///< relative to the cost before; < 0: none was found; of a trajectory with gaps: 1
  float alpha = 0;       ///< the step length taken
};

/// Improves a trajectory. Of a roll-out the cost never rises. Of one with gaps, as many frames from the start
/// as stay within `trusted` metres of the reference become a roll-out, the frames behind them keep their
/// states; when all do, the gaps are gone.
/// @param fresh  build the models anew; false: those of the call before are still right
/// @param regularisation  adapted: less after a full step, more after a short or no one
Iteration improve(const System& system, const Cost& cost, int threads, bool fresh, double trusted,
                  List<FrameModel>& models, Sweep& sweep, double& regularisation, Trajectory& trajectory);

}  // namespace mimicx::control
