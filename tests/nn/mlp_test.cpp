/// Networks in the learner: losses, the gradient penalty, evaluation in roll-outs.
#include "nn/mlp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nn/finite_differences.h"

namespace mimicx::nn {
namespace {

Inputs copies(Mlp<double>& mlp) {
  Inputs result;
  for (const auto* p : parameters(mlp)) result.push_back(*p);
  return result;
}

Mlp<double> small_network() {
  Random random(21);
  auto mlp = make_mlp<double>({4, 6, 5, 3}, 0.7, random);
  for (auto& bias : mlp.biases) bias = 0.3 * random_matrix(1, bias.cols(), random);
  return mlp;
}

/// Clipped surrogate of PPO: min(r·A, clip(r, 0.8, 1.2)·A), r = exp(log π − log π_old).
TEST(Mlp, SurrogateLossGradientMatchesFiniteDifferences) {
  auto mlp = small_network();
  Random random(22);
  const auto states = random_matrix(7, 4, random), actions = random_matrix(7, 3, random);
  const auto advantages = random_matrix(7, 1, random);
  const Matrix<double> old_logs = -2.5 + 0.4 * random_matrix(7, 1, random).array();
  const Scalar loss = [&](Tape<double>& t, std::span<const Var> p) {
    const Var error = sub(t, t.constant(actions), forward(t, mlp, p, t.constant(states)));
    const Var logs = scale(t, row_sum(t, square(t, error)), -0.5);
    const Var ratio = exp(t, sub(t, logs, t.constant(old_logs)));
    const Var advantage = t.constant(advantages);
    return mean(t,
                minimum(t, multiply(t, ratio, advantage), multiply(t, clamp(t, ratio, 0.8, 1.2), advantage)));
  };
  expect_gradient_matches_differences(loss, copies(mlp));
}

/// log π(a|s) up to its constant, summed over the samples, for a Gaussian of fixed deviations σ.
Var log_probability(Tape<double>& t, const Mlp<double>& mlp, std::span<const Var> p, Var states,
                    const Matrix<double>& actions, const Matrix<double>& deviations) {
  const Var error = sub(t, t.constant(actions), forward(t, mlp, p, states));
  const Var scaled = multiply(t, error, t.constant(deviations.cwiseInverse().replicate(actions.rows(), 1)));
  return scale(t, sum(t, square(t, scaled)), -0.5);
}

/// Σ_samples ‖∇_s log π(a|s)‖².
Var penalty(Tape<double>& t, const Mlp<double>& mlp, std::span<const Var> p, const Matrix<double>& states,
            const Matrix<double>& actions, const Matrix<double>& deviations) {
  const std::array wrt = {t.constant(states)};
  const Var log = log_probability(t, mlp, p, wrt[0], actions, deviations);
  return sum(t, square(t, gradient<double>(t, log, wrt)[0]));
}

TEST(Mlp, PenaltyGradientMatchesFiniteDifferences) {
  auto mlp = small_network();
  Random random(23);
  const auto states = random_matrix(5, 4, random), actions = random_matrix(5, 3, random);
  const Matrix<double> deviations = (Matrix<double>(1, 3) << 0.5, 0.9, 1.4).finished();
  expect_gradient_matches_differences(
      [&](Tape<double>& t, std::span<const Var> p) {
        return penalty(t, mlp, p, states, actions, deviations);
      },
      copies(mlp));
}

/// E‖∇_s log π(a|s)‖² = Σ_i ‖∇_s μ_i‖²/σ_i².  docs/method.md §7. The left side is quadratic in ε = (a − μ)/σ,
/// so the three points ε = √3·e_i, whose mean of εεᵀ is the unit matrix, give its expectation exactly; the
/// Jacobian of the right side is taken by finite differences.
TEST(Mlp, ExpectedPenaltyEqualsJacobianNormOverVariance) {
  const auto mlp = small_network();
  Random random(24);
  const auto states = random_matrix(6, 4, random);
  const Matrix<double> deviations = (Matrix<double>(1, 3) << 0.2, 0.7, 1.3).finished();
  Workspace<double> workspace;
  Matrix<double> means, above, below;
  evaluate(mlp, states, workspace, means);

  double expected = 0;
  constexpr double kStep = 1e-5;
  for (int j = 0; j < 4; ++j) {
    Matrix<double> moved = states;
    moved.col(j).array() += kStep;
    evaluate(mlp, moved, workspace, above);
    moved.col(j).array() -= 2 * kStep;
    evaluate(mlp, moved, workspace, below);
    const Matrix<double> column = (above - below) / (2 * kStep);
    expected += (column.array().rowwise() / deviations.row(0).array()).square().sum();
  }

  double average = 0;
  for (int i = 0; i < 3; ++i) {
    Matrix<double> actions = means;
    actions.col(i).array() += std::sqrt(3.0) * deviations(0, i);
    Tape<double> tape;
    const auto p = parameters_on_tape(tape, mlp);
    average += tape.scalar(penalty(tape, mlp, p, states, actions, deviations)) / 3;
  }
  EXPECT_NEAR(average, expected, 1e-7 * expected);
}

TEST(Mlp, EvaluateEqualsForwardBitForBit) {
  Random random(25);
  const auto mlp = make_mlp<float>({37, 32, 16, 5}, 1.0f, random);
  for (const int rows : {1, 3, 64}) {
    const Matrix<float> x = random_matrix(rows, 37, random).cast<float>();
    Tape<float> tape;
    const auto p = parameters_on_tape(tape, mlp);
    const Var y = forward(tape, mlp, p, tape.refer(x));
    Workspace<float> workspace;
    Matrix<float> output;
    evaluate(mlp, x, workspace, output);
    EXPECT_EQ(output, tape.value(y));
  }
}

TEST(Mlp, ARowOfTheOutputIgnoresTheContentOfOtherRows) {
  Random random(26);
  const auto mlp = make_mlp<float>({37, 32, 5}, 1.0f, random);
  const Matrix<float> x = random_matrix(19, 37, random).cast<float>();
  Workspace<float> workspace;
  Matrix<float> together, disturbed;
  evaluate(mlp, x, workspace, together);
  for (int row = 0; row < 19; ++row) {
    Matrix<float> others = Matrix<float>::Constant(19, 37, std::numeric_limits<float>::quiet_NaN());
    others.row(row) = x.row(row);
    evaluate(mlp, others, workspace, disturbed);
    EXPECT_EQ(disturbed.row(row), together.row(row)) << row;
  }
}

TEST(Mlp, EvaluateKeepsItsBuffers) {
  Random random(27);
  const auto mlp = make_mlp<float>({8, 16, 16, 12, 2}, 1.0f, random);
  const Matrix<float> x = random_matrix(10, 8, random).cast<float>();
  Workspace<float> workspace;
  Matrix<float> output;
  evaluate(mlp, x, workspace, output);
  const auto addresses = [&] {
    std::vector<const float*> result = {output.data()};
    for (const auto& layer : workspace.hidden) result.push_back(layer.data());
    return result;
  };
  const auto before = addresses();
  evaluate(mlp, x, workspace, output);
  EXPECT_EQ(before.size(), 4u);
  EXPECT_EQ(before, addresses());
}

TEST(Mlp, InitialWeightsHaveTheStatedDeviations) {
  Random random(28);
  const auto mlp = make_mlp<double>({400, 300, 200}, 0.01, random);
  const auto deviation = [](const Matrix<double>& w) {
    return std::sqrt(w.squaredNorm() / double(w.size()));
  };
  // The relative error of a deviation from n normal numbers is 1/√(2n): five times that here.
  EXPECT_NEAR(deviation(mlp.weights[0]) / std::sqrt(1.0 / 400), 1.0, 5 / std::sqrt(2.0 * 400 * 300));
  EXPECT_NEAR(deviation(mlp.weights[1]) / (0.01 / std::sqrt(300)), 1.0, 5 / std::sqrt(2.0 * 300 * 200));
  EXPECT_TRUE(mlp.biases[0].isZero(0));
}

TEST(Mlp, RejectsImpossibleSizes) {
  Random random(29);
  EXPECT_THROW(make_mlp<float>({3}, 1.0f, random), std::invalid_argument);
  EXPECT_THROW(make_mlp<float>({3, 0, 2}, 1.0f, random), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::nn
