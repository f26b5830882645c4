#include "policy_export/quantised_network.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "nn/elementwise.h"
#include "nn/gemm.h"
#include "policy_export/runtime.h"

namespace mimicx::policy_export {
namespace {

using Eigen::Index;

constexpr double kLargestWeight = 127.0;  // of an 8-bit weight
constexpr int kLargestPower = 30;
constexpr double kDamping = 0.05;  // of the mean of H's diagonal
constexpr Index kShapeAt = kPoseCount, kPoseAt = kShapeAt + kShapeCount, kDifferenceAt = kPoseAt + kPoseCount;

/// k of the power of two that is nearest to the root mean square of a row; 0 of a row of zeros.
int power_of(const nn::Matrix<float>& weights, Index row) {
  const double size =
      std::sqrt(weights.row(row).cast<double>().squaredNorm() / static_cast<double>(weights.cols()));
  if (!(size > 0.0)) return 0;
  return std::clamp(std::ilogb(size * 1.4142135623730951), -kLargestPower, kLargestPower);
}

/// U of step 3 for the inputs that stay. @param x  [samples][all inputs]
Eigen::MatrixXd spread_of_errors(const nn::Matrix<float>& x, const std::vector<std::int16_t>& rows) {
  const auto count = static_cast<Index>(rows.size());
  Eigen::MatrixXd kept(x.rows(), count);
  for (Index r = 0; r < count; ++r) kept.col(r) = x.col(rows[static_cast<std::size_t>(r)]).cast<double>();
  Eigen::MatrixXd H = kept.transpose() * kept / static_cast<double>(x.rows());
  H.diagonal().array() += kDamping * H.diagonal().mean() + 1e-12;
  const Eigen::MatrixXd inverse = H.llt().solve(Eigen::MatrixXd::Identity(count, count));
  return inverse.llt().matrixU();
}

/// @param rows  of the weights, those to keep  @param powers  [rows]  @param U  [rows][rows]
QuantisedLayer quantise_layer(const std::vector<std::int16_t>& rows, const std::vector<std::int8_t>& powers,
                              const Eigen::MatrixXd& U, nn::Matrix<float>& weights) {
  const auto count = static_cast<Index>(rows.size()), outputs = weights.cols();
  Eigen::MatrixXd exact(count, outputs);
  Eigen::RowVectorXd most = Eigen::RowVectorXd::Zero(outputs);
  for (Index r = 0; r < count; ++r) {
    const auto k = static_cast<std::size_t>(r);
    exact.row(r) = weights.row(rows[k]).cast<double>();
    most = most.cwiseMax(exact.row(r).cwiseAbs() * std::ldexp(1.0, -powers[k]));
  }
  QuantisedLayer small;
  for (Index o = 0; o < outputs; ++o) small.scales.push_back(static_cast<float>(most[o] / kLargestWeight));
  for (Index r = 0; r < count; ++r) {
    const auto k = static_cast<std::size_t>(r);
    Eigen::RowVectorXd error(outputs);
    for (Index o = 0; o < outputs; ++o) {
      const float scale = small.scales[static_cast<std::size_t>(o)];
      const double wanted = scale > 0.0F ? std::ldexp(exact(r, o), -powers[k]) / scale : 0.0;
      const auto code =
          static_cast<std::int8_t>(std::clamp(std::round(wanted), -kLargestWeight, kLargestWeight));
      small.codes.push_back(code);
      weights(rows[k], o) = std::ldexp(scale * static_cast<float>(code), powers[k]);
      error[o] = exact(r, o) - static_cast<double>(weights(rows[k], o));
    }
    const Index left = count - r - 1;
    exact.bottomRows(left) -= (U.row(r).tail(left).transpose() / U(r, r)) * error;
  }
  return small;
}

}  // namespace

void fold_inputs(const std::array<double, 10>& shape, rl::Agent& agent) {
  nn::Matrix<float>& W = agent.actor.weights.front();
  nn::Matrix<float>& b = agent.actor.biases.front();
  const nn::Matrix<float>& mean = agent.observations.shift;
  nn::Matrix<float>& factor = agent.observations.factor;
  for (Index i = 0; i < W.rows(); ++i) {  // the same answers, and a factor by which one may divide
    if (factor(0, i) != 0.0F) continue;
    W.row(i).setZero();
    factor(0, i) = 1.0F;
  }
  const float limit = agent.observations.limit;
  const auto m = [&](Index i) { return static_cast<double>(mean(0, i)); };
  const auto f = [&](Index i) { return static_cast<double>(factor(0, i)); };
  for (Index o = 0; o < W.cols(); ++o) {
    double bias = b(0, o);
    for (Index k = 0; k < kPoseCount; ++k) {
      const Index is = kPoseAt + k, difference = kDifferenceAt + k;
      const double gain = static_cast<double>(W(is, o)) * f(is);
      W(k, o) = static_cast<float>(W(k, o) + gain / f(k));
      W(difference, o) = static_cast<float>(W(difference, o) - gain / f(difference));
      bias += gain * (m(k) - m(difference) - m(is));
      W(is, o) = 0.0F;
    }
    for (Index k = 0; k < kShapeCount; ++k) {
      const float scaled = (static_cast<float>(shape[static_cast<std::size_t>(k)]) - mean(0, kShapeAt + k)) *
                           factor(0, kShapeAt + k);
      bias += static_cast<double>(W(kShapeAt + k, o)) * std::clamp(scaled, -limit, limit);
      W(kShapeAt + k, o) = 0.0F;
    }
    b(0, o) = static_cast<float>(bias);
  }
}

QuantisedNetwork quantise(const nn::Matrix<float>& observations, rl::Agent& agent) {
  QuantisedNetwork quantised;
  nn::Matrix<float> x, y;
  nn::normalise(agent.observations, observations, x);
  for (std::size_t layer = 0; layer < agent.actor.weights.size(); ++layer) {
    nn::Matrix<float>& weights = agent.actor.weights[layer];
    std::vector<std::int16_t> rows;
    std::vector<std::int8_t> powers;
    for (Index row = 0; row < weights.rows(); ++row) {
      if (layer == 0 && (weights.row(row).array() == 0.0F).all()) continue;
      rows.push_back(static_cast<std::int16_t>(row));
      powers.push_back(static_cast<std::int8_t>(layer == 0 ? power_of(weights, row) : 0));
    }
    quantised.layers.push_back(quantise_layer(rows, powers, spread_of_errors(x, rows), weights));
    if (layer == 0) {
      quantised.inputs = rows;
      quantised.powers = powers;
    }
    y.resize(x.rows(), weights.cols());
    nn::gemm(false, false, x, weights, agent.actor.biases[layer].data(), y);
    nn::apply_elu(y, y);
    x = y;
  }
  return quantised;
}

}  // namespace mimicx::policy_export
