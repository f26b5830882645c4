#include "rl/ppo_loss.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nn/gradient.h"

namespace mimicx::rl {
namespace {

using nn::Matrix;
using nn::Tape;
using nn::Var;
using M = nn::Matrix<double>;

M normal_matrix(Eigen::Index rows, Eigen::Index cols, Random& random) {
  M m(rows, cols);
  for (Eigen::Index k = 0; k < m.size(); ++k) m.data()[k] = random.normal();
  return m;
}

nn::Mlp<double> small_actor(Random& random) { return nn::make_mlp<double>({5, 12, 3}, 1.0, random); }

TEST(PpoLoss, SurrogateIsTheClippedRatioTimesTheAdvantage) {
  // Rows: ratio inside, above and below the clip range, with an advantage of either sign.
  const double ratios[] = {1.1, 1.5, 0.5, 1.1, 1.5, 0.5}, advantages[] = {2, 2, 2, -2, -2, -2};
  const double gains[] = {2.2, 2.4, 1.0, -2.2, -3.0, -1.6};
  const double slopes[] = {2.2, 0.0, 1.0, -2.2, -3.0, 0.0};  // d gain / d log ratio
  for (int k = 0; k < 6; ++k) {
    nn::Tape<double> tape;
    const nn::Var density = tape.constant(1, 1, std::log(ratios[k]));
    const nn::Var old = tape.constant(1, 1, 0.0), advantage = tape.constant(1, 1, advantages[k]);
    const nn::Var loss = surrogate_loss(tape, density, old, advantage, 0.2);
    EXPECT_NEAR(tape.scalar(loss), -gains[k], 1e-12);
    const nn::Var wrt[] = {density};
    EXPECT_NEAR(tape.scalar(nn::gradient(tape, loss, wrt).front()), -slopes[k], 1e-12);
  }
}

TEST(PpoLoss, RatioOfAnyTwoDensitiesStaysFinite) {
  nn::Tape<float> tape;
  const nn::Var density = tape.constant(1, 1, 5000.0F), old = tape.constant(1, 1, -5000.0F);
  const nn::Var loss = surrogate_loss(tape, density, old, tape.constant(1, 1, -1.0F), 0.2F);
  const nn::Var wrt[] = {density};
  EXPECT_TRUE(std::isfinite(tape.scalar(loss)));
  EXPECT_TRUE(std::isfinite(tape.scalar(nn::gradient(tape, loss, wrt).front())));
}

TEST(PpoLoss, FirstGradientIsThePolicyGradient) {
  // At the old policy the ratio is 1, and the gradient with respect to a mean is −A·(a − μ)/σ².
  Random random(1);
  const M means = normal_matrix(7, 3, random), actions = normal_matrix(7, 3, random);
  const M advantages = normal_matrix(7, 1, random);
  const double sigma = 0.4;
  nn::Tape<double> tape;
  const nn::Var mean = tape.constant(means);
  const nn::Var density = log_density(tape, mean, tape.constant(actions), sigma);
  const M old = tape.value(density);
  const nn::Var wrt[] = {mean};
  const nn::Var loss = surrogate_loss(tape, density, tape.constant(old), tape.constant(advantages), 0.2);
  const M gradient = tape.value(nn::gradient(tape, loss, wrt).front());
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(old(i), -(actions.row(i) - means.row(i)).squaredNorm() / (2 * sigma * sigma), 1e-12);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(gradient(i, k), -advantages(i) * (actions(i, k) - means(i, k)) / (sigma * sigma), 1e-12);
  }
}

TEST(PpoLoss, ValueLossIsHalfTheSumOfSquares) {
  nn::Tape<double> tape;
  M targets(2, 1), values(2, 1);
  values << 1, 2;
  targets << 4, 0;
  EXPECT_DOUBLE_EQ(tape.scalar(value_loss(tape, tape.constant(values), tape.constant(targets))), 6.5);
}

/// Σ_i ‖∇μ_i‖² of one observation by central differences of the network's outputs.
double jacobian_norm(const nn::Mlp<double>& actor, const M& observation) {
  const double h = 1e-5;
  nn::Workspace<double> workspace;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < observation.cols(); ++k) {
    M up = observation, down = observation, above, below;
    up(k) += h;
    down(k) -= h;
    nn::evaluate(actor, up, workspace, above);
    nn::evaluate(actor, down, workspace, below);
    sum += ((above - below) / (2.0 * h)).squaredNorm();
  }
  return sum;
}

double penalty(const nn::Mlp<double>& actor, const M& observations, const M& actions, double sigma) {
  nn::Tape<double> tape;
  const auto parameters = nn::parameters_on_tape(tape, actor);
  const nn::Var value = gradient_penalty<double>(tape, actor, parameters, tape.constant(observations),
                                                 tape.constant(actions), sigma);
  return tape.scalar(value);
}

TEST(GradientPenalty, ExpectationIsTheJacobianOfTheMeanForEverySigma) {
  Random random(2);
  const nn::Mlp<double> actor = small_actor(random);
  const M observation = normal_matrix(1, 5, random);
  const double expected = jacobian_norm(actor, observation);
  const int n = 40000;
  const M observations = observation.replicate(n, 1);
  nn::Workspace<double> workspace;
  M means;
  nn::evaluate(actor, observations, workspace, means);
  for (const double sigma : {0.04, 1.0}) {
    const M actions = means + sigma * normal_matrix(n, 3, random);
    // ‖J(a − μ)/σ‖² has a relative deviation of at most √2; five standard errors.
    EXPECT_NEAR(penalty(actor, observations, actions, sigma) / n / expected, 1.0, 5.0 * std::sqrt(2.0 / n));
  }
}

TEST(GradientPenalty, ItsGradientMatchesFiniteDifferences) {
  Random random(3);
  nn::Mlp<double> actor = small_actor(random);
  const M observations = normal_matrix(6, 5, random), actions = normal_matrix(6, 3, random);
  const double sigma = 0.5, h = 1e-5;
  nn::Tape<double> tape;
  const auto vars = nn::parameters_on_tape(tape, actor);
  const nn::Var value =
      gradient_penalty<double>(tape, actor, vars, tape.constant(observations), tape.constant(actions), sigma);
  const auto gradient = nn::gradient(tape, value, vars);
  std::vector<M> analytic;
  for (const nn::Var v : gradient) analytic.push_back(tape.value(v));
  const auto parameters = nn::parameters(actor);
  for (std::size_t p = 0; p < parameters.size(); ++p)
    for (Eigen::Index k = 0; k < parameters[p]->size(); ++k) {
      double& x = parameters[p]->data()[k];
      const double kept = x;
      x = kept + h;
      const double above = penalty(actor, observations, actions, sigma);
      x = kept - h;
      const double below = penalty(actor, observations, actions, sigma);
      x = kept;
      const double numeric = (above - below) / (2.0 * h);
      EXPECT_NEAR(analytic[p].data()[k], numeric, 1e-6 * (1.0 + std::abs(numeric)));
    }
}

}  // namespace
}  // namespace mimicx::rl
