/// Our own elementary functions: the same bits on every machine.
///
/// The standard library's sin, exp, pow … differ by a unit in the last place between libraries and between
/// processors. These are made of +, −, ·, /, √ and operations on bits alone, all of which IEEE 754 defines to
/// the last bit, without fused operations. The whole project uses them instead of the standard library's
/// (`tools/check_layers` forbids those). `std::sqrt`, `std::abs`, `std::fmod`, `std::floor` and similar ones
/// are exact everywhere and stay in use.
///
/// Methods, all from the textbook (J.-M. Muller, "Elementary Functions", 3rd ed., 2016): reduction of the
/// argument by constants in several parts (Cody and Waite), for sines of more than 10⁶ by the digits of 2/π
/// (Payne and Hanek), Taylor series on the remaining short interval, and pairs of doubles (Dekker) where
/// one double is too coarse. `tools/elementary_constants` computes the constants.
///
/// Error against the exact value, in units in the last place, tested: log10 0.51, exp, log, sin and cos 1,
/// hypot and pow 1.3, atan2 and log1p 1.6, tan, asin and acos 2.3. Special values are those of the C standard
/// (annex F); the payload of a NaN is unspecified.
#pragma once

namespace mimicx {

constexpr double square(double x) { return x * x; }

/// e^x: 0 below −745.2, infinite above 709.8.
double exp(double x);
/// Natural logarithm: −infinity at 0, NaN below.
double log(double x);
/// Decimal logarithm: exact for the powers of ten that a double holds exactly.
double log10(double x);
/// log(1 + x), accurate near 0.
double log1p(double x);
/// x^y.
double pow(double x, double y);
/// xⁿ by repeated squaring: exact if all intermediate powers are, such as powers of ten up to the 22nd;
/// otherwise within |n| units.
double pow(double x, int n);

/// Angles in rad, of any size.
double sin(double x);
double cos(double x);
double tan(double x);
struct SinCos {
  double sin, cos;
};
/// Both, at little more than the cost of one.
SinCos sin_cos(double x);

/// In [−π/2, π/2]; NaN outside [−1, 1].
double asin(double x);
/// In [0, π]; NaN outside [−1, 1].
double acos(double x);
/// Angle of (x, y) from the x axis, in [−π, π].
double atan2(double y, double x);
/// √(x² + y²) without intermediate overflow.
double hypot(double x, double y);

}  // namespace mimicx
