#include "nn/gemm.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "nn/finite_differences.h"

namespace mimicx::nn {
namespace {

// This program links the networks only: the fixed blocking must not depend on other linked code.
TEST(Gemm, BlockingDoesNotDependOnTheProcessorsCaches) {
  EXPECT_EQ(Eigen::l1CacheSize(), 32 * 1024);
  EXPECT_EQ(Eigen::l2CacheSize(), 512 * 1024);
  EXPECT_EQ(Eigen::l3CacheSize(), 8 * 1024 * 1024);
}

TEST(Gemm, EqualsTheSumOfProductsForEveryTransposition) {
  Random random(5);
  const Matrix<double> a = random_matrix(7, 5, random), b = random_matrix(5, 9, random);
  const Matrix<double> bias = random_matrix(1, 9, random);
  for (const bool transpose_a : {false, true})
    for (const bool transpose_b : {false, true}) {
      const Matrix<double> left = transpose_a ? Matrix<double>(a.transpose()) : a;
      const Matrix<double> right = transpose_b ? Matrix<double>(b.transpose()) : b;
      Matrix<double> result(7, 9);
      gemm<double>(transpose_a, transpose_b, left, right, bias.data(), result);
      for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 9; ++j) {
          double sum = bias(0, j);
          for (int k = 0; k < 5; ++k) sum += a(i, k) * b(k, j);
          EXPECT_NEAR(result(i, j), sum, 1e-12) << transpose_a << transpose_b;
        }
    }
}

}  // namespace
}  // namespace mimicx::nn
