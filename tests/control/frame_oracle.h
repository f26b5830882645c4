/// Oracles of the analytic derivatives: the simulator's own control frame, over Dual for derivatives by the
/// chain rule and over double for differences.
#pragma once

#include "control/analytic/analytic.h"

namespace mimicx::control {

/// [122][238] by the chain rule through the simulator's own sources.
Eigen::MatrixXd exact_derivative(const Model<double>& model, const ControlFrame& frame);

/// [122][238] by central differences of fourth order, (8 (f(h) − f(−h)) − (f(2h) − f(−2h))) / 12h.
/// @param h  for positions (m) and rotations (rad); velocities and residuals move ten times as far
Eigen::MatrixXd central_differences(const Model<double>& model, const ControlFrame& frame, double h);

/// The state at the end of a frame whose start, residuals or assistance is moved by h along column `column`.
State<double> simulate_frame(const Model<double>& model, const ControlFrame& frame, int column, double h);

}  // namespace mimicx::control
