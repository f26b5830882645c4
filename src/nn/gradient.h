/// The gradient of a scalar on a tape: reverse-mode differentiation.
///
/// Every node's adjoint rule (tape.h) consists of operations (ops.h), so `gradient` appends nodes, and its
/// result can be differentiated again.
#pragma once

#include <span>
#include <vector>

#include "nn/tape.h"

namespace mimicx::nn {

/// Gradients of the 1×1 node `scalar` with respect to each of `wrt`, appended to the tape. Computes only what
/// the entries of `wrt` need. An entry on which `scalar` does not depend gives zeros.
template <class S>
std::vector<Var> gradient(Tape<S>& tape, Var scalar, std::span<const Var> wrt);

}  // namespace mimicx::nn
