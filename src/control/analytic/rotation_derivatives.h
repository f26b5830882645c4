/// Derivatives of the exponential and the logarithm of rotations.
///
/// For a small change ε of a rotation vector r,
///     exp(r + ε) = exp(r) exp(J_r ε),        log(exp(r) exp(ε)) = r + J_r⁻¹ ε,
///     log(exp(−ε) exp(r)) = r − J_r⁻ᵀ ε                           (to first order; J_r at r).
/// Source: J. Solà, J. Deray, D. Atchuthan, "A micro Lie theory for state estimation in robotics" (2018),
/// appendix on SO(3); the left Jacobian is the transpose of the right one.
#pragma once

#include <cmath>

#include "core/elementary.h"
#include "core/so3.h"

namespace mimicx::control {

/// [a]×, the matrix of b ↦ a × b.
inline Matrix3d skew(const Vector3d& a) {
  Matrix3d m;
  m.col(0) = Vector3d(0.0, a.z(), -a.y());
  m.col(1) = Vector3d(-a.z(), 0.0, a.x());
  m.col(2) = Vector3d(a.y(), -a.x(), 0.0);
  return m;
}

/// [a]× [b]× = b aᵀ − (a·b) 1, the matrix of c ↦ a × (b × c).
inline Matrix3d skew_product(const Vector3d& a, const Vector3d& b) {
  Matrix3d m = b * a.transpose();
  m.diagonal().array() -= a.dot(b);
  return m;
}

/// a = (1 − cos θ)/θ² and b = (θ − sin θ)/θ³ of a rotation vector with θ² = `square`: by their series where
/// the quotients lose digits or a physics step makes them often; the terms left out are under 1e-17 there.
struct ExpCoefficients {
  double a, b;
};
inline ExpCoefficients exp_coefficients(double square) {
  if (square < 0.01) {
    const double x = square;
    return {0.5 - x / 24.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0))),
            1.0 / 6.0 - x / 120.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0 * (1.0 - x / 110.0)))};
  }
  const double angle = std::sqrt(square);
  const auto [sine, cosine] = sin_cos(angle);
  return {(1.0 - cosine) / square, (angle - sine) / (square * angle)};
}

/// exp(r) = 1 + (1 − θ² b) [r]× + a [r]×² and J_r = 1 − a [r]× + b [r]×².
struct ExpAndJacobian {
  Matrix3d rotation, jacobian;
};
inline ExpAndJacobian exp_and_jacobian(const Vector3d& r) {
  const double square = r.squaredNorm();
  const auto [a, b] = exp_coefficients(square);
  const Matrix3d cross = skew(r), cross_2 = skew_product(r, r);
  return {Matrix3d::Identity() + (1.0 - square * b) * cross + a * cross_2,
          Matrix3d::Identity() - a * cross + b * cross_2};
}
inline Matrix3d right_jacobian(const Vector3d& r) { return exp_and_jacobian(r).jacobian; }

/// J_r⁻¹ = 1 + ½ [r]× + (1/θ² − cot(θ/2)/(2θ)) [r]×²,  θ = ‖r‖ ≤ π.
inline Matrix3d inverse_right_jacobian(const Vector3d& r) {
  const double square = r.squaredNorm(), angle = std::sqrt(square);
  const double b = square < 1e-4 ? 1.0 / 12.0 + square / 720.0 + square * square / 30240.0
                                 : 1.0 / square - 0.5 / (angle * tan(0.5 * angle));
  return Matrix3d::Identity() + 0.5 * skew(r) + b * skew_product(r, r);
}

}  // namespace mimicx::control
