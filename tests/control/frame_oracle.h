/// The oracles of the analytic derivatives: a control frame as the simulator itself runs it, over double for
/// differences and over Dual for derivatives by the chain rule.
#pragma once

#include "control/analytic.h"
#include "oracles/dual.h"
#include "physics/step_in_parts.h"
#include "physics/test_states.h"

namespace mimicx::control {

/// One control frame moved by h along column `column` of its derivative (its start, residuals or push), by
/// the parts of the simulator's step.
/// @tparam T  double: h is a number; Dual: Dual(0, 1) gives the derivative along the column
template <class T>
State<T> simulate_frame(const Model<double>& model, const ControlFrame& frame, int column, T h);

/// a ⊖ b ∈ R¹²².
Eigen::VectorXd state_difference(const State<double>& a, const State<double>& b);

/// [122][238] by the chain rule.
Eigen::MatrixXd exact_derivative(const Model<double>& model, const ControlFrame& frame);
/// [122][238] by central differences (f(h) − f(−h)) / 2h.
/// @param h  for rotations (rad) and positions (m); velocities and residuals move ten times as far
Eigen::MatrixXd central_differences(const Model<double>& model, const ControlFrame& frame, double h);

}  // namespace mimicx::control
