#include "pipeline/training_loop.h"

#include <gtest/gtest.h>

namespace mimicx::pipeline {
namespace {

TEST(Stall, CountsFollowingRollOutsWithoutImprovement) {
  EXPECT_EQ(stall_age(3, 0.020, 0.020), 4);
  EXPECT_EQ(stall_age(3, 0.025, 0.020), 4);
  EXPECT_EQ(stall_age(3, 0.015, 0.020), 0) << "markedly better";
  EXPECT_EQ(stall_age(3, 0.700, 0.020), 0) << "it falls again: an earlier roll-out was lucky";
  EXPECT_EQ(stall_age(3, 0.700, 0.900), 0) << "not followed yet";
}

}  // namespace
}  // namespace mimicx::pipeline
