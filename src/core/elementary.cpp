#include "core/elementary.h"

#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/bits.h"
#include "core/exponential.h"

namespace mimicx {

namespace {

static_assert(FLT_EVAL_METHOD == 0 && std::numeric_limits<double>::is_iec559,
              "doubles must be rounded to doubles by every operation");

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;

/// high + low, |low| ≤ half a unit of high in the last place.
struct Pair {
  double high, low;
};

/// a + b exactly. Source: D. Knuth, "The Art of Computer Programming", vol. 2, §4.2.2, theorem B.
Pair two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a·b exactly, for |a|, |b| < 2⁹⁹⁵ and a product of more than 2⁻⁹⁶⁰. Source: T. J. Dekker, "A floating-point
/// technique for extending the available precision" (1971): both are split into halves of 26 bits.
Pair two_product(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2²⁷ + 1
  const double a_wide = kSplit * a, a_high = a_wide - (a_wide - a), a_low = a - a_high;
  const double b_wide = kSplit * b, b_high = b_wide - (b_wide - b), b_low = b - b_high;
  const double product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

/// The products of pairs, to about 2⁻¹⁰⁰.
Pair product(Pair a, Pair b) {
  const Pair p = two_product(a.high, b.high);
  return two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
Pair sum(Pair a, Pair b) {
  const Pair s = two_sum(a.high, b.high);
  return two_sum(s.high, s.low + (a.low + b.low));
}

/// Σ coefficients[k]·xᵏ.
template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
  double sum = coefficients[N - 1];
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * x + coefficients[k];
  return sum;
}

constexpr Pair kPi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Pair kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

// --- exponentials and logarithms

/// e^(x + low), x not NaN. |low| ≤ 2⁻⁴⁰.
double exp_of_sum(double x, double low) {
  if (x > 710.0) return kInfinity;
  if (x < -746.0) return 0.0;
  const auto [n, fraction] = reduced_exp(x);
  // 2ⁿ in two factors, since it need not be a normal number.
  const double first = power_of_two<double>(n / 2), second = power_of_two<double>(n - n / 2);
  return (1.0 + (fraction + low * (1.0 + fraction))) * first * second;
}

/// x = 2ᵏ·m with m in [√½, √2); x positive and finite.
struct Split {
  int k;
  double m;
};
Split split(double x) {
  int k = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1.0p+54;
    k = -54;
  }
  const std::uint64_t bits = mimicx::bit_cast<std::uint64_t>(x);
  k += static_cast<int>(bits >> 52) - 1023;
  double m = mimicx::bit_cast<double>((bits & kMantissa) | mimicx::bit_cast<std::uint64_t>(1.0));
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++k;
  }
  return {k, m};
}

constexpr double kLn2High = 0x1.62e42p-1;  ///< 20 bits, exact when multiplied by k
constexpr double kLn2Low = 0x1.fdf473de6af28p-22;

/// 2/(2j + first) for j = 0 …: with s = f/(2 + f), log(1 + f) = 2 artanh s = 2s + s³ (2/3 + s² 2/5 + …).
template <std::size_t N>
constexpr std::array<double, N> artanh_series(int first) {
  std::array<double, N> result{};
  for (std::size_t j = 0; j < N; ++j) result[j] = 2.0 / static_cast<double>(2 * static_cast<int>(j) + first);
  return result;
}

/// log x to about 2⁻⁶³; x positive and finite.
Pair log_pair(double x) {
  const auto [k, m] = split(x);
  const double f = m - 1.0;
  const Pair denominator = two_sum(m, 1.0);
  Pair s{f / denominator.high, 0.0};
  const Pair back = two_product(s.high, denominator.high);
  s.low = (((f - back.high) - back.low) - s.high * denominator.low) / denominator.high;
  const Pair square = product(s, s);
  const Pair cubic = product(product(s, square), {0x1.5555555555555p-1, 0x1.5555555555555p-55});  // 2/3
  static constexpr auto kSeries = artanh_series<10>(5);
  const double rest = s.high * square.high * square.high * polynomial(kSeries, square.high);
  const Pair of_m = sum({2.0 * s.high, 2.0 * s.low}, {cubic.high, cubic.low + rest});
  const double n = k;
  return sum(two_sum(n * kLn2High, n * kLn2Low), of_m);
}

}  // namespace

double exp(double x) { return std::isnan(x) ? x : exp_of_sum(x, 0.0); }

double log(double x) {
  if (std::isnan(x) || x == kInfinity) return x;
  if (x <= 0.0) return x == 0.0 ? -kInfinity : kNaN;
  const auto [k, m] = split(x);
  const double f = m - 1.0, s = f / (2.0 + f), square = s * s;
  static constexpr auto kSeries = artanh_series<10>(3);
  // 2s = f − s·f keeps the large part exact.
  const double rest = s * (f - square * polynomial(kSeries, square)), n = k;
  return n * kLn2High + (f + (n * kLn2Low - rest));
}

double log10(double x) {
  if (std::isnan(x) || x == kInfinity) return x;
  if (x <= 0.0) return x == 0.0 ? -kInfinity : kNaN;
  return product(log_pair(x), {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57}).high;  // 1/ln 10
}

double log1p(double x) {
  const double whole = 1.0 + x;
  if (whole == 1.0 || !(whole > 0.0) || whole == kInfinity) return whole == 1.0 ? x : log(whole);
  return log(whole) + (x - (whole - 1.0)) / whole;  // the second term is what 1 + x lost
}

double pow(double x, int n) {
  double result = 1.0;
  for (unsigned left = n < 0 ? 0u - static_cast<unsigned>(n) : static_cast<unsigned>(n); left > 0;
       left >>= 1) {
    if (left & 1) result *= x;
    if (left > 1) x *= x;
  }
  return n < 0 ? 1.0 / result : result;
}

double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return kNaN;
  const double size = std::abs(x);
  const bool whole = std::floor(y) == y, odd = whole && std::abs(std::fmod(y, 2.0)) == 1.0;
  if (std::isinf(y)) return size == 1.0 ? 1.0 : (size > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  const double sign = odd ? std::copysign(1.0, x) : 1.0;
  if (size == 0.0 || size == kInfinity) return sign * ((size == 0.0) == (y > 0.0) ? 0.0 : kInfinity);
  if (x < 0.0 && !whole) return kNaN;
  const Pair logarithm = log_pair(size);
  const double estimate = y * logarithm.high;
  if (std::abs(estimate) > 800.0) return sign * (estimate > 0.0 ? kInfinity : 0.0);
  const Pair exponent = two_product(y, logarithm.high);
  return sign * exp_of_sum(exponent.high, exponent.low + y * logarithm.low);
}

// --- angles

namespace {

/// An angle is quadrant·π/2 + rest, |rest| ≤ π/4 (a little more by rounding).
struct Reduced {
  int quadrant;  ///< modulo 4
  Pair rest;
};

/// For |x| ≤ 10⁶. Three parts of π/2 have 33 bits each, so that their multiples are exact.
Reduced reduce_small(double x) {
  constexpr double kRound = ExpConstants<double>::kRound;
  const double n = (x * 0x1.45f306dc9c883p-1 + kRound) - kRound;  // 2/π
  const double first = x - n * 0x1.921fb544p+0;
  const Pair second = two_sum(first, -(n * 0x1.0b4611a6p-34));
  const Pair third = two_sum(second.high, -(n * 0x1.3198a2ep-69));
  const double low = second.low + (third.low - n * 0x1.b839a252049c1p-104);
  return {static_cast<int>(n) & 3, two_sum(third.high, low)};
}

/// 32-bit digits of 2/π = Σ digit[j]·2^(−32(j+1)).
constexpr std::array<std::uint32_t, 38> kTwoOverPi = {
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561,
    0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
    0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
    0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b,
    0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab};

/// For finite x ≥ 10⁶: x·2/π modulo 4 in integers. With x = m·2ᵉ, digits of 2/π are skipped whose product
/// with 2ᵉ is a multiple of 4, and those that contribute less than 2⁻¹⁶⁹. No double is closer than 2⁻⁶² to a
/// multiple of π/2.
Reduced reduce_large(double x) {
  const std::uint64_t bits = mimicx::bit_cast<std::uint64_t>(x), m = (bits & kMantissa) | (kMantissa + 1);
  const int e = static_cast<int>(bits >> 52) - 1075, skipped = e < 34 ? 0 : (e - 2) / 32;
  constexpr int kDigits = 8;
  std::array<std::uint32_t, kDigits + 2> digits{};  // of m · 8 digits of 2/π, lowest first
  for (std::size_t half = 0; half < 2; ++half) {
    const std::uint64_t factor = half == 0 ? m & 0xffffffff : m >> 32;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < kDigits; ++i) {
      carry += factor * kTwoOverPi[static_cast<std::size_t>(skipped + kDigits - 1) - i] + digits[i + half];
      digits[i + half] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    digits[kDigits + half] = static_cast<std::uint32_t>(carry);
  }
  const int point = 32 * (skipped + kDigits) - e;  // the bit of value 1
  const auto from = [&](int bit) {                 // 32 bits
    const auto at = static_cast<std::size_t>(bit / 32);
    const std::uint64_t next = at + 1 < digits.size() ? digits[at + 1] : 0;
    return static_cast<std::uint32_t>(((next << 32) | digits[at]) >> (bit % 32));
  };
  int quadrant = static_cast<int>(from(point) & 3);
  const bool upper = (from(point - 32) >> 31) != 0;  // the fraction is at least a half
  if (upper) {
    ++quadrant;
    std::uint64_t carry = 1;
    for (std::uint32_t& digit : digits) {  // the negative, so that the fraction becomes 1 − fraction
      carry += static_cast<std::uint32_t>(~digit);
      digit = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
  Pair fraction{0.0, 0.0};
  double unit = 1.0;
  for (int k = 1; k <= 6; ++k) {
    unit *= 0x1.0p-32;
    const Pair s = two_sum(fraction.high, static_cast<double>(from(point - 32 * k)) * unit);
    fraction = {s.high, fraction.low + s.low};
  }
  Pair rest = product(fraction, kHalfPi);
  if (upper) rest = {-rest.high, -rest.low};
  return {quadrant & 3, rest};
}

/// For finite x.
Reduced reduce(double x) {
  if (std::abs(x) <= 0.78) return {0, {x, 0.0}};
  if (std::abs(x) <= 1e6) return reduce_small(x);
  const Reduced r = reduce_large(std::abs(x));
  if (x > 0.0) return r;
  return {(4 - r.quadrant) & 3, {-r.rest.high, -r.rest.low}};
}

/// (−1)^(k+1)/(first + 2k)! for k = 0 …
template <std::size_t N>
constexpr std::array<double, N> sine_series(int first) {
  std::array<double, N> result{};
  double factorial = 1.0;
  for (int i = 2; i <= first; ++i) factorial *= i;
  for (std::size_t k = 0; k < N; ++k) {
    result[k] = (k % 2 == 0 ? -1.0 : 1.0) / factorial;
    const double n = first + 2.0 * static_cast<double>(k);
    factorial *= (n + 1.0) * (n + 2.0);
  }
  return result;
}

/// sin(high + low), by the series to the 17th power.
double sine(Pair r) {
  static constexpr auto kSeries = sine_series<8>(3);
  const double square = r.high * r.high;
  return r.high + (r.high * square * polynomial(kSeries, square) + r.low * (1.0 - 0.5 * square));
}

/// cos(high + low), by the series to the 18th power.
double cosine(Pair r) {
  static constexpr auto kSeries = sine_series<8>(4);
  const double square = r.high * r.high, half = 0.5 * square, near = 1.0 - half;
  return near + (((1.0 - near) - half) - (square * square * polynomial(kSeries, square) + r.high * r.low));
}

/// Whether sin x = tan x = x, including the sign of zero.
bool is_tiny(double x) { return std::abs(x) < 0x1.0p-27; }

}  // namespace

SinCos sin_cos(double x) {
  if (!std::isfinite(x)) return {kNaN, kNaN};
  const auto [quadrant, rest] = reduce(x);
  const double s = is_tiny(x) ? x : sine(rest), c = cosine(rest);
  switch (quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double sin(double x) {
  if (is_tiny(x)) return x;
  if (!std::isfinite(x)) return kNaN;
  const auto [quadrant, rest] = reduce(x);
  const double value = quadrant % 2 == 0 ? sine(rest) : cosine(rest);
  return quadrant < 2 ? value : -value;
}

double cos(double x) {
  if (!std::isfinite(x)) return kNaN;
  const auto [quadrant, rest] = reduce(x);
  const double value = quadrant % 2 == 0 ? cosine(rest) : sine(rest);
  return quadrant == 0 || quadrant == 3 ? value : -value;
}

double tan(double x) {
  if (is_tiny(x)) return x;
  const auto [s, c] = sin_cos(x);
  return s / c;
}

namespace {

/// arctan(k/8).
constexpr std::array<Pair, 9> kArcTangent = {{{0.0, 0.0},
                                              {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                              {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                              {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                              {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                              {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                              {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                              {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                              {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};

/// quarter + sign·arctan(a/b) for 0 ≤ a ≤ b, both finite, b > 0. With c = k/8 next to a/b,
/// arctan(a/b) = arctan c + arctan((a − c b)/(b + c a)), the last one by its series to the 17th power.
double turned(Pair quarter, double sign, double a, double b) {
  static constexpr std::array<double, 8> kSeries = {-1.0 / 3.0,  1.0 / 5.0,  -1.0 / 7.0,  1.0 / 9.0,
                                                    -1.0 / 11.0, 1.0 / 13.0, -1.0 / 15.0, 1.0 / 17.0};
  const double quotient = a / b;
  const int k = static_cast<int>(8.0 * quotient + 0.5);
  const double c = 0.125 * k, u = k == 0 ? quotient : (a - c * b) / (b + c * a);
  const double square = u * u, rest = u * square * polynomial(kSeries, square);
  const Pair whole = kArcTangent[static_cast<std::size_t>(k)];
  const Pair base = two_sum(quarter.high, sign * whole.high);
  const Pair near = two_sum(base.high, sign * u);
  return near.high + (near.low + (base.low + (quarter.low + sign * (whole.low + rest))));
}

}  // namespace

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNaN;
  double a = std::abs(y), b = std::abs(x);
  const bool steep = a > b;
  if (steep) std::swap(a, b);
  if (b == 0.0) b = 1.0;
  if (b == kInfinity) {
    a = a == kInfinity ? 1.0 : 0.0;
    b = 1.0;
  }
  if (b > 0x1.0p+1000) a *= 0x1.0p-60, b *= 0x1.0p-60;
  if (b < 0x1.0p-900) a *= 0x1.0p+120, b *= 0x1.0p+120;
  const bool left = std::signbit(x);
  const Pair quarter = steep ? kHalfPi : left ? kPi : Pair{0.0, 0.0};
  return std::copysign(turned(quarter, steep == left ? 1.0 : -1.0, a, b), y);
}

double asin(double x) { return atan2(x, std::sqrt((1.0 - x) * (1.0 + x))); }

double acos(double x) { return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x); }

double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return kInfinity;
  x = std::abs(x);
  y = std::abs(y);
  const double larger = x > y ? x : y;
  if (larger > 0x1.0p+500) return 0x1.0p+600 * hypot(0x1.0p-600 * x, 0x1.0p-600 * y);
  if (larger < 0x1.0p-400 && larger > 0.0) return 0x1.0p-600 * hypot(0x1.0p+600 * x, 0x1.0p+600 * y);
  return std::sqrt(x * x + y * y);
}

}  // namespace mimicx
