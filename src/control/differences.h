/// Smoothed derivatives of a control frame, with perturbed characters in the lanes of packs.
///
///     x_{t+1} ⊖ x̄_{t+1} ≈ F (x_t ⊖ x̄_t, u_{t−1} − ū_{t−1}, u_t − ū_t, assistance)
///
/// F has 122 rows and 122 + 55 + 55 columns, and 6 more for the assistive forces of an assisted system.
///
/// All coordinates move at once, along ± the rows of a Hadamard matrix; F is the least-squares fit, which for
/// orthogonal rows is a product. It averages F over a neighbourhood in which contacts open and close, which
/// the derivative at a point cannot show; the step sizes set the width of the smoothing. Random signs per
/// column (a fixed stream per frame) decorrelate the coordinates; terms even in the perturbation cancel
/// between + and −.
/// Sources: antithetic pairs as in Salimans et al., "Evolution Strategies" (2017), §2.1; why smoothing:
/// Suh et al., "Do Differentiable Simulators Give Better Policy Gradients?" (2022); the fit and its
/// steps: docs/control.md §4, (6).
#pragma once

#include "control/system.h"
#include "control/tangent.h"

namespace mimicx::control {

inline constexpr int kMemory = kTangent + kDofs;  ///< entries of z = (x, previous residual)

/// Step sizes of each kind of coordinate.
struct DifferenceSteps {
  double position = 1.5e-3;      ///< m
  double rotation = 3e-3;        ///< rad
  double velocity = 1.5e-2;      ///< m/s
  double spin = 3e-2;            ///< rad/s
  double residual = 1.5e-2;      ///< rad
  double assistance = 0.45;      ///< m/s²
  double assistance_spin = 1.5;  ///< rad/s²

  /// Of column `k` of F.
  double of(int k) const;
  DifferenceSteps scaled(double factor) const;
};

/// The point at which a frame is linearised.
struct FramePoint {
  int frame;        ///< t
  State<double> x;  ///< x_t
  Control before;   ///< u_{t−1}; of frame 0: zero
  Control u;        ///< u_t
};

/// F [122 × kMemory + system.controls()]: columns of x, of the previous residuals, of the controls.
using FrameMatrix = Eigen::Matrix<float, kTangent, Eigen::Dynamic, Eigen::RowMajor>;

/// @return F; the ends of frames that go wrong in the simulator count as zero
FrameMatrix linearise_smoothed(const System& system, const FramePoint& point, const DifferenceSteps& steps);

}  // namespace mimicx::control
