/// Operations on a tape. ops.cpp has each beside its adjoint rule, which consists of operations.
///
/// Shapes are [rows, cols]; samples are rows. S is float or double. Shapes are asserted.
#pragma once

#include "nn/tape.h"

namespace mimicx::nn {

/// op(a) · op(b), op = transpose where the flag is set.
template <class S>
Var matmul(Tape<S>& tape, Var a, Var b, bool transpose_a = false, bool transpose_b = false);
enum class Activation { kLinear, kElu };

/// activation(x · weight + bias): x [n, in], weight [in, out], bias [1, out].
template <class S>
Var affine(Tape<S>& tape, Var x, Var weight, Var bias, Activation activation = Activation::kLinear);

/// Element by element; both of one shape.
template <class S>
Var add(Tape<S>& tape, Var a, Var b);
template <class S>
Var sub(Tape<S>& tape, Var a, Var b);
template <class S>
Var multiply(Tape<S>& tape, Var a, Var b);
/// The smaller one; at a tie the gradient goes to a.
template <class S>
Var minimum(Tape<S>& tape, Var a, Var b);

/// factor · x + offset.
template <class S>
Var scale(Tape<S>& tape, Var x, S factor, S offset = S(0));

template <class S>
Var exp(Tape<S>& tape, Var x);
template <class S>
Var square(Tape<S>& tape, Var x);
/// Clamped to [low, high]; the gradient passes for low ≤ x ≤ high.
template <class S>
Var clamp(Tape<S>& tape, Var x, S low, S high);

/// All elements → [1, 1].
template <class S>
Var sum(Tape<S>& tape, Var x);
template <class S>
Var mean(Tape<S>& tape, Var x);
/// Over the rows: [n, m] → [1, m].
template <class S>
Var column_sum(Tape<S>& tape, Var x);
/// Over the columns: [n, m] → [n, 1].
template <class S>
Var row_sum(Tape<S>& tape, Var x);
/// log Σ e^x over the columns: [n, m] → [n, 1]; does not overflow. Error of the logarithm: one unit of
/// double.
template <class S>
Var log_sum_exp(Tape<S>& tape, Var x);
/// Cross-entropy of softmax(logits) with the target's probabilities, nats, mean over the rows: [n, m] twice →
/// [1, 1]. The rows of the target sum to 1.
template <class S>
Var softmax_cross_entropy(Tape<S>& tape, Var logits, Var target);
/// The adjoints of the sums: [1, 1], [1, cols] or [rows, 1] → [rows, cols].
template <class S>
Var broadcast(Tape<S>& tape, Var x, Eigen::Index rows, Eigen::Index cols);

}  // namespace mimicx::nn
