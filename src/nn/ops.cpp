#include "nn/ops.h"

#include <cassert>

#include "core/elementary.h"
#include "nn/elementwise.h"
#include "nn/gemm.h"

namespace mimicx::nn {

namespace {

using Eigen::Index;
using Wanted = std::array<bool, kMaxInputs>;
using Gradients = std::array<Var, kMaxInputs>;

template <class S>
using Recipe = typename Tape<S>::Recipe;

template <class S>
Var append_like(Tape<S>& tape, const Recipe<S>& recipe, Var like) {
  return tape.append(recipe, tape.value(like).rows(), tape.value(like).cols());
}

template <class S>
[[maybe_unused]] bool same_shape(const Tape<S>& tape, Var a, Var b) {
  return tape.value(a).rows() == tape.value(b).rows() && tape.value(a).cols() == tape.value(b).cols();
}

/// 1 where the condition on the elements of a and b holds, otherwise 0; constant for gradients.
template <class S, class Condition>
Var indicator(Tape<S>& tape, Var a, Var b, Condition condition) {
  const Var mask = append_like<S>(tape, {}, a);
  const S* left = tape.value(a).data();
  const S* right = tape.value(b).data();
  S* out = tape.buffer(mask).data();
  const Index n = tape.value(a).size();
  for (Index i = 0; i < n; ++i) out[i] = condition(left[i], right[i]) ? S(1) : S(0);
  return mask;
}

}  // namespace

// ---- products ----------------------------------------------------------------------------------------

// C = op(A)·op(B), G = dL/dC: dL/dop(A) = G·op(B)ᵀ, dL/dop(B) = op(A)ᵀ·G; transposed for an input that was
// transposed.
template <class S>
static Gradients matmul_adjoint(Tape<S>& tape, Var node, Var g, const Wanted& wanted) {
  const Recipe<S> recipe = tape.recipe(node);
  const Var a = recipe.inputs[0], b = recipe.inputs[1];
  const bool transpose_a = recipe.flags[0] != 0, transpose_b = recipe.flags[1] != 0;
  Gradients result;
  if (wanted[0])
    result[0] = transpose_a ? matmul(tape, b, g, transpose_b, true) : matmul(tape, g, b, false, !transpose_b);
  if (wanted[1])
    result[1] = transpose_b ? matmul(tape, g, a, true, transpose_a) : matmul(tape, a, g, !transpose_a, false);
  return result;
}

template <class S>
Var matmul(Tape<S>& tape, Var a, Var b, bool transpose_a, bool transpose_b) {
  const Matrix<S>& left = tape.value(a);
  const Matrix<S>& right = tape.value(b);
  assert((transpose_a ? left.rows() : left.cols()) == (transpose_b ? right.cols() : right.rows()));
  const Var c =
      tape.append({matmul_adjoint<S>, {a, b}, {}, {transpose_a, transpose_b}},
                  transpose_a ? left.cols() : left.rows(), transpose_b ? right.rows() : right.cols());
  gemm<S>(transpose_a, transpose_b, left, right, nullptr, tape.buffer(c));
  return c;
}

// ---- layers ------------------------------------------------------------------------------------------

template <class S>
static Var elu_slope_product(Tape<S>& tape, Var g, Var y);

// r = g ⊙ φ'(y), φ' being a function of y = elu(x): dL/dg = G ⊙ φ'(y), dL/dy = G ⊙ g ⊙ dφ'/dy with
// dφ'/dy = 1 on the negative side (φ' = y + 1), else 0.
template <class S>
static Gradients elu_slope_product_adjoint(Tape<S>& tape, Var node, Var outer, const Wanted& wanted) {
  const auto [g, y] = std::array{tape.recipe(node).inputs[0], tape.recipe(node).inputs[1]};
  Gradients result;
  if (wanted[0]) result[0] = elu_slope_product(tape, outer, y);
  if (wanted[1]) {
    const Var bent = indicator(tape, y, y, [](S value, S) { return !(value > S(0)); });
    result[1] = multiply(tape, multiply(tape, outer, g), bent);
  }
  return result;
}

/// g ⊙ φ'(y): the adjoint of elu, as an operation.
template <class S>
static Var elu_slope_product(Tape<S>& tape, Var g, Var y) {
  const Var r = append_like<S>(tape, {elu_slope_product_adjoint<S>, {g, y}}, g);
  multiply_by_elu_slope(tape.value(g), tape.value(y), tape.buffer(r));
  return r;
}

// y = φ(x·W + b): with D = G ⊙ φ'(y), dL/dx = D·Wᵀ, dL/dW = xᵀ·D, dL/db = column sums of D.
template <class S>
static Gradients affine_adjoint(Tape<S>& tape, Var node, Var g, const Wanted& wanted) {
  const Recipe<S> recipe = tape.recipe(node);
  const bool bent = recipe.flags[0] == static_cast<int>(Activation::kElu);
  const Var d = bent ? elu_slope_product(tape, g, node) : g;
  Gradients result;
  if (wanted[0]) result[0] = matmul(tape, d, recipe.inputs[1], false, true);
  if (wanted[1]) result[1] = matmul(tape, recipe.inputs[0], d, true, false);
  if (wanted[2]) result[2] = column_sum(tape, d);
  return result;
}

template <class S>
Var affine(Tape<S>& tape, Var x, Var weight, Var bias, Activation activation) {
  const Matrix<S>& in = tape.value(x);
  const Matrix<S>& w = tape.value(weight);
  assert(in.cols() == w.rows() && tape.value(bias).rows() == 1 && tape.value(bias).cols() == w.cols());
  const Var y = tape.append({affine_adjoint<S>, {x, weight, bias}, {}, {static_cast<int>(activation)}},
                            in.rows(), w.cols());
  Matrix<S>& out = tape.buffer(y);
  gemm<S>(false, false, in, w, tape.value(bias).data(), out);
  if (activation == Activation::kElu) apply_elu(out, out);
  return y;
}

// ---- element by element ------------------------------------------------------------------------------

template <class S>
static Gradients add_adjoint(Tape<S>&, Var, Var g, const Wanted&) {
  return {g, g};
}

template <class S>
Var add(Tape<S>& tape, Var a, Var b) {
  assert(same_shape(tape, a, b));
  const Var y = append_like<S>(tape, {add_adjoint<S>, {a, b}}, a);
  tape.buffer(y) = tape.value(a) + tape.value(b);
  return y;
}

template <class S>
static Gradients sub_adjoint(Tape<S>& tape, Var, Var g, const Wanted& wanted) {
  return {g, wanted[1] ? scale(tape, g, S(-1)) : Var{}};
}

template <class S>
Var sub(Tape<S>& tape, Var a, Var b) {
  assert(same_shape(tape, a, b));
  const Var y = append_like<S>(tape, {sub_adjoint<S>, {a, b}}, a);
  tape.buffer(y) = tape.value(a) - tape.value(b);
  return y;
}

template <class S>
static Gradients multiply_adjoint(Tape<S>& tape, Var node, Var g, const Wanted& wanted) {
  const auto inputs = tape.recipe(node).inputs;
  return {wanted[0] ? multiply(tape, g, inputs[1]) : Var{}, wanted[1] ? multiply(tape, g, inputs[0]) : Var{}};
}

template <class S>
Var multiply(Tape<S>& tape, Var a, Var b) {
  assert(same_shape(tape, a, b));
  const Var y = append_like<S>(tape, {multiply_adjoint<S>, {a, b}}, a);
  tape.buffer(y) = tape.value(a).cwiseProduct(tape.value(b));
  return y;
}

template <class S>
static Gradients minimum_adjoint(Tape<S>& tape, Var node, Var g, const Wanted& wanted) {
  const auto inputs = tape.recipe(node).inputs;
  const Var first = indicator(tape, inputs[0], inputs[1], [](S a, S b) { return !(b < a); });
  return {multiply(tape, g, first), wanted[1] ? multiply(tape, g, scale(tape, first, S(-1), S(1))) : Var{}};
}

template <class S>
Var minimum(Tape<S>& tape, Var a, Var b) {
  assert(same_shape(tape, a, b));
  const Var y = append_like<S>(tape, {minimum_adjoint<S>, {a, b}}, a);
  tape.buffer(y) = tape.value(a).binaryExpr(tape.value(b), [](S u, S v) { return v < u ? v : u; });
  return y;
}

template <class S>
static Gradients scale_adjoint(Tape<S>& tape, Var node, Var g, const Wanted&) {
  return {scale(tape, g, tape.recipe(node).numbers[0])};
}

template <class S>
Var scale(Tape<S>& tape, Var x, S factor, S offset) {
  const Var y = append_like<S>(tape, {scale_adjoint<S>, {x}, {factor, offset}}, x);
  tape.buffer(y).array() = tape.value(x).array() * factor + offset;
  return y;
}

template <class S>
static Gradients exp_adjoint(Tape<S>& tape, Var node, Var g, const Wanted&) {
  return {multiply(tape, g, node)};
}

template <class S>
Var exp(Tape<S>& tape, Var x) {
  const Var y = append_like<S>(tape, {exp_adjoint<S>, {x}}, x);
  apply_exp(tape.value(x), tape.buffer(y));
  return y;
}

template <class S>
static Gradients square_adjoint(Tape<S>& tape, Var node, Var g, const Wanted&) {
  return {multiply(tape, g, scale(tape, tape.recipe(node).inputs[0], S(2)))};
}

template <class S>
Var square(Tape<S>& tape, Var x) {
  const Var y = append_like<S>(tape, {square_adjoint<S>, {x}}, x);
  tape.buffer(y) = tape.value(x).cwiseAbs2();
  return y;
}

template <class S>
static Gradients clamp_adjoint(Tape<S>& tape, Var node, Var g, const Wanted&) {
  const Var x = tape.recipe(node).inputs[0];
  return {multiply(tape, g, indicator(tape, x, node, [](S in, S out) { return in == out; }))};
}

template <class S>
Var clamp(Tape<S>& tape, Var x, S low, S high) {
  const Var y = append_like<S>(tape, {clamp_adjoint<S>, {x}, {low, high}}, x);
  tape.buffer(y) = tape.value(x).unaryExpr([=](S v) { return v < low ? low : (v > high ? high : v); });
  return y;
}

// ---- sums and broadcasts -----------------------------------------------------------------------------

/// Adjoint of every sum: the gradient, broadcast to the shape of the input.
template <class S>
static Gradients sum_adjoint(Tape<S>& tape, Var node, Var g, const Wanted&) {
  const Matrix<S>& x = tape.value(tape.recipe(node).inputs[0]);
  return {broadcast(tape, g, x.rows(), x.cols())};
}

template <class S>
Var sum(Tape<S>& tape, Var x) {
  const Var y = tape.append({sum_adjoint<S>, {x}}, 1, 1);
  tape.buffer(y)(0, 0) = ordered_sum(tape.value(x).data(), tape.value(x).size());
  return y;
}

template <class S>
Var mean(Tape<S>& tape, Var x) {
  return scale(tape, sum(tape, x), S(1) / static_cast<S>(tape.value(x).size()));
}

template <class S>
Var column_sum(Tape<S>& tape, Var x) {
  const Var y = tape.append({sum_adjoint<S>, {x}}, 1, tape.value(x).cols());
  sum_rows(tape.value(x), tape.buffer(y));
  return y;
}

template <class S>
Var row_sum(Tape<S>& tape, Var x) {
  const Matrix<S>& in = tape.value(x);
  const Var y = tape.append({sum_adjoint<S>, {x}}, in.rows(), 1);
  Matrix<S>& out = tape.buffer(y);
  for (Index i = 0; i < in.rows(); ++i) out(i, 0) = ordered_sum(in.data() + i * in.cols(), in.cols());
  return y;
}

// y = log Σ e^x: dL/dx = g · softmax(x) with softmax(x) = e^(x − y).
template <class S>
static Gradients log_sum_exp_adjoint(Tape<S>& tape, Var node, Var g, const Wanted&) {
  const Var x = tape.recipe(node).inputs[0];
  const Index rows = tape.value(x).rows(), cols = tape.value(x).cols();
  const Var softmax = exp(tape, sub(tape, x, broadcast(tape, node, rows, cols)));
  return {multiply(tape, broadcast(tape, g, rows, cols), softmax)};
}

template <class S>
Var log_sum_exp(Tape<S>& tape, Var x) {
  const Matrix<S>& in = tape.value(x);
  const Var y = tape.append({log_sum_exp_adjoint<S>, {x}}, in.rows(), 1);
  Matrix<S>& out = tape.buffer(y);
  Matrix<S> powers(1, in.cols());
  for (Index i = 0; i < in.rows(); ++i) {
    const S largest = in.row(i).maxCoeff();
    for (Index k = 0; k < in.cols(); ++k) powers(0, k) = exp_value(in(i, k) - largest);
    out(i, 0) = largest + static_cast<S>(mimicx::log(double{ordered_sum(powers.data(), powers.size())}));
  }
  return y;
}

template <class S>
Var softmax_cross_entropy(Tape<S>& tape, Var logits, Var target) {
  assert(same_shape(tape, logits, target));
  return mean(tape, sub(tape, log_sum_exp(tape, logits), row_sum(tape, multiply(tape, logits, target))));
}

/// Adjoint of a broadcast: the sum over the dimensions that it repeated.
template <class S>
static Gradients broadcast_adjoint(Tape<S>& tape, Var node, Var g, const Wanted&) {
  const Matrix<S>& x = tape.value(tape.recipe(node).inputs[0]);
  if (x.size() == 1) return {sum(tape, g)};
  return {x.rows() == 1 ? column_sum(tape, g) : row_sum(tape, g)};
}

template <class S>
Var broadcast(Tape<S>& tape, Var x, Index rows, Index cols) {
  const Matrix<S>& in = tape.value(x);
  if (in.rows() == rows && in.cols() == cols) return x;
  assert((in.rows() == 1 || in.rows() == rows) && (in.cols() == 1 || in.cols() == cols));
  const Var y = tape.append({broadcast_adjoint<S>, {x}}, rows, cols);
  if (in.size() == 1)
    tape.buffer(y).setConstant(in(0, 0));
  else
    tape.buffer(y) = in.replicate(rows / in.rows(), cols / in.cols());
  return y;
}

#define MIMICX_INSTANTIATE(S)                               \
  template Var matmul(Tape<S>&, Var, Var, bool, bool);      \
  template Var affine(Tape<S>&, Var, Var, Var, Activation); \
  template Var add(Tape<S>&, Var, Var);                     \
  template Var sub(Tape<S>&, Var, Var);                     \
  template Var multiply(Tape<S>&, Var, Var);                \
  template Var minimum(Tape<S>&, Var, Var);                 \
  template Var scale(Tape<S>&, Var, S, S);                  \
  template Var exp(Tape<S>&, Var);                          \
  template Var square(Tape<S>&, Var);                       \
  template Var clamp(Tape<S>&, Var, S, S);                  \
  template Var sum(Tape<S>&, Var);                          \
  template Var mean(Tape<S>&, Var);                         \
  template Var column_sum(Tape<S>&, Var);                   \
  template Var row_sum(Tape<S>&, Var);                      \
  template Var log_sum_exp(Tape<S>&, Var);                  \
  template Var softmax_cross_entropy(Tape<S>&, Var, Var);   \
  template Var broadcast(Tape<S>&, Var, Index, Index);
MIMICX_INSTANTIATE(float)
MIMICX_INSTANTIATE(double)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::nn
