/// The gradient of a number on a tape: the walk back through its nodes.
///
/// Every node's rule (tape.h) is written in operations (ops.h), so the walk appends nodes, and its result can
/// be differentiated again.
#pragma once

#include "nn/tape.h"

namespace mimicx::nn {

/// Gradients of the 1×1 node `scalar` with respect to each of `wrt`, appended to the tape. Nothing is
/// computed that no entry of `wrt` needs. An entry that `scalar` does not depend on gives zeros.
template <class S>
std::vector<Var> gradient(Tape<S>& tape, Var scalar, std::span<const Var> wrt);

}  // namespace mimicx::nn
