/// The one matrix type of the networks.
#pragma once

#include <Eigen/Core>

namespace mimicx::nn {

/// Row major, one row per sample, so that a sample is contiguous.
template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace mimicx::nn
