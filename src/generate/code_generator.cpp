#include "generate/code_generator.h"

#include <algorithm>
#include <stdexcept>

#include "core/error.h"
#include "nn/elementwise.h"
#include "nn/gemm.h"
#include "nn/parameter_training.h"

namespace mimicx::generate {
namespace {

enum CodeStream : std::uint64_t { kCodeInit = 0x7104, kCodeBatches, kPredictorBatches, kCodeSamples };

constexpr double kFewVectors = 0.03;  ///< running number of vectors under which an entry is given up

int drawn(Random& random, std::size_t n) {
  return static_cast<int>(random.below(static_cast<std::uint32_t>(n)));
}

/// Index of a code drawn by the softmax of the logits.
int drawn_code(Random& random, const nn::Matrix<float>& logits) {
  const float most = logits.maxCoeff();
  std::vector<double> below;
  double total = 0.0;
  for (Eigen::Index k = 0; k < logits.size(); ++k)
    below.push_back(total += double{nn::exp_value(logits(0, k) - most)});
  const double mark = random.uniform() * total;
  const auto found = std::upper_bound(below.begin(), below.end(), mark) - below.begin();
  return static_cast<int>(std::min<std::ptrdiff_t>(found, logits.size() - 1));
}

}  // namespace

CodeBook::CodeBook(const nn::Matrix<float>& vectors, int codes, Random& random)
    : entries_(codes, vectors.cols()), counts_(static_cast<std::size_t>(codes), 1.0) {
  for (Eigen::Index k = 0; k < codes; ++k)
    entries_.row(k) = vectors.row(drawn(random, static_cast<std::size_t>(vectors.rows())));
  sums_ = entries_;
}

std::vector<int> CodeBook::nearest(const nn::Matrix<float>& vectors) const {
  nn::Matrix<float> products(vectors.rows(), entries_.rows());
  nn::gemm<float>(false, true, vectors, entries_, nullptr, products);
  const Eigen::RowVectorXf squares = entries_.rowwise().squaredNorm().transpose();
  std::vector<int> result;
  for (Eigen::Index row = 0; row < vectors.rows(); ++row) {
    Eigen::Index least = 0;
    for (Eigen::Index k = 1; k < entries_.rows(); ++k)
      if (squares[k] - 2.0F * products(row, k) < squares[least] - 2.0F * products(row, least)) least = k;
    result.push_back(static_cast<int>(least));
  }
  return result;
}

void CodeBook::follow(const nn::Matrix<float>& vectors, const std::vector<int>& nearest, double memory,
                      Random& random) {
  const auto kept = static_cast<float>(memory);
  for (double& count : counts_) count *= memory;
  sums_ *= kept;
  for (Eigen::Index row = 0; row < vectors.rows(); ++row) {
    const int k = nearest[static_cast<std::size_t>(row)];
    counts_[static_cast<std::size_t>(k)] += 1.0 - memory;
    sums_.row(k) += (1.0F - kept) * vectors.row(row);
  }
  for (Eigen::Index k = 0; k < entries_.rows(); ++k) {
    double& count = counts_[static_cast<std::size_t>(k)];
    if (count < kFewVectors) {
      count = 1.0;
      sums_.row(k) = vectors.row(drawn(random, static_cast<std::size_t>(vectors.rows())));
    }
    entries_.row(k) = sums_.row(k) / static_cast<float>(count);
  }
}

CodeGenerator::CodeGenerator(std::span<const LabelledMotion> motions, int labels, const CodeConfig& config,
                             std::uint64_t seed)
    : labels_(labels),
      config_(config),
      seed_(seed),
      frames_(nn::normaliser_of(rows_of(motions))),
      lengths_(static_cast<std::size_t>(labels)) {
  require_learnable(motions, labels, kPiece);
  std::vector<nn::Matrix<float>> pieces;
  Eigen::Index count = 0;
  for (const LabelledMotion& motion : motions) {
    lengths_[static_cast<std::size_t>(motion.label)].push_back(static_cast<int>(motion.numbers.rows()));
    pieces.push_back(pieces_of(motion.numbers));
    count += pieces.back().rows();
  }
  nn::Matrix<float> all(count, kPiece * kPoseNumbers);
  count = 0;
  for (const nn::Matrix<float>& some : pieces) {
    all.middleRows(count, some.rows()) = some;
    count += some.rows();
  }
  train_coder(all);
  train_predictor(motions);
}

/// [pieces, kPiece · kPoseNumbers], normalised, a piece every kStride frames.
nn::Matrix<float> CodeGenerator::pieces_of(const nn::Matrix<float>& numbers) const {
  nn::Matrix<float> normal;
  nn::normalise(frames_, numbers, normal);
  nn::Matrix<float> pieces((normal.rows() - kPiece) / kStride + 1, kPiece * kPoseNumbers);
  for (Eigen::Index k = 0; k < pieces.rows(); ++k)
    pieces.row(k) =
        Eigen::Map<const Eigen::RowVectorXf>(normal.data() + k * kStride * kPoseNumbers, pieces.cols());
  return pieces;
}

void CodeGenerator::train_coder(const nn::Matrix<float>& pieces) {
  Random init(seed_, {kCodeInit}), random(seed_, {kCodeBatches});
  const int numbers = kPiece * kPoseNumbers;
  encoder_ = nn::make_mlp<float>({numbers, config_.hidden, config_.code_size}, 1.0F, init);
  decoder_ = nn::make_mlp<float>({config_.code_size, config_.hidden, config_.hidden, numbers}, 1.0F, init);
  const std::array networks = {&encoder_, &decoder_};
  nn::ParameterTraining training(nn::parameters_of(networks));
  const std::size_t of_encoder = 2 * encoder_.weights.size(), of_decoder = 2 * decoder_.weights.size();
  nn::Matrix<float> batch(config_.minibatch, numbers);
  const int window = std::max(1, config_.coder_steps / 100);
  for (int step = 0; step < config_.coder_steps; ++step) {
    for (Eigen::Index row = 0; row < batch.rows(); ++row)
      batch.row(row) = pieces.row(drawn(random, static_cast<std::size_t>(pieces.rows())));
    nn::Tape<float>& tape = training.start();
    const nn::Var input = tape.refer(batch);
    const nn::Var vectors = nn::forward(tape, encoder_, training.nodes(0, of_encoder), input);
    const nn::Matrix<float> values = tape.value(vectors);
    if (step == 0) book_ = CodeBook(values, config_.codes, random);
    const std::vector<int> nearest = book_.nearest(values);
    nn::Matrix<float> entries(values.rows(), values.cols());
    for (Eigen::Index row = 0; row < entries.rows(); ++row)
      entries.row(row) = book_.entries().row(nearest[static_cast<std::size_t>(row)]);
    // The entries' value with the gradient of the vectors.
    const nn::Var through = nn::add(tape, vectors, tape.constant(nn::Matrix<float>(entries - values)));
    const nn::Var guess = nn::forward(tape, decoder_, training.nodes(of_encoder, of_decoder), through);
    const nn::Var error = nn::mean(tape, nn::square(tape, nn::sub(tape, guess, input)));
    const nn::Var distance = nn::mean(tape, nn::square(tape, nn::sub(tape, vectors, tape.constant(entries))));
    const double value = double{tape.scalar(error)};
    training.descend(nn::add(tape, error, nn::scale(tape, distance, static_cast<float>(config_.commitment))),
                     nn::falling_step_size(config_.step_size, step, config_.coder_steps));
    book_.follow(values, nearest, config_.book_memory, random);
    if (step >= config_.coder_steps - window) coder_loss_ += value / window;
  }
}

std::vector<int> CodeGenerator::codes_of(const nn::Matrix<float>& numbers) const {
  nn::Workspace<float> workspace;
  nn::Matrix<float> vectors;
  nn::evaluate(encoder_, pieces_of(numbers), workspace, vectors);
  return book_.nearest(vectors);
}

nn::Matrix<float> CodeGenerator::motion_of(const std::vector<int>& codes) const {
  nn::Matrix<float> entries(static_cast<Eigen::Index>(codes.size()), config_.code_size), pieces;
  for (Eigen::Index k = 0; k < entries.rows(); ++k)
    entries.row(k) = book_.entries().row(codes[static_cast<std::size_t>(k)]);
  nn::Workspace<float> workspace;
  nn::evaluate(decoder_, entries, workspace, pieces);
  const Eigen::Index frames = kStride * (pieces.rows() - 1) + kPiece;
  nn::Matrix<float> sums = nn::Matrix<float>::Zero(frames, kPoseNumbers), result;
  std::vector<float> weights(static_cast<std::size_t>(frames), 0.0F);
  for (Eigen::Index k = 0; k < pieces.rows(); ++k)
    for (Eigen::Index t = 0; t < kPiece; ++t) {
      const auto weight = static_cast<float>(std::min(t + 1, kPiece - t));  // a hat
      sums.row(k * kStride + t) += weight * pieces.row(k).segment(t * kPoseNumbers, kPoseNumbers);
      weights[static_cast<std::size_t>(k * kStride + t)] += weight;
    }
  for (Eigen::Index t = 0; t < frames; ++t) sums.row(t) /= weights[static_cast<std::size_t>(t)];
  nn::denormalise(frames_, sums, result);
  return result;
}

nn::Matrix<float> CodeGenerator::rebuilt(const nn::Matrix<float>& numbers) const {
  return motion_of(codes_of(numbers));
}

int CodeGenerator::predictor_inputs() const {
  return kHistory * (config_.code_size + 1) + condition_numbers(labels_);
}

void CodeGenerator::write_history(std::span<const int> codes, int k, int label, int frames,
                                  float* row) const {
  for (int at = k - kHistory; at < k; ++at) {
    *row++ = at < 0 ? 0.0F : 1.0F;
    for (Eigen::Index j = 0; j < config_.code_size; ++j)
      *row++ = at < 0 ? 0.0F : book_.entries()(codes[static_cast<std::size_t>(at)], j);
  }
  write_condition(label, labels_, static_cast<double>(k * kStride) / frames, frames, row);
}

void CodeGenerator::train_predictor(std::span<const LabelledMotion> motions) {
  std::vector<std::vector<int>> codes;
  std::vector<std::array<int, 2>> places;  // motion, number of the next code
  for (std::size_t i = 0; i < motions.size(); ++i) {
    codes.push_back(codes_of(motions[i].numbers));
    for (std::size_t k = 0; k < codes.back().size(); ++k)
      places.push_back({static_cast<int>(i), static_cast<int>(k)});
  }
  Random random(seed_, {kPredictorBatches});
  predictor_ =
      nn::make_mlp<float>({predictor_inputs(), config_.hidden, config_.hidden, config_.codes}, 0.1F, random);
  nn::ParameterTraining training(nn::parameters(predictor_));
  nn::Matrix<float> input(config_.minibatch, predictor_inputs()), target(config_.minibatch, config_.codes);
  const int window = std::max(1, config_.predictor_steps / 100);
  for (int step = 0; step < config_.predictor_steps; ++step) {
    target.setZero();
    for (Eigen::Index row = 0; row < config_.minibatch; ++row) {
      const auto [i, k] = places[static_cast<std::size_t>(drawn(random, places.size()))];
      const LabelledMotion& motion = motions[static_cast<std::size_t>(i)];
      std::vector<int> history = codes[static_cast<std::size_t>(i)];
      for (int at = std::max(0, k - kHistory); at < k; ++at)
        if (random.uniform() < config_.replaced)
          history[static_cast<std::size_t>(at)] = drawn(random, static_cast<std::size_t>(config_.codes));
      write_history(history, k, motion.label, static_cast<int>(motion.numbers.rows()), &input(row, 0));
      target(row, codes[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]) = 1.0F;
    }
    nn::Tape<float>& tape = training.start();
    const nn::Var logits =
        nn::forward(tape, predictor_, training.nodes(0, 2 * predictor_.weights.size()), tape.refer(input));
    const double value =
        training.descend(nn::softmax_cross_entropy(tape, logits, tape.refer(target)),
                         nn::falling_step_size(config_.step_size, step, config_.predictor_steps));
    if (step >= config_.predictor_steps - window) predictor_loss_ += value / window;
  }
}

std::vector<nn::Matrix<float>> CodeGenerator::generate(int label, int count) const {
  const auto& lengths = lengths_.at(static_cast<std::size_t>(label));
  if (lengths.empty()) raise(std::invalid_argument("generate: no motion of the training set has this label"));
  std::vector<nn::Matrix<float>> made;
  nn::Workspace<float> workspace;
  nn::Matrix<float> input(1, predictor_inputs()), logits;
  for (int number = 0; number < count; ++number) {
    Random random(seed_,
                  {kCodeSamples, static_cast<std::uint64_t>(label), static_cast<std::uint64_t>(number)});
    const int frames = lengths[static_cast<std::size_t>(drawn(random, lengths.size()))];
    std::vector<int> codes;
    for (int k = 0; k <= (frames - kPiece) / kStride; ++k) {
      write_history(codes, k, label, frames, input.data());
      nn::evaluate(predictor_, input, workspace, logits);
      codes.push_back(drawn_code(random, logits));
    }
    made.push_back(motion_of(codes));
  }
  return made;
}

}  // namespace mimicx::generate
