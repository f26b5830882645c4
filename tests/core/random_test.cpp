#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mimicx {
namespace {

// Known answers published with Salmon et al. 2011 (Random123, file kat_vectors).
TEST(Philox, MatchesThePublishedVectors) {
  using Words = std::array<std::uint32_t, 4>;
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, SameSeedAndKeyRepeatOthersDiffer) {
  const auto first = [](std::uint64_t seed, std::initializer_list<std::uint64_t> key) {
    return Random(seed, key).bits();
  };
  EXPECT_EQ(first(5, {1, 2}), first(5, {1, 2}));
  std::vector<std::uint32_t> draws = {first(5, {1, 2}), first(6, {1, 2}), first(5, {2, 1}),   first(5, {1}),
                                      first(5, {}),     first(5, {0}),    first(5, {1, 2, 0})};
  std::sort(draws.begin(), draws.end());
  EXPECT_EQ(std::adjacent_find(draws.begin(), draws.end()), draws.end());
}

TEST(Random, SeekContinuesAStreamExactly) {
  Random a(3, {9});
  for (int n = 0; n < 37; ++n) a.normal();
  Random b(3, {9});
  b.seek(a.position());
  for (int n = 0; n < 20; ++n) EXPECT_EQ(a.normal(), b.normal());
}

/// Pearson's statistic against equal expectation.
double chi_square(const std::vector<int>& counts, double expected) {
  double sum = 0.0;
  for (const int c : counts) sum += (c - expected) * (c - expected) / expected;
  return sum;
}

// Bounds: mean 63 (or 6) plus five standard deviations, √(2·63) (or √12), which never occur by chance.
TEST(Random, UniformFillsItsBinsEvenly) {
  Random random(11, {1});
  std::vector<int> counts(64);
  for (int n = 0; n < 64000; ++n) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++counts[static_cast<std::size_t>(u * 64)];
  }
  EXPECT_NEAR(chi_square(counts, 1000.0), 63.0, 5 * std::sqrt(126.0));
}

TEST(Random, BelowIsUnbiased) {
  Random random(11, {2});
  std::vector<int> counts(7);
  for (int n = 0; n < 70000; ++n) ++counts[random.below(7)];
  EXPECT_LT(chi_square(counts, 10000.0), 6.0 + 5 * std::sqrt(12.0));
  // With n = 3·2^30 a plain remainder would draw the lowest third twice as often as the rest.
  int low = 0;
  for (int n = 0; n < 30000; ++n) low += random.below(3u << 30) < (1u << 30);
  EXPECT_NEAR(low, 10000, 5 * std::sqrt(30000 * 2.0 / 9.0));
}

TEST(Random, NormalHasTheNormalDistribution) {
  Random random(11, {3});
  constexpr int kDraws = 40000;
  std::vector<double> x(kDraws);
  for (double& v : x) v = random.normal();
  std::sort(x.begin(), x.end());
  double gap = 0.0;  // Kolmogorov-Smirnov
  for (int i = 0; i < kDraws; ++i) {
    const double cdf = 0.5 * std::erfc(-x[static_cast<std::size_t>(i)] / std::sqrt(2.0));
    gap = std::max({gap, std::abs(cdf - i / double{kDraws}), std::abs(cdf - (i + 1) / double{kDraws})});
  }
  EXPECT_LT(gap * std::sqrt(double{kDraws}), 1.95);  // exceeded by chance once in a thousand
}

TEST(Random, NeighbouringStreamsAreUncorrelated) {
  constexpr int kDraws = 20000;
  for (std::uint64_t key = 0; key < 5; ++key) {
    Random a(1, {key}), b(1, {key + 1});
    double sum = 0.0;
    for (int n = 0; n < kDraws; ++n) sum += a.normal() * b.normal();
    EXPECT_LT(std::abs(sum / std::sqrt(double{kDraws})), 5.0);
  }
}

}  // namespace
}  // namespace mimicx
