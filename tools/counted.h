/// A scalar for the simulator's passes that counts its floating-point operations: +, −, ·, / and sqrt are
/// one, fma is two; comparisons, selections, minima and signs are none. The count is of one thread.
#pragma once

#include "physics/spatial.h"

namespace mimicx::tools {

/// Of comparisons; a type of its own, because clang refuses bitwise operators between calls that return bool.
struct CountedMask {
  bool set = false;
  friend CountedMask operator&(CountedMask a, CountedMask b) { return {a.set && b.set}; }
  friend CountedMask operator|(CountedMask a, CountedMask b) { return {a.set || b.set}; }
  friend CountedMask operator!(CountedMask a) { return {!a.set}; }
};
inline bool any(CountedMask mask) { return mask.set; }

struct Counted {
  double x = 0;
  static inline long operations = 0;

  Counted() = default;
  explicit Counted(double value) : x(value) {}

  friend Counted operator+(Counted a, Counted b) { return of(a.x + b.x, 1); }
  friend Counted operator-(Counted a, Counted b) { return of(a.x - b.x, 1); }
  friend Counted operator*(Counted a, Counted b) { return of(a.x * b.x, 1); }
  friend Counted operator/(Counted a, Counted b) { return of(a.x / b.x, 1); }
  friend Counted operator-(Counted a) { return Counted(-a.x); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  friend CountedMask operator<(Counted a, Counted b) { return {a.x < b.x}; }
  friend CountedMask operator>(Counted a, Counted b) { return {a.x > b.x}; }
  friend CountedMask operator<=(Counted a, Counted b) { return {a.x <= b.x}; }

  static Counted of(double value, int count) {
    operations += count;
    return Counted(value);
  }
};

inline Counted fma(Counted a, Counted b, Counted c) { return Counted::of(std::fma(a.x, b.x, c.x), 2); }
inline Counted sqrt(Counted a) { return Counted::of(std::sqrt(a.x), 1); }
inline Counted select(CountedMask mask, Counted a, Counted b) { return mask.set ? a : b; }
inline Counted max(Counted a, Counted b) { return a.x > b.x ? a : b; }
inline Counted min(Counted a, Counted b) { return a.x < b.x ? a : b; }
/// The packs' polynomial of degree 11 in 2w − 1.
inline Counted log_scale(Counted w) { return Counted::of(physics::log_scale(w.x), 2 * 12); }

}  // namespace mimicx::tools

template <>
struct mimicx::physics::ScalarTraits<mimicx::tools::Counted> {
  using Real = double;
  using Mask = tools::CountedMask;
  static constexpr int kSize = 1;
  static double get(tools::Counted a, int) { return a.x; }
  static void set(tools::Counted& a, int, double x) { a.x = x; }
  static bool lane(tools::CountedMask mask, int) { return mask.set; }
};
