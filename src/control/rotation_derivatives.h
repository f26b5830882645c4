/// Derivatives of the exponential and the logarithm of rotations.
///
/// For a small change ε of a rotation vector r,
///     exp(r + ε) = exp(r) exp(J_r ε),        log(exp(r) exp(ε)) = r + J_r⁻¹ ε,
///     log(exp(−ε) exp(r)) = r − J_r⁻ᵀ ε                           (to first order; J_r at r).
/// Source: J. Solà, J. Deray, D. Atchuthan, "A micro Lie theory for state estimation in robotics" (2018),
/// appendix on SO(3); the left Jacobian is the transpose of the right one.
#pragma once

#include <cmath>

#include "core/so3.h"

namespace mimicx::control {

/// [a]×, the matrix of b ↦ a × b.
inline Matrix3d skew(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// [a]× [b]× = b aᵀ − (a·b) 1, the matrix of c ↦ a × (b × c).
inline Matrix3d skew_product(const Vector3d& a, const Vector3d& b) {
  Matrix3d m = b * a.transpose();
  m.diagonal().array() -= a.dot(b);
  return m;
}

/// J_r = 1 − (1 − cos θ)/θ² [r]× + (θ − sin θ)/θ³ [r]×²,  θ = ‖r‖.
inline Matrix3d right_jacobian(const Vector3d& r) {
  const double square = r.squaredNorm(), angle = std::sqrt(square);
  // Series where the quotients lose digits; the next terms are under 1e-16 there.
  const bool small = square < 1e-6;
  const double a = small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
  const double b = small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
  return Matrix3d::Identity() - a * skew(r) + b * skew_product(r, r);
}

/// J_r⁻¹ = 1 + ½ [r]× + (1/θ² − cot(θ/2)/(2θ)) [r]×²,  θ = ‖r‖ ≤ π.
inline Matrix3d inverse_right_jacobian(const Vector3d& r) {
  const double square = r.squaredNorm(), angle = std::sqrt(square);
  const double b = square < 1e-4 ? 1.0 / 12.0 + square / 720.0 + square * square / 30240.0
                                 : 1.0 / square - 0.5 / (angle * std::tan(0.5 * angle));
  return Matrix3d::Identity() + 0.5 * skew(r) + b * skew_product(r, r);
}

}  // namespace mimicx::control
