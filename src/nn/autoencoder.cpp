#include "nn/autoencoder.h"

#include <algorithm>
#include <array>
#include <limits>

#include "nn/checkpoint.h"
#include "nn/parameter_training.h"

namespace mimicx::nn {
namespace {

enum RandomPurpose : std::uint64_t { kEncoderInit = 0x6101, kDecoderInit, kBatches };

constexpr double kNoGradientLimit = std::numeric_limits<double>::infinity();

}  // namespace

AutoEncoder train_autoencoder(const Matrix<float>& samples, const AutoEncoderConfig& config,
                              std::uint64_t seed, AutoEncoderStats* stats,
                              const std::function<void(int steps)>& progress) {
  const auto features = static_cast<int>(samples.cols());
  Random encoder_random(seed, {kEncoderInit}), decoder_random(seed, {kDecoderInit}), random(seed, {kBatches});
  AutoEncoder coder{make_normaliser<float>(features, 5.0F),
                    make_mlp<float>({features, config.hidden, config.code}, 1.0F, encoder_random),
                    make_mlp<float>({config.code, config.hidden, features}, 1.0F, decoder_random)};
  const Moments moments = moments_of(samples);
  update(coder.inputs, std::span<const Moments>(&moments, 1));
  Matrix<float> clean_samples;
  normalise(coder.inputs, samples, clean_samples);

  const std::array networks = {&coder.encoder, &coder.decoder};
  ParameterTraining training(parameters_of(networks), kNoGradientLimit);
  const std::size_t of_encoder = 2 * coder.encoder.weights.size();
  const std::size_t of_decoder = 2 * coder.decoder.weights.size();
  Matrix<float> clean(config.minibatch, features), corrupted(config.minibatch, features);
  const int window = std::max(1, config.steps / 100);
  double first = 0.0, last = 0.0;
  for (int step = 0; step < config.steps; ++step) {
    for (Eigen::Index row = 0; row < clean.rows(); ++row) {
      clean.row(row) = clean_samples.row(
          static_cast<Eigen::Index>(random.below(static_cast<std::uint32_t>(samples.rows()))));
      for (Eigen::Index k = 0; k < features; ++k)
        corrupted(row, k) = clean(row, k) + static_cast<float>(config.corruption * random.normal());
    }
    Tape<float>& tape = training.start();
    const Var code = forward(tape, coder.encoder, training.nodes(0, of_encoder), tape.refer(corrupted));
    const Var decoded = forward(tape, coder.decoder, training.nodes(of_encoder, of_decoder), code);
    const Var loss = mean(tape, square(tape, sub(tape, decoded, tape.refer(clean))));
    const double value = training.descend(loss, falling_step_size(config.step_size, step, config.steps));
    if (step < window) first += value / window;
    if (step >= config.steps - window) last += value / window;
    if (progress && (step + 1) % window == 0) progress(step + 1);
  }
  if (stats != nullptr) *stats = {first, last};
  return coder;
}

void encode(const AutoEncoder& coder, const Matrix<float>& x, Matrix<float>& code, Matrix<float>& decoded) {
  Workspace<float> workspace;
  Matrix<float> normalised;
  normalise(coder.inputs, x, normalised);
  evaluate(coder.encoder, normalised, workspace, code);
  evaluate(coder.decoder, code, workspace, decoded);
  denormalise(coder.inputs, Matrix<float>(decoded), decoded);
}

void save(Npz& archive, const std::string& prefix, const AutoEncoder& coder) {
  save(archive, prefix + "inputs.", coder.inputs);
  save(archive, prefix + "encoder.", coder.encoder);
  save(archive, prefix + "decoder.", coder.decoder);
}

AutoEncoder load_autoencoder(const Npz& archive, const std::string& prefix) {
  return {load_normaliser<float>(archive, prefix + "inputs."), load_mlp<float>(archive, prefix + "encoder."),
          load_mlp<float>(archive, prefix + "decoder.")};
}

}  // namespace mimicx::nn
