#include "nn/adam.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mimicx::nn {
namespace {

/// Kingma & Ba, Algorithm 1, for one number, as printed.
struct ScalarAdam {
  double m = 0, v = 0;
  int t = 0;
  double step(double theta, double g, double alpha) {
    ++t;
    m = 0.9 * m + 0.1 * g;
    v = 0.999 * v + 0.001 * g * g;
    const double m_hat = m / (1 - std::pow(0.9, t)), v_hat = v / (1 - std::pow(0.999, t));
    return theta - alpha * m_hat / (std::sqrt(v_hat) + 1e-8);
  }
};

TEST(Adam, FollowsTheScalarAlgorithmWithAChangingStepSize) {
  Matrix<double> weight(2, 3), bias(1, 2);
  weight << 1, -2, 3, 0.5, 0, -0.25;
  bias << 4, -1;
  const std::vector<Matrix<double>*> parameters = {&weight, &bias};
  auto adam = make_adam<double>(parameters);
  std::vector<double> theta = {1, -2, 3, 0.5, 0, -0.25, 4, -1};
  std::vector<ScalarAdam> reference(theta.size());
  for (int step = 0; step < 20; ++step) {
    const double alpha = 0.01 / (1 + step);
    std::vector<Matrix<double>> gradients = {weight.array().sin() + step, bias.array().square() - 3.0};
    for (std::size_t i = 0; i < theta.size(); ++i) {
      const double g = i < 6 ? std::sin(theta[i]) + step : theta[i] * theta[i] - 3.0;
      theta[i] = reference[i].step(theta[i], g, alpha);
    }
    adam_step<double>(adam, parameters, gradients, alpha);
  }
  EXPECT_EQ(adam.steps, 20);
  for (std::size_t i = 0; i < theta.size(); ++i)
    EXPECT_NEAR(i < 6 ? weight.data()[i] : bias.data()[i - 6], theta[i], 1e-13);
}

// Roots by an approximate instruction and a Newton step differ between makers of processors.
TEST(Adam, EveryRootIsTheCorrectlyRoundedOne) {
  const Eigen::Index n = 1003;
  Matrix<float> x = Matrix<float>::Zero(1, n);
  const std::vector<Matrix<float>*> parameters = {&x};
  auto adam = make_adam<float>(parameters);
  std::vector<Matrix<float>> gradients = {Matrix<float>(1, n)};
  for (Eigen::Index i = 0; i < n; ++i)
    gradients[0](i) = std::ldexp(1.0f + 0.00083f * float(i), int(i % 19) - 9);
  adam_step<float>(adam, parameters, gradients, 1.0f);
  for (Eigen::Index i = 0; i < n; ++i) {
    const float g = gradients[0](i), beta1 = 0.9f, beta2 = 0.999f;
    const float m = (1.0f - beta1) * g * float(1.0 / (1.0 - double{beta1}));
    const float square = (1.0f - beta2) * (g * g) * float(1.0 / (1.0 - double{beta2}));
    const float root = static_cast<float>(std::sqrt(static_cast<double>(square)));  // rounds correctly
    ASSERT_EQ(x(i), 0.0f - m / (root + 1e-8f)) << i;
  }
}

TEST(Adam, MinimisesAnIllConditionedConvexFunction) {
  Matrix<double> x = Matrix<double>::Constant(1, 3, 2.0);
  const Eigen::Array<double, 1, 3> curvature(1.0, 100.0, 0.01), optimum(0.5, -1.0, 1.5);
  const std::vector<Matrix<double>*> parameters = {&x};
  auto adam = make_adam<double>(parameters);
  for (int step = 0; step < 4000; ++step) {
    const std::vector<Matrix<double>> gradients = {(curvature * (x.array() - optimum)).matrix()};
    adam_step<double>(adam, parameters, gradients, 0.05 / (1 + 0.01 * step));
  }
  EXPECT_LT((x.array() - optimum).abs().maxCoeff(), 1e-4);
}

TEST(Adam, RejectsGradientsOfAnotherShape) {
  Matrix<float> x = Matrix<float>::Zero(2, 2);
  const std::vector<Matrix<float>*> parameters = {&x};
  auto adam = make_adam<float>(parameters);
  const std::vector<Matrix<float>> transposed = {Matrix<float>::Zero(1, 4)}, none;
  EXPECT_THROW(adam_step<float>(adam, parameters, transposed, 0.1f), std::invalid_argument);
  EXPECT_THROW(adam_step<float>(adam, parameters, none, 0.1f), std::invalid_argument);
}

TEST(GradientNorm, IsEuclideanOverAllParametersAndClipsOnlyAbove) {
  std::vector<Matrix<float>> gradients = {Matrix<float>::Constant(1, 1, 3.0f),
                                          Matrix<float>::Constant(2, 2, 2.0f)};
  EXPECT_DOUBLE_EQ(clip_gradient_norm<float>(gradients, 6.0), 5.0);
  EXPECT_EQ(gradients[0](0, 0), 3.0f);
  EXPECT_DOUBLE_EQ(clip_gradient_norm<float>(gradients, 2.5), 5.0);
  EXPECT_EQ(gradients[0](0, 0), 1.5f);
  EXPECT_EQ(gradients[1], Matrix<float>::Constant(2, 2, 1.0f));
}

}  // namespace
}  // namespace mimicx::nn
