/// Dual numbers, a third scalar of the simulator for tests. Over Dual, the headers of src/physics compute
/// their derivative by the chain rule, in one direction, exact to rounding, and on the side of every switch
/// that the value takes.
///     Dual(x, d): x + d ε with ε² = 0.          A. Griewank, A. Walther, "Evaluating Derivatives" (2008),
///     ch. 3
#pragma once

#include "physics/pack.h"
#include "physics/spatial.h"

namespace mimicx::test {

struct Dual {
  double x, d;

  Dual() = default;
  Dual(double value, double derivative = 0.0) : x(value), d(derivative) {}

  friend Dual operator+(Dual a, Dual b) { return {a.x + b.x, a.d + b.d}; }
  friend Dual operator-(Dual a, Dual b) { return {a.x - b.x, a.d - b.d}; }
  friend Dual operator*(Dual a, Dual b) { return {a.x * b.x, a.d * b.x + a.x * b.d}; }
  friend Dual operator/(Dual a, Dual b) { return {a.x / b.x, (a.d - a.x / b.x * b.d) / b.x}; }
  friend Dual operator-(Dual a) { return {-a.x, -a.d}; }
  Dual& operator+=(Dual b) { return *this = *this + b; }
  Dual& operator-=(Dual b) { return *this = *this - b; }
  Dual& operator*=(Dual b) { return *this = *this * b; }
  friend bool operator<(Dual a, Dual b) { return a.x < b.x; }
  friend bool operator>(Dual a, Dual b) { return a.x > b.x; }
  friend bool operator<=(Dual a, Dual b) { return a.x <= b.x; }
};

inline Dual fma(Dual a, Dual b, Dual c) { return a * b + c; }
inline Dual sqrt(Dual a) {
  const double root = std::sqrt(a.x);
  return {root, a.d == 0.0 ? 0.0 : 0.5 * a.d / root};
}
inline Dual select(bool mask, Dual a, Dual b) { return mask ? a : b; }
inline Dual max(Dual a, Dual b) { return a.x > b.x ? a : b; }
inline Dual min(Dual a, Dual b) { return a.x < b.x ? a : b; }

/// L(w) = 2 acos(w) / √(1 − w²) has the derivative (w L − 2) / (1 − w²), a series near w = 1.
inline Dual log_scale(Dual w) {
  const double L = physics::log_scale(w.x), s = 1.0 - w.x * w.x;
  const double slope =
      s < 1e-4 ? -2.0 * w.x * (1.0 / 3.0 + s * (0.3 + s * 15.0 / 56.0)) : (w.x * L - 2.0) / s;
  return {L, slope * w.d};
}

/// exp(r) = (c, s r) with c = cos(θ/2), s = sin(θ/2)/θ; by x = θ²: dc/dx = −s/4, ds/dx = (c/2 − s)/2x.
inline physics::Quat<Dual> exp_map(const physics::Vec3<Dual>& r) {
  const Dual square = physics::dot(r, r);
  const double x = square.x, angle = std::sqrt(x);
  const double c = std::cos(0.5 * angle), s = x < 1e-6 ? 0.5 - x / 48.0 : std::sin(0.5 * angle) / angle;
  const Dual scale(
      s, (x < 1e-4 ? -1.0 / 48.0 + x / 1920.0 - x * x / 215040.0 : (0.5 * c - s) / (2.0 * x)) * square.d);
  return {Dual(c, -0.25 * s * square.d), scale * r.x, scale * r.y, scale * r.z};
}

}  // namespace mimicx::test

template <>
struct mimicx::physics::ScalarTraits<mimicx::test::Dual> {
  using Real = double;
  using Mask = bool;
  static constexpr int kSize = 1;
  static double get(test::Dual a, int) { return a.x; }
  static void set(test::Dual& a, int, double x) { a = x; }
  static bool lane(bool mask, int) { return mask; }
};
