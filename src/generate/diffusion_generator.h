/// Generator A: the next frame from the last four, by diffusion.
///
/// A multi-layer perceptron denoises the change from the last frame to the next one. It is told the four last
/// frames, the condition (pose_numbers.h) and the step of the diffusion. Frames are made one after the other.
/// In training the last frames have errors, noise and a constant one, so that what goes wrong is put right.
/// Sources: Ho, Jain, Abbeel, "Denoising diffusion probabilistic models", NeurIPS 2020, with the cosine
/// schedule of Nichol and Dhariwal, ICML 2021, and prediction of the clean sample; Shi et al., "Interactive
/// character control with auto-regressive motion diffusion models", SIGGRAPH 2024, for the arrangement.
///
/// What it does not do: a motion begins with the first four frames of a motion of the training set, and has
/// the length of that motion.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generate/pose_numbers.h"
#include "nn/mlp.h"
#include "nn/normaliser.h"

namespace mimicx::generate {

struct DiffusionConfig {
  int hidden = 384;          ///< width of the two hidden layers
  int levels = 12;           ///< steps of the diffusion
  int steps = 8000;          ///< minibatches
  int minibatch = 256;       ///< frames
  double step_size = 1e-3;   ///< Adam's at the start; falls linearly to a tenth
  double disturbance = 0.5;  ///< σ of the noise on the last frames, in deviations of the change
  double offset = 0.3;    ///< largest σ of a constant error of the last frames' poses, in their deviations
  double restored = 0.1;  ///< share of it that the next frame takes back
};

class DiffusionGenerator {
 public:
  /// @param motions  of labels 0 … labels − 1, of more than four frames each
  /// @throws std::invalid_argument for others
  DiffusionGenerator(std::span<const LabelledMotion> motions, int labels, const DiffusionConfig& config,
                     std::uint64_t seed);

  /// Motions of one label. The first ones are the same for every count.
  /// @throws std::invalid_argument for a label that no motion of the training set shows
  std::vector<nn::Matrix<float>> generate(int label, int count) const;

  double last_loss() const { return last_loss_; }  ///< mean of the last hundredth of the steps

 private:
  static constexpr int kHistory = 4;
  /// How a motion of the training set begins.
  struct Start {
    int frames;                 ///< of the whole motion
    nn::Matrix<float> numbers;  ///< [kHistory, kPoseNumbers]
  };
  int inputs() const;
  /// The input of the network but for the noisy change. @param row [inputs()]
  void write_input(const nn::Matrix<float>& last, int label, double share, int frames, int level,
                   float* row) const;
  void train(std::span<const LabelledMotion> motions);

  int labels_;
  DiffusionConfig config_;
  std::uint64_t seed_;
  std::vector<double> kept_;  ///< [levels + 1] ᾱ: share of the signal's variance
  nn::Normaliser<float> frames_, changes_;
  nn::Mlp<float> network_;
  std::vector<std::vector<Start>> starts_;  ///< [label]
  double last_loss_ = 0.0;
};

}  // namespace mimicx::generate
