#include "core/quantile.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"

namespace mimicx {
namespace {

TEST(Quantile, HasItsRankAmongTheSortedValues) {
  Random random(1, {1});
  for (int size = 1; size < 40; ++size) {
    std::vector<double> values;
    for (int i = 0; i < size; ++i) values.push_back(random.below(4) == 0 ? 0.5 : random.normal());
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for (int rank = 0; rank < size; ++rank)
      EXPECT_EQ(ranked(values, rank), sorted[static_cast<std::size_t>(rank)]) << rank << " of " << size;
    EXPECT_EQ(quantile(values, 0.0), sorted.front());
    EXPECT_EQ(quantile(values, 1.0), sorted.back());
    EXPECT_EQ(median(values), sorted[sorted.size() / 2]);
  }
}

TEST(Quantile, RoundsTheRankDown) {
  const std::vector<double> values = {30, 10, 0, 20, 40};
  EXPECT_EQ(quantile(values, 0.24), 0);
  EXPECT_EQ(quantile(values, 0.25), 10);
  EXPECT_EQ(quantile(values, 0.74), 20);
  EXPECT_EQ(quantile(values, 0.75), 30);
  EXPECT_EQ(quantile({1, 2}, 0.5), 1);
  EXPECT_EQ(median({1, 2}), 2) << "of two middle values the larger";
}

}  // namespace
}  // namespace mimicx
