#include "nn/normaliser.h"

#include <cassert>

namespace mimicx::nn {

namespace {

/// Added to the variance, so that small noise is not amplified to a deviation of 1.
constexpr double kVarianceFloor = 1e-6;

/// Times 1 + mean²: variance up to which a feature is constant. Rounding of the moments leaves less than it,
/// and a feature in 32-bit floats that varies has more.
constexpr double kConstantVariance = 1e-24;

/// Sets shift and factor, that of constant features too.
template <class S>
void scale_all(Normaliser<S>& normaliser) {
  const Moments& moments = normaliser.moments;
  if (moments.count == 0) return;
  normaliser.shift = moments.mean.cast<S>();
  normaliser.factor = (moments.squares.array() / moments.count + kVarianceFloor).sqrt().inverse().cast<S>();
}

}  // namespace

Moments make_moments(int features) {
  return {0, Eigen::RowVectorXd::Zero(features), Eigen::RowVectorXd::Zero(features)};
}

template <class S>
Moments moments_of(const Matrix<S>& batch) {
  Moments moments = make_moments(static_cast<int>(batch.cols()));
  if (batch.rows() == 0) return moments;
  moments.count = static_cast<double>(batch.rows());
  for (Eigen::Index i = 0; i < batch.rows(); ++i) moments.mean += batch.row(i).template cast<double>();
  moments.mean /= moments.count;
  for (Eigen::Index i = 0; i < batch.rows(); ++i)
    moments.squares += (batch.row(i).template cast<double>() - moments.mean).cwiseAbs2();
  return moments;
}

void merge(Moments& into, const Moments& other) {
  assert(into.mean.size() == other.mean.size());
  if (other.count == 0) return;
  const double count = into.count + other.count;
  const Eigen::RowVectorXd difference = other.mean - into.mean;
  into.mean += difference * (other.count / count);
  into.squares += other.squares + difference.cwiseAbs2() * (into.count * other.count / count);
  into.count = count;
}

template <class S>
Normaliser<S> make_normaliser(int features, S limit) {
  return {make_moments(features), limit, Matrix<S>::Zero(1, features), Matrix<S>::Ones(1, features)};
}

template <class S>
Normaliser<S> normaliser_of(const Matrix<S>& samples, S limit) {
  Normaliser<S> normaliser = make_normaliser<S>(static_cast<int>(samples.cols()), limit);
  merge(normaliser.moments, moments_of(samples));
  scale_all(normaliser);
  return normaliser;
}

template <class S>
void refresh(Normaliser<S>& normaliser) {
  scale_all(normaliser);
  const Moments& moments = normaliser.moments;
  for (Eigen::Index j = 0; j < moments.mean.size() && moments.count > 0; ++j)
    if (moments.squares[j] <= moments.count * kConstantVariance * (1.0 + moments.mean[j] * moments.mean[j]))
      normaliser.factor(0, j) = S(0);
}

template <class S>
void update(Normaliser<S>& normaliser, std::span<const Moments> batches) {
  for (const Moments& batch : batches) merge(normaliser.moments, batch);
  refresh(normaliser);
}

template <class S>
void normalise(const Normaliser<S>& normaliser, const Matrix<S>& x, Matrix<S>& output) {
  assert(x.cols() == normaliser.features());
  output.resize(x.rows(), x.cols());
  const S* shift = normaliser.shift.data();
  const S* factor = normaliser.factor.data();
  const S limit = normaliser.limit;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const S* in = x.data() + i * x.cols();
    S* out = output.data() + i * x.cols();
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      const S scaled = (in[j] - shift[j]) * factor[j];
      const S raised = scaled < -limit ? -limit : scaled;
      out[j] = raised > limit ? limit : raised;
    }
  }
}

template <class S>
void denormalise(const Normaliser<S>& normaliser, const Matrix<S>& x, Matrix<S>& output) {
  assert(x.cols() == normaliser.features());
  output.resize(x.rows(), x.cols());
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      const S factor = normaliser.factor(0, j), shift = normaliser.shift(0, j);
      output(i, j) = factor == S(0) ? shift : x(i, j) / factor + shift;
    }
}

#define MIMICX_INSTANTIATE(S)                                                  \
  template Moments moments_of(const Matrix<S>&);                               \
  template Normaliser<S> make_normaliser(int, S);                              \
  template Normaliser<S> normaliser_of(const Matrix<S>&, S);                   \
  template void refresh(Normaliser<S>&);                                       \
  template void update(Normaliser<S>&, std::span<const Moments>);              \
  template void normalise(const Normaliser<S>&, const Matrix<S>&, Matrix<S>&); \
  template void denormalise(const Normaliser<S>&, const Matrix<S>&, Matrix<S>&);
MIMICX_INSTANTIATE(float)
MIMICX_INSTANTIATE(double)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::nn
