/// Denoising auto-encoder: x corrupted → z → x.                             docs/method.md §7
///
/// Source: Vincent et al., "Extracting and composing robust features with denoising autoencoders", ICML 2008.
/// Inputs are normalised feature by feature, corrupted by Gaussian noise, encoded and decoded; the loss is
/// the mean squared error against the uncorrupted, normalised input. The code keeps what training samples
/// have in common and drops errors that differ from sample to sample. Deterministic: the result depends on
/// samples, configuration and seed only.
#pragma once

#include <cstdint>
#include <functional>

#include "core/npz/npz_archive.h"
#include "nn/mlp.h"
#include "nn/normaliser.h"

namespace mimicx::nn {

struct AutoEncoderConfig {
  int hidden = 256;         ///< width of the hidden layer of E and of D
  int code = 64;            ///< entries of z
  double corruption = 0.1;  ///< σ of the noise on the normalised input
  int steps = 6000;         ///< minibatches
  int minibatch = 128;      ///< rows
  double step_size = 1e-3;  ///< Adam's at the start; falls linearly to a tenth
};

struct AutoEncoder {
  Normaliser<float> inputs;
  Mlp<float> encoder;  ///< normalised x → z
  Mlp<float> decoder;  ///< z → normalised x

  int code_size() const { return encoder.outputs(); }
};

struct AutoEncoderStats {
  double first_loss = 0.0;  ///< mean of the first hundredth of the steps
  double last_loss = 0.0;   ///< mean of the last hundredth
};

/// @param samples   [n, features], n ≥ 1
/// @param progress  called with the number of steps after every hundredth of them; may be empty
AutoEncoder train_autoencoder(const Matrix<float>& samples, const AutoEncoderConfig& config,
                              std::uint64_t seed, AutoEncoderStats* stats = nullptr,
                              const std::function<void(int steps)>& progress = {});

/// z = E(x) [n, code]; decoded = D(z) [n, features], in the units of x.
void encode(const AutoEncoder& coder, const Matrix<float>& x, Matrix<float>& code, Matrix<float>& decoded);

void save(Npz& archive, const std::string& prefix, const AutoEncoder& coder);
/// @throws DataError naming archive and key
AutoEncoder load_autoencoder(const Npz& archive, const std::string& prefix);

}  // namespace mimicx::nn
