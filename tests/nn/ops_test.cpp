/// Every operation against finite differences up to third order, and properties of the tape.
#include "nn/ops.h"

#include <gtest/gtest.h>

#include "nn/finite_differences.h"

namespace mimicx::nn {
namespace {

/// A scalar, nonlinear function of an operation's result, with a different weight for every element.
Var weighted(Tape<double>& tape, Var y) {
  Random random(5);
  const Var weight = tape.constant(random_matrix(tape.value(y).rows(), tape.value(y).cols(), random));
  return sum(tape, multiply(tape, weight, add(tape, y, square(tape, y))));
}

struct Case {
  std::string name;
  std::vector<std::array<int, 2>> shapes;
  std::function<Var(Tape<double>&, std::span<const Var>)> operation;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

using T = Tape<double>;
using X = std::span<const Var>;

std::vector<Case> cases() {
  std::vector<Case> list = {
      {"add", {{3, 4}, {3, 4}}, [](T& t, X x) { return add(t, x[0], x[1]); }},
      {"sub", {{3, 4}, {3, 4}}, [](T& t, X x) { return sub(t, x[0], x[1]); }},
      {"multiply", {{3, 4}, {3, 4}}, [](T& t, X x) { return multiply(t, x[0], x[1]); }},
      {"multiply_by_itself", {{3, 4}}, [](T& t, X x) { return multiply(t, x[0], x[0]); }},
      {"minimum", {{3, 4}, {3, 4}}, [](T& t, X x) { return minimum(t, x[0], x[1]); }},
      {"scale", {{3, 4}}, [](T& t, X x) { return scale(t, x[0], 1.5, -0.25); }},
      {"exp", {{3, 4}}, [](T& t, X x) { return exp(t, x[0]); }},
      {"square", {{3, 4}}, [](T& t, X x) { return square(t, x[0]); }},
      {"clamp", {{3, 4}}, [](T& t, X x) { return clamp(t, x[0], -0.5, 0.7); }},
      {"sum", {{3, 4}}, [](T& t, X x) { return sum(t, x[0]); }},
      {"mean", {{3, 4}}, [](T& t, X x) { return mean(t, x[0]); }},
      {"column_sum", {{3, 4}}, [](T& t, X x) { return column_sum(t, x[0]); }},
      {"row_sum", {{3, 4}}, [](T& t, X x) { return row_sum(t, x[0]); }},
      {"log_sum_exp", {{3, 4}}, [](T& t, X x) { return log_sum_exp(t, x[0]); }},
      {"softmax_cross_entropy",
       {{3, 4}, {3, 4}},
       [](T& t, X x) { return softmax_cross_entropy(t, x[0], x[1]); }},
      {"broadcast_scalar", {{1, 1}}, [](T& t, X x) { return broadcast(t, x[0], 3, 4); }},
      {"broadcast_row", {{1, 4}}, [](T& t, X x) { return broadcast(t, x[0], 3, 4); }},
      {"broadcast_column", {{3, 1}}, [](T& t, X x) { return broadcast(t, x[0], 3, 4); }}};
  for (const bool ta : {false, true})
    for (const bool tb : {false, true})
      list.push_back({std::string("matmul_") + (ta ? "t" : "n") + (tb ? "t" : "n"),
                      {ta ? std::array{4, 3} : std::array{3, 4}, tb ? std::array{5, 4} : std::array{4, 5}},
                      [=](T& t, X x) { return matmul(t, x[0], x[1], ta, tb); }});
  for (const auto kind : {Activation::kLinear, Activation::kElu})
    list.push_back({kind == Activation::kElu ? "affine_elu" : "affine_linear",
                    {{3, 4}, {4, 2}, {1, 2}},
                    [=](T& t, X x) { return affine(t, x[0], x[1], x[2], kind); }});
  return list;
}

class EveryOp : public testing::TestWithParam<Case> {};

TEST_P(EveryOp, GradientsOfThreeOrdersMatchFiniteDifferences) {
  Random random(3);
  Inputs inputs;
  for (const auto& [rows, cols] : GetParam().shapes) inputs.push_back(random_matrix(rows, cols, random));
  const auto& operation = GetParam().operation;
  expect_all_orders_match_differences([&](T& t, X x) { return weighted(t, operation(t, x)); }, inputs);
}

INSTANTIATE_TEST_SUITE_P(All, EveryOp, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

TEST(Ops, ProductsOfAllTransposesEqualTripleLoops) {
  Random random(4);
  for (const bool ta : {false, true})
    for (const bool tb : {false, true}) {
      const auto a = ta ? random_matrix(7, 5, random) : random_matrix(5, 7, random);
      const auto b = tb ? random_matrix(6, 7, random) : random_matrix(7, 6, random);
      Tape<double> tape;
      const auto& c = tape.value(matmul(tape, tape.refer(a), tape.refer(b), ta, tb));
      for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 6; ++j) {
          double expected = 0;
          for (int k = 0; k < 7; ++k) expected += (ta ? a(k, i) : a(i, k)) * (tb ? b(j, k) : b(k, j));
          EXPECT_NEAR(c(i, j), expected, 1e-13);
        }
    }
}

TEST(Ops, MinimumPassesTheGradientOfATieToTheFirst) {
  const Inputs inputs = {Matrix<double>::Constant(1, 1, 2.0), Matrix<double>::Constant(1, 1, 2.0)};
  const auto g = tape_gradient([](T& t, X x) { return minimum(t, x[0], x[1]); }, inputs);
  EXPECT_EQ(g[0](0, 0), 1.0);
  EXPECT_EQ(g[1](0, 0), 0.0);
}

TEST(Ops, ClampPassesTheGradientAtItsBoundsAndStopsItBeyond) {
  Matrix<double> x(1, 4);
  x << -1.0, -1.1, 2.0, 2.1;
  const auto g = tape_gradient([](T& t, X v) { return sum(t, clamp(t, v[0], -1.0, 2.0)); }, {x});
  EXPECT_EQ(g[0], (Matrix<double>(1, 4) << 1, 0, 1, 0).finished());
}

TEST(Ops, CrossEntropyOfEqualLogitsIsTheLogarithmOfTheirNumberHoweverLargeTheyAre) {
  for (const double logit : {0.0, 5e4, -5e4}) {
    Tape<double> tape;
    Matrix<double> target = Matrix<double>::Zero(2, 4);
    target(0, 1) = target(1, 3) = 1.0;
    const Var loss = softmax_cross_entropy(tape, tape.constant(2, 4, logit), tape.constant(target));
    EXPECT_NEAR(tape.scalar(loss), std::log(4.0), 1e-11);
  }
}

TEST(Tape, GradientOfAnUnrelatedNodeIsZero) {
  Tape<double> tape;
  const Var x = tape.constant(2, 3, 1.0), y = tape.constant(4, 1, 1.0);
  const std::array wrt = {x, y};
  const auto g = gradient<double>(tape, sum(tape, square(tape, x)), wrt);
  EXPECT_EQ(tape.value(g[0]), Matrix<double>::Constant(2, 3, 2.0));
  EXPECT_EQ(tape.value(g[1]), Matrix<double>::Zero(4, 1));
}

TEST(Tape, GradientOfAnIntermediateValueStopsThere) {
  Tape<double> tape;
  const Var x = tape.constant(1, 1, 3.0);
  const Var y = square(tape, x);
  const std::array wrt = {y, x};
  const auto g = gradient<double>(tape, square(tape, y), wrt);
  EXPECT_DOUBLE_EQ(tape.scalar(g[0]), 18.0);        // d(y²)/dy = 2y
  EXPECT_DOUBLE_EQ(tape.scalar(g[1]), 4.0 * 27.0);  // d(x⁴)/dx = 4x³
}

TEST(Tape, ComputesOnlyTheRequestedGradients) {
  const auto nodes_of_gradient = [](bool with_input) {
    Tape<double> tape;
    const Var x = tape.constant(5, 4, 1.0), w = tape.constant(4, 3, 1.0), b = tape.constant(1, 3, 0.0);
    const Var loss = sum(tape, affine(tape, x, w, b, Activation::kElu));
    const int before = tape.size();
    std::vector<Var> wrt = {w, b};
    if (with_input) wrt.push_back(x);
    gradient<double>(tape, loss, wrt);
    return tape.size() - before;
  };
  // Seed, broadcast of the sum, slope, product for w, column sum for b; the input needs one more product.
  EXPECT_EQ(nodes_of_gradient(false), 5);
  EXPECT_EQ(nodes_of_gradient(true), 6);
}

TEST(Tape, AccumulatesNothingForConstants) {
  Tape<double> tape;
  const Var x = tape.constant(2, 2, 1.0), c = tape.constant(2, 2, 3.0);
  const Var loss = sum(tape, add(tape, add(tape, x, c), c));
  const int before = tape.size();
  const std::array wrt = {x};
  gradient<double>(tape, loss, wrt);
  EXPECT_EQ(tape.size() - before, 2);  // seed and broadcast; accumulating the gradient of c would be a third
}

TEST(Tape, ASecondPassReusesEveryBufferOfTheFirst) {
  Random random(8);
  const auto x = random_matrix(32, 6, random), w = random_matrix(6, 3, random);
  Tape<double> tape;
  std::array<std::vector<const double*>, 2> addresses;
  for (auto& pass : addresses) {
    tape.reset();
    const Var weight = tape.refer(w);
    const Var y = affine(tape, tape.constant(x), weight, tape.constant(1, 3, 0.1), Activation::kElu);
    const std::array wrt = {weight};
    const auto g = gradient<double>(tape, mean(tape, square(tape, y)), wrt);
    gradient<double>(tape, sum(tape, square(tape, g[0])), wrt);
    for (int i = 0; i < tape.size(); ++i) pass.push_back(tape.value({i}).data());
  }
  EXPECT_GT(addresses[0].size(), 15u);
  EXPECT_EQ(addresses[0], addresses[1]);
}

}  // namespace
}  // namespace mimicx::nn
