#include "rl/tracking/statistics.h"

#include <gtest/gtest.h>

namespace mimicx::rl::tracking {
namespace {

TEST(StartWeights, AreProbabilitiesAndFavourBinsBeforeFalls) {
  const List<double> even = start_weights({0, 0, 0, 0}, 0.4);
  for (double w : even) EXPECT_DOUBLE_EQ(w, 0.25);
  const List<double> weights = start_weights({0, 0, 0, 0.1, 0, 0}, 0.4);
  double total = 0.0;
  for (double w : weights) total += w;
  EXPECT_NEAR(total, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(weights[0], 0.4 / 6.0);
  EXPECT_DOUBLE_EQ(weights[5], 0.4 / 6.0);
  EXPECT_GT(weights[3], weights[2]);
  EXPECT_GT(weights[2], weights[1]);
  EXPECT_GT(weights[1], weights[0]);
}

}  // namespace
}  // namespace mimicx::rl::tracking
