#include "nn/gemm.h"

namespace mimicx::nn {

template <class S>
void gemm(bool transpose_a, bool transpose_b, const Matrix<S>& a, const Matrix<S>& b, const S* bias,
          Matrix<S>& result) {
  if (bias != nullptr)
    result.rowwise() = Eigen::Map<const Eigen::Matrix<S, 1, Eigen::Dynamic>>(bias, result.cols());
  else
    result.setZero();
  if (!transpose_a && !transpose_b)
    result.noalias() += a * b;
  else if (!transpose_a)
    result.noalias() += a * b.transpose();
  else if (!transpose_b)
    result.noalias() += a.transpose() * b;
  else
    result.noalias() += a.transpose() * b.transpose();
}

template void gemm(bool, bool, const Matrix<float>&, const Matrix<float>&, const float*, Matrix<float>&);
template void gemm(bool, bool, const Matrix<double>&, const Matrix<double>&, const double*, Matrix<double>&);

}  // namespace mimicx::nn
