/// Feedback around a finished plan: how to correct the controls when the state is not the planned one.
///
///     u = ū_t + K_t (z − z̄_t),      z = (state, residual before)
///
/// The gains that planning itself uses are too stiff for contact. They come from derivatives at the planned
/// state, and these are wrong for a state a few millimetres away, in which other contacts are open. The gains
/// here are softened twice: their derivatives are smoothed over some centimetres and degrees (differences.h),
/// and residuals have a high price. One sweep goes over the whole motion in blocks of frames, so that memory
/// does not grow with the length of the motion (but for the gains themselves, 39 kB per frame).
#pragma once

#include "control/ilqr.h"
#include "control/plan_control.h"

namespace mimicx::control {

struct GainConfig {
  std::optional<DifferenceSteps> smoothing = DifferenceSteps{}.scaled(6.0);  ///< none: not smoothed
  double residual = 1600.0;  ///< weights in place of the plan's own
  double change = 1600.0;
  int block = 32;  ///< frames that are linearised at once
};

/// K_t [controls][kMemory] of every control of a roll-out.
/// @param curvature  where not null: Q_uu of every control, [controls][controls], what a wrong one costs
/// @return none where it was told to stop
List<Eigen::MatrixXf> feedback_gains(const System& system, const Cost& cost, const Trajectory& motion,
                                     const GainConfig& config, const PlanControl& control,
                                     List<Eigen::MatrixXf>* curvature = nullptr);

/// Pushes of the pelvis, horizontal, in random directions.
struct PushTest {
  double speed = 0.1;  ///< change of the pelvis' velocity by one push, m/s
  int every = 30;      ///< frames from push to push; the first in the middle of that
  int trials = 16;
  double lost = 0.5;  ///< distance of a body at which a trial has failed, m
  std::uint64_t seed = 1;
};
struct PushResult {
  int followed = 0;        ///< trials that stayed within `lost` to the end
  double frames_kept = 0;  ///< mean of the frames before that
};

/// Follows a roll-out under the gains while it is pushed; without gains (empty) open loop.
PushResult test_pushes(const System& system, const Cost& cost, const Trajectory& motion,
                       const List<Eigen::MatrixXf>& gains, const PushTest& test);

}  // namespace mimicx::control
