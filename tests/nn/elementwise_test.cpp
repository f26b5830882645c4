/// Accuracy of our exp against long double, and bits that do not depend on the place in an array.
#include "nn/elementwise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace mimicx::nn {
namespace {

template <class S>
class Elementwise : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Elementwise, Scalars);

/// Largest error over [low, high] in units in the last place of the exact value.
template <class S, class F, class G>
double worst_error(S low, S high, F ours, G exact) {
  constexpr int kPoints = 200000;
  double worst = 0;
  for (int i = 0; i <= kPoints; ++i) {
    const S x = low + (high - low) * S(i) / S(kPoints);
    const long double truth = exact(static_cast<long double>(x));
    const S nearest = std::abs(static_cast<S>(truth));
    const S unit = std::nextafter(nearest, std::numeric_limits<S>::infinity()) - nearest;
    worst = std::max(worst, double(std::abs(static_cast<long double>(ours(x)) - truth) / unit));
  }
  return worst;
}

TYPED_TEST(Elementwise, ErrorsStayWithinTheDocumentedBounds) {
  using S = TypeParam;
  const auto exp_ours = [](S x) { return exp_value(x); };
  const auto expm1_ours = [](S x) { return expm1_value(x); };
  const auto exp_exact = [](long double x) { return std::exp(x); };
  const auto expm1_exact = [](long double x) { return std::expm1(x); };
  const S limit = ActivationLimits<S>::kExp;
  for (const S range : {S(1e-3), S(1), S(10), limit}) {
    EXPECT_LT(worst_error(-range, range, exp_ours, exp_exact), 2.0) << range;
    EXPECT_LT(worst_error(-range, range, expm1_ours, expm1_exact), 3.0) << range;
  }
}

TYPED_TEST(Elementwise, ExtremesSaturateAndNanStaysNan) {
  using S = TypeParam;
  const S infinity = std::numeric_limits<S>::infinity(), nan = std::numeric_limits<S>::quiet_NaN();
  EXPECT_EQ(exp_value(infinity), exp_value(ActivationLimits<S>::kExp));
  EXPECT_TRUE(std::isfinite(exp_value(infinity)));
  EXPECT_GT(exp_value(-infinity), S(0));
  EXPECT_EQ(exp_value(S(0)), S(1));
  EXPECT_EQ(elu_value(-infinity), S(-1));
  EXPECT_EQ(elu_value(S(3.25)), S(3.25));
  for (const S value : {exp_value(nan), elu_value(nan)}) EXPECT_TRUE(std::isnan(value));
}

TYPED_TEST(Elementwise, BitsDoNotDependOnThePlaceInTheArray) {
  using S = TypeParam;
  Random random(11);
  constexpr int kLength = 67;  // not a multiple of any vector width
  Matrix<S> x(1, kLength), y(1, kLength), slope(1, kLength);
  const Matrix<S> ones = Matrix<S>::Ones(1, kLength);
  for (int i = 0; i < kLength; ++i) x(0, i) = static_cast<S>(3 * random.normal());
  apply_elu(x, y);
  multiply_by_elu_slope(ones, y, slope);
  for (int i = 0; i < kLength; ++i) {
    const Matrix<S> alone = x.col(i);
    Matrix<S> alone_y(1, 1), alone_slope(1, 1);
    apply_elu(alone, alone_y);
    multiply_by_elu_slope(Matrix<S>(Matrix<S>::Ones(1, 1)), alone_y, alone_slope);
    EXPECT_EQ(alone_y(0, 0), y(0, i));
    EXPECT_EQ(alone_slope(0, 0), slope(0, i));
  }
}

TYPED_TEST(Elementwise, SumsOfEveryLengthAreExactForSmallIntegers) {
  using S = TypeParam;
  Matrix<S> x(1, 100);
  for (int n = 0; n <= 100; ++n) {
    for (int i = 0; i < n; ++i) x(0, i) = S(i + 1);
    EXPECT_EQ(ordered_sum(x.data(), n), S(n * (n + 1) / 2));
  }
}

}  // namespace
}  // namespace mimicx::nn
