#include "nn/normaliser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"

namespace mimicx::nn {
namespace {

/// Features of very different mean and deviation; the last one is constant.
Matrix<float> samples(int rows, std::uint64_t seed) {
  Random random(seed);
  Matrix<float> x(rows, 4);
  for (int i = 0; i < rows; ++i)
    x.row(i) << static_cast<float>(random.normal()), static_cast<float>(1000 + 0.5 * random.normal()),
        static_cast<float>(1e-3 * random.normal()), 7.0f;
  return x;
}

TEST(Moments, MergedChunksEqualTheWhole) {
  const auto x = samples(1000, 1);
  const std::vector<int> cuts = {0, 1, 1, 17, 400, 999, 1000};  // one chunk is empty
  Moments merged = make_moments(4);
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    merge(merged, moments_of(Matrix<float>(x.middleRows(cuts[k], cuts[k + 1] - cuts[k]))));
  EXPECT_EQ(merged.count, 1000);
  for (int j = 0; j < 4; ++j) {
    double mean = 0, squares = 0;
    for (int i = 0; i < 1000; ++i) mean += double(x(i, j)) / 1000;
    for (int i = 0; i < 1000; ++i) squares += (double(x(i, j)) - mean) * (double(x(i, j)) - mean);
    EXPECT_NEAR(merged.mean(j), mean, 1e-12 * (1 + std::abs(mean)));
    EXPECT_NEAR(merged.squares(j), squares, 1e-9 * squares + 1e-18);
  }
}

TEST(Normaliser, OutputsHaveZeroMeanAndUnitDeviation) {
  const auto x = samples(5000, 2);
  auto normaliser = make_normaliser<float>(4);
  const std::vector<Moments> batches = {moments_of(x)};
  update<float>(normaliser, batches);
  Matrix<float> y;
  normalise(normaliser, x, y);
  const Moments after = moments_of(y);
  for (const int j : {0, 1}) {
    EXPECT_NEAR(after.mean(j), 0.0, 1e-4);
    EXPECT_NEAR(after.squares(j) / after.count, 1.0, 1e-4);
  }
  // A variance of 1e-6 plus the floor of 1e-6: the normalised variance is one half.
  EXPECT_NEAR(after.squares(2) / after.count, 0.5, 0.02);
  EXPECT_TRUE(y.col(3).isZero(0));
}

TEST(Normaliser, ClipsAndDenormaliseInvertsItInsideTheLimit) {
  const auto x = samples(500, 3);
  auto normaliser = make_normaliser<float>(4, 2.0f);
  const std::vector<Moments> batches = {moments_of(x)};
  update<float>(normaliser, batches);
  Matrix<float> y, back;
  normalise(normaliser, x, y);
  denormalise(normaliser, y, back);
  EXPECT_EQ(y.cwiseAbs().maxCoeff(), 2.0f);
  for (int i = 0; i < 500; ++i)
    for (int j = 0; j < 4; ++j) {
      if (std::abs(y(i, j)) == 2.0f) continue;
      EXPECT_NEAR(back(i, j), x(i, j), 1e-6 * (1 + std::abs(x(i, j))));
    }
}

TEST(Normaliser, ConstantFeatureIsIgnoredAlsoWithAnotherValue) {
  auto normaliser = make_normaliser<float>(4);
  for (const std::uint64_t seed : {6, 7, 8}) {
    const std::vector<Moments> batches = {moments_of(samples(777, seed))};
    update<float>(normaliser, batches);
  }
  Matrix<float> x = samples(1, 9), y, back;
  x(0, 3) = -2.0f;
  normalise(normaliser, x, y);
  EXPECT_EQ(y(0, 3), 0.0f);
  denormalise(normaliser, y, back);
  EXPECT_EQ(back(0, 3), 7.0f);
  // It counts again as soon as it varies.
  const std::vector<Moments> more = {moments_of(x)};
  update<float>(normaliser, more);
  normalise(normaliser, x, y);
  EXPECT_LT(y(0, 3), -1.0f);
}

TEST(Normaliser, SmallestVariationOfAFloatIsNotConstant) {
  Matrix<float> x = Matrix<float>::Constant(100000, 1, 0.3f);
  x(50, 0) = std::nextafter(0.3f, 1.0f);
  auto normaliser = make_normaliser<float>(1);
  const std::vector<Moments> batches = {moments_of(x)};
  update<float>(normaliser, batches);
  EXPECT_GT(normaliser.factor(0, 0), 900.0f);
}

TEST(Normaliser, OfDisturbedSamplesHasADeviationForEveryFeature) {
  EXPECT_FLOAT_EQ(normaliser_of(samples(100, 10)).factor(0, 3), 1e3f);
}

TEST(Normaliser, IsTheIdentityWithoutSamples) {
  const auto normaliser = make_normaliser<double>(2);
  const Matrix<double> x = (Matrix<double>(1, 2) << 3.5, -12.0).finished();
  Matrix<double> y;
  normalise(normaliser, x, y);
  EXPECT_EQ(y, (Matrix<double>(1, 2) << 3.5, -10.0).finished());
}

TEST(Normaliser, OneUpdateWithTwoBatchesEqualsTwoUpdatesBitForBit) {
  const std::vector<Moments> batches = {moments_of(samples(100, 4)), moments_of(samples(50, 5))};
  auto once = make_normaliser<float>(4), twice = make_normaliser<float>(4);
  update<float>(once, batches);
  for (const Moments& batch : batches) update<float>(twice, std::span(&batch, 1));
  EXPECT_EQ(once.moments.mean, twice.moments.mean);
  EXPECT_EQ(once.moments.squares, twice.moments.squares);
  EXPECT_EQ(once.factor, twice.factor);
}

}  // namespace
}  // namespace mimicx::nn
