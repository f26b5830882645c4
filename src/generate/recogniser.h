/// Recognises what a motion shows, and scores generated motions by it.
///
/// A perceptron maps a summary of a motion (mean and deviation of every number, deviation of its change over
/// a third of a second; each in units of its deviation over exact motions, or of 1° or 5 mm if that is less)
/// to a vector; every label has a vector, too. It is trained, by softmax over the negative squared
/// distances, to map motions near the vector of their label. Labels replace the paper's texts; a label's
/// vector replaces the text's embedding. Source of the scores: Guo et al., "Generating diverse and natural
/// 3D human motions from text", CVPR 2022; Heusel et al., NeurIPS 2017 (FID).
///
/// Deviation: R-precision ranks all labels once instead of 32 texts drawn at random; diversity is the mean
/// over all pairs of motions instead of 300 random ones.
#pragma once

#include <cstdint>
#include <span>

#include "generate/pose_numbers.h"
#include "nn/mlp.h"
#include "nn/normaliser.h"

namespace mimicx::generate {

struct RecogniserConfig {
  int hidden = 128;
  int vector_size = 16;
  int steps = 1500;         ///< minibatches
  int minibatch = 64;       ///< motions
  double step_size = 2e-3;  ///< Adam's at the start; falls linearly to a tenth
  double noise = 1.0;       ///< σ of the noise on the normalised summary in training
};

/// Scores of generated motions.
struct GenerationScores {
  double precision[3] = {};  ///< share whose label's vector is the nearest, among the 2, the 3 nearest
  double fid = 0.0;          ///< Fréchet distance of the motions' vectors from those of true motions
  double multimodal_distance = 0.0;  ///< mean distance from the label's vector
  double diversity = 0.0;            ///< mean distance of two motions' vectors
};

class Recogniser {
 public:
  /// @param truth  exact motions of labels 0 … labels − 1
  Recogniser(std::span<const LabelledMotion> truth, int labels, const RecogniserConfig& config,
             std::uint64_t seed);

  /// [motions, vector_size]
  nn::Matrix<float> vectors(std::span<const LabelledMotion> motions) const;
  /// @param test  exact motions that had no part in the training
  GenerationScores scores(std::span<const LabelledMotion> motions,
                          std::span<const LabelledMotion> test) const;

 private:
  nn::Normaliser<float> summaries_;
  nn::Mlp<float> network_;
  nn::Matrix<float> labels_;  ///< [labels, vector_size]
};

/// Fréchet distance of two normal distributions with the mean and covariance of the rows:
/// ‖m₁ − m₂‖² + tr(C₁ + C₂ − 2 (C₁ C₂)^½). At least two rows each.
double frechet_distance(const nn::Matrix<float>& a, const nn::Matrix<float>& b);

}  // namespace mimicx::generate
