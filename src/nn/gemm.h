/// Matrix product of the networks, single-threaded (callers run one product per worker).
#pragma once

#include <vector>

#include "nn/matrix.h"

namespace mimicx::nn {

/// Packing space, reused from call to call.
template <class S>
struct GemmScratch {
  Matrix<S> packed;
};

/// result = op(a) · op(b) + bias, op = transpose where the flag is set.
/// @param bias    one row of result.cols() numbers, or null for zero
/// @param result  has its shape already; must not overlap a or b
template <class S>
void gemm(bool transpose_a, bool transpose_b, const Matrix<S>& a, const Matrix<S>& b, const S* bias,
          Matrix<S>& result, GemmScratch<S>& scratch);

}  // namespace mimicx::nn
