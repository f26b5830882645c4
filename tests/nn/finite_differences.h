/// Independent oracle for gradients: central differences in double precision.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <span>
#include <vector>

#include "core/random.h"
#include "nn/gradient.h"
#include "nn/ops.h"

namespace mimicx::nn {

using Inputs = std::vector<Matrix<double>>;
/// Records a scalar of the inputs on the tape.
using Scalar = std::function<Var(Tape<double>&, std::span<const Var>)>;

inline Matrix<double> random_matrix(Eigen::Index rows, Eigen::Index cols, Random& random) {
  Matrix<double> m(rows, cols);
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = random.normal();
  return m;
}

inline std::vector<Var> place(Tape<double>& tape, const Inputs& inputs) {
  std::vector<Var> vars;
  for (const auto& input : inputs) vars.push_back(tape.constant(input));
  return vars;
}

inline double value_of(const Scalar& f, const Inputs& inputs) {
  Tape<double> tape;
  const auto vars = place(tape, inputs);
  return tape.scalar(f(tape, vars));
}

/// dL/d(inputs) by the tape.
inline Inputs tape_gradient(const Scalar& f, const Inputs& inputs) {
  Tape<double> tape;
  const auto vars = place(tape, inputs);
  Inputs result;
  for (const Var g : gradient<double>(tape, f(tape, vars), vars)) result.push_back(tape.value(g));
  return result;
}

/// dL/d(inputs) by (f(x + h) − f(x − h)) / 2h: error about 1e-9 for values of order 1.
inline Inputs difference_gradient(const Scalar& f, const Inputs& inputs) {
  constexpr double kStep = 1e-5;
  Inputs moved = inputs, result = inputs;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    for (Eigen::Index i = 0; i < inputs[k].size(); ++i) {
      double& x = moved[k].data()[i];
      const double before = x;
      x = before + kStep;
      const double above = value_of(f, moved);
      x = before - kStep;
      const double below = value_of(f, moved);
      x = before;
      result[k].data()[i] = (above - below) / (2 * kStep);
    }
  return result;
}

inline void expect_gradient_matches_differences(const Scalar& f, const Inputs& inputs) {
  const Inputs ours = tape_gradient(f, inputs);
  const Inputs oracle = difference_gradient(f, inputs);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    ASSERT_EQ(ours[k].rows(), inputs[k].rows());
    ASSERT_EQ(ours[k].cols(), inputs[k].cols());
    const double scale = 1.0 + oracle[k].cwiseAbs().maxCoeff();
    EXPECT_LT((ours[k] - oracle[k]).cwiseAbs().maxCoeff(), 1e-7 * scale) << "input " << k;
  }
}

/// The scalar Σ_k Σ c_k ⊙ (∂f/∂x_k)² + c_k ⊙ ∂f/∂x_k: it depends on every entry of the gradient, with
/// different weights.
inline Scalar of_gradient(const Scalar& f) {
  return [f](Tape<double>& tape, std::span<const Var> x) {
    const auto gradients = gradient<double>(tape, f(tape, x), x);
    Random random(17);
    Var total = tape.constant(1, 1, 0.0);
    for (const Var g : gradients) {
      const Var weight = tape.constant(random_matrix(tape.value(g).rows(), tape.value(g).cols(), random));
      const Var mixed = add(tape, square(tape, g), g);
      total = add(tape, total, sum(tape, multiply(tape, weight, mixed)));
    }
    return total;
  };
}

/// Gradients of first, second and third order.
inline void expect_all_orders_match_differences(const Scalar& f, const Inputs& inputs) {
  Scalar derived = f;
  for (int order = 1; order <= 3; ++order) {
    SCOPED_TRACE("order " + std::to_string(order));
    expect_gradient_matches_differences(derived, inputs);
    derived = of_gradient(derived);
  }
}

}  // namespace mimicx::nn
