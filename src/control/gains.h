/// Feedback gains around a finished plan: corrections of the controls for deviations of the state.
///
///     u = ū_t + K_t (z − z̄_t),      z = (state, previous residual)
///
/// The gains of planning itself are too stiff for contact. They use derivatives at the planned state, which
/// are wrong for a state a few millimetres away with other contacts. The gains here are softened in two ways:
/// their derivatives are smoothed over some centimetres and degrees (differences.h), and residuals have a
/// high weight. One sweep goes over the whole motion in blocks of frames, so that memory does not grow with
/// the length of the motion, apart from what it returns: 39 kB of gains per frame and, if asked for, 12 kB of
/// curvature.
#pragma once

#include "control/ilqr.h"
#include "control/plan_control.h"

namespace mimicx::control {

struct GainConfig {
  std::optional<DifferenceSteps> smoothing = DifferenceSteps{}.scaled(6.0);  ///< none: not smoothed
  double residual = 1600.0;  ///< weights that replace those of the plan
  double change = 1600.0;
  int block = 32;  ///< frames linearised at a time
};

/// K_t [controls][kMemory] of every control of a roll-out.
/// @param curvature  if not null, receives Q_uu [controls][controls] of every control: the cost of deviations
/// @return empty if `should_stop` returned true
List<Eigen::MatrixXf> feedback_gains(const System& system, const Cost& cost, const Trajectory& motion,
                                     const GainConfig& config, const PlanControl& control,
                                     List<Eigen::MatrixXf>* curvature = nullptr);

/// Horizontal pushes of the pelvis in random directions.
struct PushTest {
  double speed = 0.1;  ///< change of the pelvis' velocity by one push, m/s
  int every = 30;      ///< frames between pushes; the first after half of that
  int trials = 16;
  double failure_distance = 0.5;  ///< distance of a body beyond which a trial has failed, m
  std::uint64_t seed = 1;
};
struct PushResult {
  int followed = 0;        ///< trials that stayed within `failure_distance` to the end
  double frames_kept = 0;  ///< mean of the frames before that
};

/// Follows a roll-out under pushes with the given gains; open loop if `gains` is empty.
PushResult test_pushes(const System& system, const Cost& cost, const Trajectory& motion,
                       const List<Eigen::MatrixXf>& gains, const PushTest& test);

}  // namespace mimicx::control
