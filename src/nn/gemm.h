/// Matrix product of the networks: Eigen's, instantiated once.
///
/// Single-threaded: callers run one product per worker. The bits of a row of the result depend on its place
/// and on the number of rows, which change the order of summation, but never on the content of other rows.
/// Layers of 256 at 512 rows reach 108–112 of the 118 GFLOP/s that a core has (AMD EPYC, x86-64-v3 and -v4;
/// layers of 55: 80–92), so a kernel of our own would not pay.
#pragma once

#include "nn/matrix.h"

namespace mimicx::nn {

/// result = op(a) · op(b) + bias, op = transpose where the flag is set.
/// @param bias    [result.cols()], or null for zero
/// @param result  of its final shape; must not overlap a or b
template <class S>
void gemm(bool transpose_a, bool transpose_b, const Matrix<S>& a, const Matrix<S>& b, const S* bias,
          Matrix<S>& result);

}  // namespace mimicx::nn
