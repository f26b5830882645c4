/// Generator B: a code book of short pieces of motion, and a predictor of the next code.
///
/// An auto-encoder turns pieces of kPiece frames into vectors, of which each is replaced by the nearest one
/// of a code book (VQ-VAE). The predictor, a multi-layer perceptron with softmax, gives the probability of
/// the next code from the last codes and the condition (pose_numbers.h). A motion is made code by code;
/// pieces overlap by half and are blended. Sources: van den Oord, Vinyals, Kavukcuoglu, "Neural discrete
/// representation learning", NeurIPS 2017 (gradient passed straight through, code book by running means: its
/// appendix A.1); Zhang et al., "T2M-GPT", CVPR 2023 (codes that are not used are reset; codes of the history
/// are replaced at random in training).
///
/// Deviation: perceptrons instead of convolutions and of a transformer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generate/pose_numbers.h"
#include "nn/mlp.h"
#include "nn/normaliser.h"

namespace mimicx::generate {

struct CodeConfig {
  int hidden = 256;            ///< width of the hidden layers
  int codes = 512;             ///< entries of the book
  int code_size = 24;          ///< numbers of an entry
  int coder_steps = 6000;      ///< minibatches of the auto-encoder
  int predictor_steps = 6000;  ///< and of the predictor
  int minibatch = 256;         ///< pieces
  double step_size = 1e-3;     ///< Adam's at the start; falls linearly to a tenth
  double commitment = 0.25;    ///< weight of the distance of a vector from its entry
  double book_memory = 0.99;   ///< of the running means
  double replaced = 0.2;       ///< share of the history's codes that are replaced in training
};

/// Rows of a matrix, and the nearest of them.
class CodeBook {
 public:
  CodeBook() = default;
  /// The first entries are rows of `vectors`, chosen at random.
  CodeBook(const nn::Matrix<float>& vectors, int codes, Random& random);

  const nn::Matrix<float>& entries() const { return entries_; }
  /// [rows] index of the nearest entry; at a tie the first.
  std::vector<int> nearest(const nn::Matrix<float>& vectors) const;
  /// Moves every entry to the running mean of the vectors that are nearest to it. An entry that has hardly
  /// any becomes one of the vectors, at random.
  void follow(const nn::Matrix<float>& vectors, const std::vector<int>& nearest, double memory,
              Random& random);

 private:
  nn::Matrix<float> entries_;   ///< [codes, size]
  std::vector<double> counts_;  ///< [codes] running number of vectors per call
  nn::Matrix<float> sums_;      ///< [codes, size] running sums of them
};

class CodeGenerator {
 public:
  /// @param motions  of labels 0 … labels − 1, of at least kPiece frames each
  /// @throws std::invalid_argument for others
  CodeGenerator(std::span<const LabelledMotion> motions, int labels, const CodeConfig& config,
                std::uint64_t seed);

  /// Motions of one label. The first ones are the same for every count.
  /// @throws std::invalid_argument for a label that no motion of the training set shows
  std::vector<nn::Matrix<float>> generate(int label, int count) const;

  /// The motion as its codes say it; up to kStride − 1 frames shorter.
  nn::Matrix<float> rebuilt(const nn::Matrix<float>& numbers) const;

  double coder_loss() const { return coder_loss_; }          ///< mean squared error, in the end
  double predictor_loss() const { return predictor_loss_; }  ///< cross-entropy, nats, in the end

 private:
  static constexpr int kPiece = 16;  ///< frames
  static constexpr int kStride = 4;
  static constexpr int kHistory = 4;  ///< codes that the predictor sees

  std::vector<int> codes_of(const nn::Matrix<float>& numbers) const;
  nn::Matrix<float> motion_of(const std::vector<int>& codes) const;
  nn::Matrix<float> pieces_of(const nn::Matrix<float>& numbers) const;
  void train_coder(const nn::Matrix<float>& pieces);
  void train_predictor(std::span<const LabelledMotion> motions);
  int predictor_inputs() const;
  /// The last codes before number k, and the condition. @param row [predictor_inputs()]
  void write_history(std::span<const int> codes, int k, int label, int frames, float* row) const;

  int labels_;
  CodeConfig config_;
  std::uint64_t seed_;
  nn::Normaliser<float> frames_;
  nn::Mlp<float> encoder_, decoder_, predictor_;
  CodeBook book_;
  std::vector<std::vector<int>> lengths_;  ///< [label] frames of the motions of the training set
  double coder_loss_ = 0.0, predictor_loss_ = 0.0;
};

}  // namespace mimicx::generate
