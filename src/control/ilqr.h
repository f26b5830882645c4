/// One iteration of iLQR: linearise along a trajectory, sweep backwards, search along the step length.
///
/// Source: Tassa, Erez, Todorov (2012), §II. Deviations: Gauss–Newton (the dynamics' second derivatives are
/// left out), step lengths tried all at once in the lanes of a pack, and the regularisation is proximal in
/// the controls.
#pragma once

#include "control/linearisation.h"
#include "control/rollout.h"

namespace mimicx::control {

/// What the sweep needs of one frame.
struct FrameModel {
  FrameMatrix F;        ///< of the step that starts here
  StateQuadratic cost;  ///< of the state here
};

/// Models of frames first … n of a trajectory: F of all but the last, costs of all. Frames in parallel, same
/// bytes for any number of threads.
void build_models(const System& system, const Cost& cost, const Trajectory& trajectory,
                  const Linearisation& how, int threads, std::vector<FrameModel>& models);

struct Sweep {
  std::vector<Feedback> laws;  ///< [n]
  bool positive = false;       ///< Q_uu was positive definite everywhere
  double decrease = 0;         ///< promised for a full step
};

/// @param gaps  [n + 1] of x at the frames, f(x_{t−1}) ⊖ x_t; or empty: none
/// @param regularisation  proximal weight on changes of the controls
void sweep_back(const System& system, const Cost& cost, const Trajectory& trajectory,
                const std::vector<FrameModel>& models, const std::vector<Eigen::VectorXd>& gaps,
                double regularisation, Sweep& out);

/// Step lengths in the lanes, the full one first.
std::array<float, kLanes> step_lengths();

struct Iteration {
  double decrease = -1;  ///< relative to the cost before; < 0: none was found
  float alpha = 0;       ///< the step length taken
};

/// Improves a trajectory that is a roll-out from its first state; its cost never rises.
/// @param fresh  build the models anew; false: those of the call before are still right
/// @param regularisation  adapted: less after a full step, more after a short or no one
Iteration improve(const System& system, const Cost& cost, const Linearisation& how, int threads, bool fresh,
                  std::vector<FrameModel>& models, Sweep& sweep, double& regularisation,
                  Trajectory& trajectory);

}  // namespace mimicx::control
