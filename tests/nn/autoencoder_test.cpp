#include "nn/autoencoder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mimicx::nn {
namespace {

/// Two vectors of 12 dimensions, always the same ones.
Eigen::Matrix<double, 2, 12> plane_axes() {
  Random random(7);
  Eigen::Matrix<double, 2, 12> axes;
  for (int k = 0; k < axes.size(); ++k) axes.data()[k] = random.normal();
  return axes;
}

/// Points of the plane of these. @param seed  of the points
Matrix<float> plane_points(int n, std::uint64_t seed) {
  Random random(seed);
  const Eigen::Matrix<double, 2, 12> axes = plane_axes();
  Matrix<float> points(n, 12);
  for (int row = 0; row < n; ++row) {
    const double u = random.normal();
    const Eigen::RowVector2d at(u, random.normal());
    points.row(row) = (at * axes).cast<float>();
  }
  return points;
}

AutoEncoderConfig small() {
  AutoEncoderConfig config;
  config.hidden = 32;
  config.code = 2;
  config.corruption = 0.15;
  config.steps = 4000;
  config.minibatch = 64;
  config.step_size = 5e-3;
  return config;
}

double rms(const Matrix<float>& m) { return std::sqrt(m.squaredNorm() / static_cast<float>(m.size())); }

TEST(AutoEncoder, RemovesNoiseThatSamplesDoNotShare) {
  AutoEncoderStats stats;
  const AutoEncoder coder = train_autoencoder(plane_points(500, 1), small(), 3, &stats);
  EXPECT_LT(stats.last_loss, 0.3 * stats.first_loss);
  const Matrix<float> clean = plane_points(200, 2);
  Matrix<float> noisy = clean;
  Random random(4);
  for (Eigen::Index k = 0; k < noisy.size(); ++k)
    noisy.data()[k] += static_cast<float>(0.3 * random.normal());
  Matrix<float> code, decoded;
  encode(coder, noisy, code, decoded);
  EXPECT_EQ(code.cols(), 2);
  // What no sample has is across the plane: x − x QᵀQ with an orthonormal basis Q.
  Eigen::Matrix<double, 2, 12> Q = plane_axes();
  Q.row(0).normalize();
  Q.row(1) -= Q.row(1).dot(Q.row(0)) * Q.row(0);
  Q.row(1).normalize();
  const auto across = [&Q](const Matrix<float>& x) {
    const Matrix<double> all = x.cast<double>(), inside = all * Q.transpose();
    return rms((all - inside * Q).cast<float>());
  };
  EXPECT_LT(across(decoded - clean), 0.05 * across(noisy - clean));
  encode(coder, clean, code, decoded);
  EXPECT_LT(rms(decoded - clean), 0.2 * rms(clean))
      << "what all samples have stays: " << rms(decoded - clean) / rms(clean);
}

// Steps of size 0 leave the initial networks: the loss of a large minibatch is that of as many own draws.
TEST(AutoEncoder, LossIsTheMeanSquaredErrorAgainstTheUncorruptedInput) {
  constexpr int kRows = 20000;
  const Matrix<float> samples = plane_points(50, 6);
  AutoEncoderConfig config = small();
  config.corruption = 1.5;
  config.steps = 1;
  config.minibatch = kRows;
  config.step_size = 0.0;
  AutoEncoderStats stats;
  const AutoEncoder coder = train_autoencoder(samples, config, 3, &stats);
  Matrix<float> normalised, clean(kRows, samples.cols()), corrupted, code, decoded;
  normalise(coder.inputs, samples, normalised);
  Random random(8);
  for (int row = 0; row < kRows; ++row) clean.row(row) = normalised.row(static_cast<int>(random.below(50)));
  corrupted = clean;
  for (Eigen::Index k = 0; k < corrupted.size(); ++k)
    corrupted.data()[k] += static_cast<float>(config.corruption * random.normal());
  Workspace<float> workspace;
  evaluate(coder.encoder, corrupted, workspace, code);
  evaluate(coder.decoder, code, workspace, decoded);
  const double expected = std::pow(rms(decoded - clean), 2);
  EXPECT_NEAR(stats.first_loss, expected, 0.02 * expected);
  EXPECT_GT(std::abs(std::pow(rms(decoded - corrupted), 2) - expected), 0.1 * expected);
}

TEST(AutoEncoder, BitsDependOnTheSeedAlone) {
  const Matrix<float> samples = plane_points(100, 5);
  AutoEncoderConfig config = small();
  config.steps = 50;
  const AutoEncoder a = train_autoencoder(samples, config, 1), b = train_autoencoder(samples, config, 1),
                    c = train_autoencoder(samples, config, 2);
  EXPECT_TRUE(a.encoder.weights[0] == b.encoder.weights[0] && a.decoder.weights[1] == b.decoder.weights[1]);
  EXPECT_FALSE(a.encoder.weights[0] == c.encoder.weights[0]);
}

TEST(AutoEncoder, ArchiveRoundTripKeepsEveryBit) {
  AutoEncoderConfig config = small();
  config.steps = 20;
  const Matrix<float> samples = plane_points(50, 6);
  const AutoEncoder coder = train_autoencoder(samples, config, 1);
  Npz archive;
  save(archive, "e.", coder);
  const AutoEncoder back = load_autoencoder(archive, "e.");
  Matrix<float> code, decoded, code_back, decoded_back;
  encode(coder, samples, code, decoded);
  encode(back, samples, code_back, decoded_back);
  EXPECT_TRUE(code == code_back);
  EXPECT_TRUE(decoded == decoded_back);
}

}  // namespace
}  // namespace mimicx::nn
