/// Running mean and deviation of features, and the scaling of inputs by them.
///
/// Workers compute the moments of their chunks; the owner merges them in a fixed order. Statistics are in
/// double: Chan, Golub, LeVeque, "Updating formulae and a pairwise algorithm for computing sample
/// variances" (1979), Eq. 2.1.
#pragma once

#include <span>

#include "nn/matrix.h"

namespace mimicx::nn {

/// Sums over samples, per feature.
struct Moments {
  double count = 0;
  Eigen::RowVectorXd mean;     ///< [features]
  Eigen::RowVectorXd squares;  ///< [features] Σ (x − mean)²
};

/// Moments of no rows.
Moments make_moments(int features);

/// Moments of the rows of a batch, in two passes; count 0 for no rows.
template <class S>
Moments moments_of(const Matrix<S>& batch);

/// Makes `into` the moments of both samples together.
void merge(Moments& into, const Moments& other);

template <class S>
struct Normaliser {
  Moments moments;
  S limit = S(10);   ///< outputs are clipped to ± limit
  Matrix<S> shift;   ///< [1, features] mean
  Matrix<S> factor;  ///< [1, features] 1 / deviation; 0 of a constant feature

  int features() const { return static_cast<int>(moments.mean.size()); }
};

/// A normaliser without samples: the identity apart from clipping.
template <class S>
Normaliser<S> make_normaliser(int features, S limit = S(10));

/// A normaliser that makes these samples unit normal. Constant features have a deviation, too, of 1e-3: for
/// trainings that disturb every feature by a share of its deviation.
template <class S>
Normaliser<S> normaliser_of(const Matrix<S>& samples, S limit = S(10));

/// Recomputes shift and factor from the moments. A feature that was constant so far becomes 0, also if its
/// value is another now: no weight on it has been trained.
template <class S>
void refresh(Normaliser<S>& normaliser);
/// Merges the batches in the order given and refreshes shift and factor.
template <class S>
void update(Normaliser<S>& normaliser, std::span<const Moments> batches);

/// (x − shift) · factor, clipped. x [n, features] → output of the same shape; output may be x itself.
template <class S>
void normalise(const Normaliser<S>& normaliser, const Matrix<S>& x, Matrix<S>& output);
/// The inverse (without the clipping); a constant feature becomes its mean.
template <class S>
void denormalise(const Normaliser<S>& normaliser, const Matrix<S>& x, Matrix<S>& output);

}  // namespace mimicx::nn
