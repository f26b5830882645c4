#include "core/elementary.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "core/random.h"
#include "core/random_cases.h"

namespace mimicx {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();
constexpr double kMost = std::numeric_limits<double>::max();

/// Any double: all signs and exponents, including denormal, infinite and NaN.
double any_double(Random& random) {
  const std::uint64_t high = random.bits();
  return std::bit_cast<double>(high << 32 | random.bits());
}

/// |got − want| in units of want in the last place of a double.
double error_of(double got, long double want) {
  const auto rounded = static_cast<double>(want);
  if (std::isnan(want) || std::isnan(got)) return std::isnan(want) && std::isnan(got) ? 0.0 : kInfinity;
  if (std::isinf(rounded) || std::isinf(got)) return got == rounded ? 0.0 : kInfinity;
  int exponent;
  std::frexp(want, &exponent);
  const long double unit = std::ldexp(1.0L, std::max(exponent, -1021) - 53);
  return static_cast<double>(std::abs(got - want) / unit);
}

using Sampler = std::function<double(Random&)>;
Sampler between(double low, double high) {
  return [low, high](Random& random) { return random.uniform(low, high); };
}

/// The largest error of 300,000 arguments, or a tenth of them, against the long double of the standard
/// library.
double worst(double (*ours)(double), long double (*exact)(long double), const Sampler& sample) {
  if (std::numeric_limits<long double>::digits < 64) return 0.0;  // no more precise reference
  Random random(7, {});
  double worst = 0.0;
  for (int i = 0; i < test::random_cases(300'000); ++i) {
    const double x = sample(random);
    worst = std::max(worst, error_of(ours(x), exact(x)));
  }
  return worst;
}
double worst(double (*ours)(double, double), long double (*exact)(long double, long double),
             const Sampler& sample_x, const Sampler& sample_y) {
  if (std::numeric_limits<long double>::digits < 64) return 0.0;
  Random random(7, {});
  double worst = 0.0;
  for (int i = 0; i < test::random_cases(300'000); ++i) {
    const double x = sample_x(random), y = sample_y(random);
    worst = std::max(worst, error_of(ours(x, y), exact(x, y)));
  }
  return worst;
}

TEST(Elementary, ExponentialsAreWithinOneUnit) {
  EXPECT_LT(worst(exp, std::exp, between(-2.0, 2.0)), 1.0);
  EXPECT_LT(worst(exp, std::exp, between(-708.0, 709.7)), 1.0);
  EXPECT_LT(worst(exp, std::exp, between(-746.0, -708.0)), 1.0);  // denormal results
  EXPECT_LT(worst(exp, std::exp, any_double), 1.0);
}

TEST(Elementary, LogarithmsAreWithinTheirErrorBounds) {
  for (const Sampler& sample : {between(0.5, 2.0), between(0.99, 1.01), Sampler(any_double)}) {
    EXPECT_LT(worst(log, std::log, sample), 1.0);
    EXPECT_LT(worst(log10, std::log10, sample), 0.51);
  }
  EXPECT_LT(worst(log1p, std::log1p, between(-0.99, 2.0)), 1.6);
  EXPECT_LT(worst(log1p, std::log1p, between(-1e-8, 1e-8)), 1.6);
  EXPECT_LT(worst(log1p, std::log1p, any_double), 1.6);
}

TEST(Elementary, DecimalLogarithmsOfPowersOfTenAreExact) {
  for (int n = 0; n <= 22; ++n) EXPECT_EQ(log10(pow(10.0, n)), n);
}

TEST(Elementary, PowersAreWithinTheirErrorBound) {
  EXPECT_LT(worst(pow, std::pow, between(0.0, 1.0), between(0.0, 10.0)), 1.3);
  EXPECT_LT(worst(pow, std::pow, between(0.0, 10.0), between(-400.0, 400.0)), 1.3);
  EXPECT_LT(worst(pow, std::pow, between(0.5, 2.0), between(-1100.0, 1100.0)), 1.3);
  EXPECT_LT(worst(pow, std::pow, any_double, between(-2.0, 2.0)), 1.3);
  EXPECT_LT(worst(pow, std::pow, any_double, any_double), 1.3);
}

TEST(Elementary, IntegerPowersAreExactWhereTheirFactorsAre) {
  for (int n = 0; n <= 22; ++n) {
    const double power = std::stod("1e" + std::to_string(n));
    EXPECT_EQ(pow(10.0, n), power);
    EXPECT_EQ(pow(10.0, -n), 1.0 / power);
  }
  EXPECT_EQ(pow(-3.0, 3), -27.0);
  EXPECT_EQ(pow(0.0, 0), 1.0);
  EXPECT_EQ(pow(2.0, -1074), 0.0);  // 1/2¹⁰⁷⁴, whose divisor is infinite
  Random random(3, {});
  for (int i = 0; i < test::random_cases(100'000); ++i) {
    const double x = random.uniform(0.0, 10.0);
    for (int n : {-4, -3, -2, 2, 3, 4, 5})
      EXPECT_LE(error_of(pow(x, n), std::pow(static_cast<long double>(x), n)), std::abs(n));
  }
}

TEST(Elementary, TrigonometryIsWithinItsErrorBounds) {
  for (const Sampler& sample :
       {between(-10.0, 10.0), between(-1e6, 1e6), between(1e6, 1e12), Sampler(any_double)}) {
    EXPECT_LT(worst(sin, std::sin, sample), 1.0);
    EXPECT_LT(worst(cos, std::cos, sample), 1.0);
    EXPECT_LT(worst(tan, std::tan, sample), 2.3);
  }
  for (const Sampler& sample :
       {between(-1.0, 1.0), between(0.999, 1.0), between(-1e-3, 1e-3), Sampler(any_double)}) {
    EXPECT_LT(worst(asin, std::asin, sample), 2.3);
    EXPECT_LT(worst(acos, std::acos, sample), 2.3);
  }
  EXPECT_LT(worst(atan2, std::atan2, between(-1.0, 1.0), between(-1.0, 1.0)), 1.6);
  EXPECT_LT(worst(atan2, std::atan2, any_double, any_double), 1.6);
}

TEST(Elementary, SinesOfTheWorstArgumentsAreExact) {
  // The doubles closest to multiples of π/2, of all and below 10⁶: the reduction cancels most of their
  // digits.
  for (const double x : {6381956970095103.0 * 0x1p+797, 5.319372648326541e+255, 0x1.921fb54442d18p+0, 355.0,
                         710.0, 312689.0, 833719.0, 1e22}) {
    EXPECT_LT(error_of(sin(x), std::sin(static_cast<long double>(x))), 1.0) << x;
    EXPECT_LT(error_of(cos(x), std::cos(static_cast<long double>(x))), 1.0) << x;
    EXPECT_EQ(sin(-x), -sin(x));
    EXPECT_EQ(cos(-x), cos(x));
  }
}

TEST(Elementary, SinCosEqualsSinAndCos) {
  Random random(5, {});
  for (int i = 0; i < test::random_cases(100'000); ++i) {
    const double x = i % 2 ? random.uniform(-10.0, 10.0) : any_double(random);
    const auto [sine, cosine] = sin_cos(x);
    if (!std::isfinite(x)) continue;
    EXPECT_EQ(sine, sin(x));
    EXPECT_EQ(cosine, cos(x));
  }
}

TEST(Elementary, HypotenusesAreWithinTheirErrorBound) {
  EXPECT_LT(worst(hypot, std::hypot, between(-1.0, 1.0), between(-1.0, 1.0)), 1.3);
  EXPECT_LT(worst(hypot, std::hypot, any_double, any_double), 1.3);
  EXPECT_EQ(hypot(3.0 * 0x1p+1000, 4.0 * 0x1p+1000), 5.0 * 0x1p+1000);
  EXPECT_EQ(hypot(3.0 * kLeast, 4.0 * kLeast), 5.0 * kLeast);
}

/// Expects the same number, including the sign of zero, or both NaN.
void expect_same(double ours, double standard, double x, double y) {
  if (std::isnan(standard)) {
    EXPECT_TRUE(std::isnan(ours)) << x << " " << y << ": " << ours;
  } else {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(ours), std::bit_cast<std::uint64_t>(standard)) << x << " " << y;
  }
}

TEST(Elementary, SpecialValuesMatchTheStandardLibrary) {
  const double special[] = {0.0, 1.0, 2.0, 3.0, 0.5, kInfinity, kLeast, kMost, kNaN, 1e300};
  for (const double size : special)
    for (const double x : {size, -size}) {
      for (const double other : special)
        for (const double y : {other, -other}) {
          const bool has_small_result = std::abs(x) == 1e300 || std::abs(y) == 1e300 ||
                                        std::abs(x) == kMost || std::abs(y) == kMost ||
                                        std::abs(x) == kLeast || std::abs(y) == kLeast;
          if (!has_small_result) {
            EXPECT_LE(error_of(atan2(y, x), std::atan2(static_cast<long double>(y), x)), 1.6);
            EXPECT_EQ(std::signbit(atan2(y, x)),
                      std::isnan(x) || std::isnan(y) ? std::signbit(atan2(y, x)) : std::signbit(y));
          }
          if (x == 0.0 || std::isinf(x) || std::isnan(x) || y == 0.0 || std::isinf(y) || std::isnan(y))
            expect_same(pow(x, y), std::pow(x, y), x, y);
          expect_same(std::isinf(hypot(x, y)) ? kInfinity : 0.0,
                      std::isinf(std::hypot(x, y)) ? kInfinity : 0.0, x, y);
        }
      if (x == 0.0 || !std::isfinite(x)) {
        expect_same(exp(x), std::exp(x), x, 0);
        expect_same(log(x), std::log(x), x, 0);
        expect_same(log10(x), std::log10(x), x, 0);
        expect_same(log1p(x), std::log1p(x), x, 0);
        expect_same(sin(x), std::sin(x), x, 0);
        expect_same(cos(x), std::cos(x), x, 0);
        expect_same(tan(x), std::tan(x), x, 0);
        expect_same(asin(x), std::asin(x), x, 0);
      }
    }
  EXPECT_EQ(exp(1e4), kInfinity);
  EXPECT_EQ(exp(-1e4), 0.0);
  EXPECT_EQ(log(1.0), 0.0);
  EXPECT_EQ(log1p(-1.0), -kInfinity);
  EXPECT_TRUE(std::isnan(log(-1.0)) && std::isnan(log10(-1.0)) && std::isnan(log1p(-2.0)));
  EXPECT_TRUE(std::isnan(asin(1.5)) && std::isnan(acos(-1.5)) && std::isnan(pow(-8.0, 1.0 / 3.0)));
  EXPECT_EQ(acos(1.0), 0.0);
  EXPECT_EQ(cos(0.0), 1.0);
}

/// A hash of the bits of many results, the same on every machine.
TEST(Elementary, BitsAreTheSameOnEveryMachine) {
  Random random(11, {});
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](double value) {
    if (std::isnan(value)) value = 0.0;  // the payload of a NaN is unspecified
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
  };
  for (int i = 0; i < 100'000; ++i) {
    const double x = i % 2 ? random.uniform(-10.0, 10.0) : any_double(random), y = random.uniform(-3.0, 3.0);
    for (auto* f : {exp, log, log10, log1p, sin, cos, tan, asin, acos}) add(f(x));
    add(pow(x, y));
    add(pow(x, 5));
    add(atan2(x, y));
    add(hypot(x, y));
  }
  EXPECT_EQ(hash, 9411603314047526099u);
}

}  // namespace
}  // namespace mimicx
