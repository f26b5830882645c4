#include "rl/gae.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace mimicx::rl {
namespace {

using nn::Matrix;

struct Arrays {
  nn::Matrix<float> rewards, values, last_values, final_values;
  FlagMatrix terminated, truncated;

  AdvantageInput input() const { return {rewards, values, last_values, terminated, truncated, final_values}; }
};

Arrays constant_arrays(int steps, int characters, float reward, float value) {
  return {nn::Matrix<float>::Constant(steps, characters, reward),
          nn::Matrix<float>::Constant(steps, characters, value),
          nn::Matrix<float>::Constant(1, characters, value),
          nn::Matrix<float>::Zero(steps, characters),
          FlagMatrix::Constant(steps, characters, false),
          FlagMatrix::Constant(steps, characters, false)};
}

Arrays random_arrays(int steps, int characters, std::uint64_t seed) {
  Random random(seed);
  Arrays a = constant_arrays(steps, characters, 0, 0);
  for (nn::Matrix<float>* m : {&a.rewards, &a.values, &a.last_values, &a.final_values})
    for (Eigen::Index k = 0; k < m->size(); ++k) m->data()[k] = static_cast<float>(random.normal());
  for (Eigen::Index k = 0; k < a.terminated.size(); ++k) {
    a.terminated.data()[k] = random.uniform() < 0.1;
    a.truncated.data()[k] = random.uniform() < 0.1;
  }
  return a;
}

nn::Matrix<float> advantages(const Arrays& a, double gamma, double lambda) {
  nn::Matrix<float> result(a.rewards.rows(), a.rewards.cols());
  estimate_advantages(a.input(), {gamma, lambda}, result);
  return result;
}

/// V of the state that follows step t of character i, straight from the definition.
double successor(const Arrays& a, Eigen::Index t, Eigen::Index i) {
  if (a.terminated(t, i)) return 0.0;
  if (a.truncated(t, i)) return a.final_values(t, i);
  return t + 1 < a.values.rows() ? a.values(t + 1, i) : a.last_values(0, i);
}

TEST(Gae, EqualsTheBruteForceSumOfDiscountedErrors) {
  const double gamma = 0.93, lambda = 0.8;
  const Arrays a = random_arrays(40, 25, 3);
  const nn::Matrix<float> result = advantages(a, gamma, lambda);
  for (Eigen::Index i = 0; i < 25; ++i)
    for (Eigen::Index t = 0; t < 40; ++t) {
      double expected = 0.0;
      for (Eigen::Index k = t; k < 40; ++k) {
        const double delta = a.rewards(k, i) + gamma * successor(a, k, i) - a.values(k, i);
        expected += std::pow(gamma * lambda, static_cast<double>(k - t)) * delta;
        if (a.terminated(k, i) || a.truncated(k, i)) break;
      }
      EXPECT_NEAR(result(t, i), expected, 1e-5);
    }
}

TEST(Gae, ConstantRewardWithoutValuesIsAGeometricSeries) {
  const double gamma = 0.97, lambda = 0.95, q = gamma * lambda;
  const nn::Matrix<float> result = advantages(constant_arrays(32, 1, 1.0F, 0.0F), gamma, lambda);
  for (int t = 0; t < 32; ++t) EXPECT_NEAR(result(t, 0), (1.0 - std::pow(q, 32 - t)) / (1.0 - q), 1e-5);
}

TEST(Gae, ExactValuesLeaveNoAdvantage) {
  const double gamma = 0.9;
  Arrays a = constant_arrays(20, 3, 1.0F, 10.0F);  // V = r/(1 − γ)
  a.truncated(7, 1) = true;
  a.final_values(7, 1) = 10.0F;
  EXPECT_LT(advantages(a, gamma, 0.95).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Gae, LambdaOneIsTheDiscountedReturnMinusTheValue) {
  const double gamma = 0.9;
  const Arrays a = random_arrays(30, 10, 5);
  const nn::Matrix<float> result = advantages(a, gamma, 1.0);
  for (Eigen::Index i = 0; i < 10; ++i) {
    double expected = -a.values(0, i), discount = 1.0;
    for (Eigen::Index t = 0; t < 30; ++t) {
      expected += discount * a.rewards(t, i);
      discount *= gamma;
      const bool last = t == 29 || a.terminated(t, i) || a.truncated(t, i);
      if (!last) continue;
      expected += discount * successor(a, t, i);
      break;
    }
    EXPECT_NEAR(result(0, i), expected, 1e-5);
  }
}

TEST(Gae, TruncationDiffersFromTerminationByTheDiscountedFinalValue) {
  const double gamma = 0.9, lambda = 0.8;
  Arrays ended = random_arrays(10, 1, 7);
  ended.terminated.setConstant(false);
  ended.truncated.setConstant(false);
  Arrays cut = ended;
  ended.terminated(6, 0) = true;
  cut.truncated(6, 0) = true;
  const nn::Matrix<float> difference = advantages(cut, gamma, lambda) - advantages(ended, gamma, lambda);
  for (int t = 0; t <= 6; ++t)
    EXPECT_NEAR(difference(t, 0), std::pow(gamma * lambda, 6 - t) * gamma * cut.final_values(6, 0), 1e-5);
  for (int t = 7; t < 10; ++t) EXPECT_EQ(difference(t, 0), 0.0F);
}

TEST(Gae, TerminationWinsWhereBothFlagsAreSet) {
  Arrays both = random_arrays(8, 2, 9);
  both.terminated.setConstant(false);
  both.truncated.setConstant(false);
  both.terminated(3, 0) = true;
  Arrays once = both;
  both.truncated(3, 0) = true;
  EXPECT_TRUE(advantages(both, 0.9, 0.9) == advantages(once, 0.9, 0.9));
}

}  // namespace
}  // namespace mimicx::rl
