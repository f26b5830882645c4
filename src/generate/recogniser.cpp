#include "generate/recogniser.h"

#include <algorithm>

#include "core/decompositions.h"
#include "core/units.h"
#include "nn/parameter_training.h"

namespace mimicx::generate {
namespace {

enum RecogniserStream : std::uint64_t { kRecogniserInit = 0x7108, kRecogniserBatches };

constexpr Eigen::Index kChangeFrames = 10;  ///< a third of a second: slower than trembling

/// [motions, 3 · kPoseNumbers] means, deviations, deviations of the changes over kChangeFrames.
nn::Matrix<float> summaries_of(std::span<const LabelledMotion> motions) {
  nn::Matrix<float> all(static_cast<Eigen::Index>(motions.size()), 3 * kPoseNumbers);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const nn::Matrix<float>& x = motions[i].numbers;
    const Eigen::Index last = std::max<Eigen::Index>(x.rows() - kChangeFrames, 1);
    const nn::Matrix<float> changes = x.bottomRows(last) - x.topRows(last);
    const nn::Moments of_x = nn::moments_of(x), of_changes = nn::moments_of(changes);
    auto row = all.row(static_cast<Eigen::Index>(i));
    row.segment(0, kPoseNumbers) = of_x.mean.cast<float>();
    row.segment(kPoseNumbers, kPoseNumbers) = (of_x.squares / of_x.count).cwiseSqrt().cast<float>();
    row.segment(2 * kPoseNumbers, kPoseNumbers) =
        (of_changes.squares / of_changes.count).cwiseSqrt().cast<float>();
  }
  return all;
}

/// What a summary says of a pose's number is scaled by its deviation over exact motions, but at least by
/// this: 1° of a rotation, 5 mm of height, 1 mm and 0.001 rad of the way and the turn in a frame. Wrists and
/// collars of exact motions hardly move; by their own deviations, errors that nobody sees would count as much
/// as another motion.
float least_deviation(Eigen::Index number) {
  if (number < 3) return 0.001F;
  return number == 3 ? 0.005F : static_cast<float>(kDegree);
}

struct Gaussian {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Gaussian gaussian_of(const nn::Matrix<float>& rows) {
  const Eigen::MatrixXd x = rows.cast<double>();
  const Eigen::VectorXd mean = x.colwise().mean();
  const Eigen::MatrixXd centred = x.rowwise() - mean.transpose();
  return {mean, centred.transpose() * centred / static_cast<double>(rows.rows() - 1)};
}

/// Square root of a symmetric matrix without negative eigenvalues; those of rounding count as 0.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& symmetric) {
  const auto [values, vectors] = symmetric_eigen(symmetric);
  return vectors * values.cwiseMax(0.0).cwiseSqrt().asDiagonal() * vectors.transpose();
}

}  // namespace

double frechet_distance(const nn::Matrix<float>& a, const nn::Matrix<float>& b) {
  const Gaussian first = gaussian_of(a), second = gaussian_of(b);
  const Eigen::MatrixXd root = root_of(first.covariance);
  return (first.mean - second.mean).squaredNorm() + first.covariance.trace() + second.covariance.trace() -
         2.0 * root_of(root * second.covariance * root).trace();
}

Recogniser::Recogniser(std::span<const LabelledMotion> truth, int labels, const RecogniserConfig& config,
                       std::uint64_t seed)
    : labels_(labels, config.vector_size) {
  const nn::Matrix<float> summaries = summaries_of(truth);
  summaries_ = nn::normaliser_of(summaries, 3.0F);
  for (Eigen::Index k = 0; k < summaries.cols(); ++k) {
    float& factor = summaries_.factor(0, k);
    factor = std::min(factor, 1.0F / least_deviation(k % kPoseNumbers));
  }
  nn::Matrix<float> normal;
  nn::normalise(summaries_, summaries, normal);

  Random init(seed, {kRecogniserInit}), random(seed, {kRecogniserBatches});
  network_ = nn::make_mlp<float>({3 * kPoseNumbers, config.hidden, config.vector_size}, 1.0F, init);
  for (Eigen::Index i = 0; i < labels_.size(); ++i) labels_.data()[i] = static_cast<float>(init.normal());
  std::vector<nn::Matrix<float>*> all = nn::parameters(network_);
  all.push_back(&labels_);
  nn::ParameterTraining training(all);
  nn::Matrix<float> input(config.minibatch, normal.cols()), target(config.minibatch, labels);
  for (int step = 0; step < config.steps; ++step) {
    target.setZero();
    for (Eigen::Index row = 0; row < input.rows(); ++row) {
      const std::uint32_t i = random.below(static_cast<std::uint32_t>(truth.size()));
      target(row, truth[i].label) = 1.0F;
      for (Eigen::Index k = 0; k < input.cols(); ++k)
        input(row, k) = normal(i, k) + static_cast<float>(config.noise * random.normal());
    }
    nn::Tape<float>& tape = training.start();
    const nn::Var vectors = nn::forward(tape, network_, training.nodes(0, all.size() - 1), tape.refer(input));
    const nn::Var centres = training.nodes(all.size() - 1, 1)[0];
    // −‖v − c‖² but for ‖v‖², which all labels share: 2 v·c − ‖c‖².
    const nn::Var squares =
        nn::matmul(tape, tape.constant(1, config.vector_size, 1.0F), nn::square(tape, centres), false, true);
    const nn::Var logits =
        nn::sub(tape, nn::scale(tape, nn::matmul(tape, vectors, centres, false, true), 2.0F),
                nn::broadcast(tape, squares, config.minibatch, labels));
    training.descend(nn::softmax_cross_entropy(tape, logits, tape.refer(target)),
                     nn::falling_step_size(config.step_size, step, config.steps));
  }
}

nn::Matrix<float> Recogniser::vectors(std::span<const LabelledMotion> motions) const {
  nn::Matrix<float> normal, result;
  nn::normalise(summaries_, summaries_of(motions), normal);
  nn::Workspace<float> workspace;
  nn::evaluate(network_, normal, workspace, result);
  return result;
}

GenerationScores Recogniser::scores(std::span<const LabelledMotion> motions,
                                    std::span<const LabelledMotion> test) const {
  GenerationScores scores;
  const nn::Matrix<float> found = vectors(motions);
  const double count = static_cast<double>(motions.size());
  for (Eigen::Index i = 0; i < found.rows(); ++i) {
    const Eigen::VectorXf distances = (labels_.rowwise() - found.row(i)).rowwise().norm();
    const float own = distances[motions[static_cast<std::size_t>(i)].label];
    const auto nearer = (distances.array() < own).count();
    for (int k = 0; k < 3; ++k) scores.precision[k] += nearer <= k ? 1.0 : 0.0;
    scores.multimodal_distance += double{own} / count;
    for (Eigen::Index j = 0; j < i; ++j)
      scores.diversity += double{(found.row(i) - found.row(j)).norm()} / (0.5 * count * (count - 1.0));
  }
  for (double& precision : scores.precision) precision /= count;
  scores.fid = frechet_distance(found, vectors(test));
  return scores;
}

}  // namespace mimicx::generate
