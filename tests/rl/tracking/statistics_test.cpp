#include "rl/tracking/statistics.h"

#include <gtest/gtest.h>

namespace mimicx::rl::tracking {
namespace {

TEST(StartWeights, AreProbabilitiesAndFavourBinsBeforeFalls) {
  const List<double> even = start_weights({0, 0, 0, 0}, {10, 10, 10, 10}, 0.4);
  for (double w : even) EXPECT_DOUBLE_EQ(w, 0.25);
  const List<double> weights = start_weights({0, 0, 0, 0.1, 0, 0}, {10, 10, 10, 10, 10, 10}, 0.4);
  double total = 0.0;
  for (double w : weights) total += w;
  EXPECT_NEAR(total, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(weights[0], 0.4 / 6.0);
  EXPECT_DOUBLE_EQ(weights[5], 0.4 / 6.0);
  EXPECT_GT(weights[3], weights[2]);
  EXPECT_GT(weights[2], weights[1]);
  EXPECT_GT(weights[1], weights[0]);
}

TEST(StartWeights, OfABinGrowWithItsFramesAndAreZeroWithoutAny) {
  const List<int> frames = {10, 10, 5, 0};
  const List<double> even = start_weights({0, 0, 0, 0}, frames, 0.4);
  for (int b = 0; b < 4; ++b) EXPECT_DOUBLE_EQ(even[b], frames[b] / 25.0) << b;
  const List<double> weights = start_weights({0, 0, 0, 1.0}, frames, 0.4);
  EXPECT_DOUBLE_EQ(weights[0] + weights[1] + weights[2], 1.0);
  EXPECT_EQ(weights[3], 0.0) << "falls at the end count for the bins before";
  EXPECT_GT(weights[2], weights[1]);
}

}  // namespace
}  // namespace mimicx::rl::tracking
