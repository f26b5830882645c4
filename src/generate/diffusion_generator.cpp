#include "generate/diffusion_generator.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/elementary.h"
#include "core/error.h"
#include "nn/parameter_training.h"

namespace mimicx::generate {
namespace {

enum DiffusionStream : std::uint64_t { kDiffusionInit = 0x7101, kDiffusionBatches, kDiffusionSamples };

constexpr int kVelocities = 3;  ///< numbers of a frame that are changes themselves

/// What is diffused: numbers of the next frame, poses relative to the last frame.
void change_to(const float* last, const float* next, float* change) {
  for (int k = 0; k < kPoseNumbers; ++k) change[k] = k < kVelocities ? next[k] : next[k] - last[k];
}

nn::Matrix<float> changes_of(std::span<const LabelledMotion> motions) {
  nn::Matrix<float> changes = rows_of(motions);
  Eigen::Index first = 0;
  for (const LabelledMotion& motion : motions) {
    for (Eigen::Index t = 0; t < motion.numbers.rows(); ++t)
      change_to(motion.numbers.row(std::max<Eigen::Index>(t - 1, 0)).data(), motion.numbers.row(t).data(),
                changes.row(first + t).data());
    first += motion.numbers.rows();
  }
  return changes;
}

/// ᾱ of the cosine schedule: 1 at level 0, about 0 at the last.
std::vector<double> cosine_schedule(int levels) {
  constexpr double kOffset = 0.008;
  const auto at = [&](double share) {
    return square(cos((share + kOffset) / (1.0 + kOffset) * 0.5 * std::numbers::pi));
  };
  std::vector<double> kept;
  for (int level = 0; level <= levels; ++level)
    kept.push_back(std::max(at(static_cast<double>(level) / levels) / at(0.0), 1e-4));
  return kept;
}

}  // namespace

DiffusionGenerator::DiffusionGenerator(std::span<const LabelledMotion> motions, int labels,
                                       const DiffusionConfig& config, std::uint64_t seed)
    : labels_(labels),
      config_(config),
      seed_(seed),
      kept_(cosine_schedule(config.levels)),
      frames_(nn::normaliser_of(rows_of(motions))),
      changes_(nn::normaliser_of(changes_of(motions))),
      starts_(static_cast<std::size_t>(labels)) {
  require_learnable(motions, labels, kHistory + 1);
  Random random(seed, {kDiffusionInit});
  network_ = nn::make_mlp<float>({inputs(), config.hidden, config.hidden, kPoseNumbers}, 0.1F, random);
  for (const LabelledMotion& motion : motions)
    starts_[static_cast<std::size_t>(motion.label)].push_back(
        {static_cast<int>(motion.numbers.rows()), motion.numbers.topRows(kHistory)});
  train(motions);
}

int DiffusionGenerator::inputs() const {
  return kPoseNumbers * (1 + kHistory) + condition_numbers(labels_) + config_.levels;
}

void DiffusionGenerator::write_input(const nn::Matrix<float>& last, int label, double share, int frames,
                                     int level, float* row) const {
  float* next = row + kPoseNumbers;
  for (Eigen::Index t = 0; t < kHistory; ++t)
    for (Eigen::Index k = 0; k < kPoseNumbers; ++k)
      *next++ = std::clamp((last(t, k) - frames_.shift(0, k)) * frames_.factor(0, k), -10.0F, 10.0F);
  write_condition(label, labels_, share, frames, next);
  next += condition_numbers(labels_);
  std::fill(next, next + config_.levels, 0.0F);
  next[level - 1] = 1.0F;
}

void DiffusionGenerator::train(std::span<const LabelledMotion> motions) {
  std::vector<std::array<int, 2>> frames;  // motion, number of the next frame
  for (std::size_t i = 0; i < motions.size(); ++i)
    for (int t = kHistory; t < motions[i].numbers.rows(); ++t) frames.push_back({static_cast<int>(i), t});
  Random random(seed_, {kDiffusionBatches});
  nn::ParameterTraining training(nn::parameters(network_));
  nn::Matrix<float> input(config_.minibatch, inputs()), target(config_.minibatch, kPoseNumbers);
  nn::Matrix<float> last(kHistory, kPoseNumbers), next(1, kPoseNumbers);
  const int window = std::max(1, config_.steps / 100);
  for (int step = 0; step < config_.steps; ++step) {
    for (Eigen::Index row = 0; row < config_.minibatch; ++row) {
      const auto [i, t] = frames[random.below(static_cast<std::uint32_t>(frames.size()))];
      const LabelledMotion& motion = motions[static_cast<std::size_t>(i)];
      const auto length = static_cast<int>(motion.numbers.rows());
      last = motion.numbers.middleRows(t - kHistory, kHistory);
      next = motion.numbers.row(t);
      const double spread = random.uniform(0.0, config_.offset);
      for (Eigen::Index k = 0; k < kPoseNumbers; ++k) {
        const double offset = k < kVelocities ? 0.0 : spread * random.normal() / double{frames_.factor(0, k)};
        next(0, k) += static_cast<float>((1.0 - config_.restored) * offset);
        for (Eigen::Index at = 0; at < kHistory; ++at)
          last(at, k) += static_cast<float>(offset + config_.disturbance * random.normal() /
                                                         double{changes_.factor(0, k)});
      }
      const int level = 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(config_.levels)));
      write_input(last, motion.label, static_cast<double>(t) / length, length, level, &input(row, 0));
      change_to(&last(kHistory - 1, 0), next.data(), &target(row, 0));
      const auto signal = static_cast<float>(std::sqrt(kept_[static_cast<std::size_t>(level)]));
      const auto noise = static_cast<float>(std::sqrt(1.0 - kept_[static_cast<std::size_t>(level)]));
      for (Eigen::Index k = 0; k < kPoseNumbers; ++k) {
        target(row, k) =
            std::clamp((target(row, k) - changes_.shift(0, k)) * changes_.factor(0, k), -10.0F, 10.0F);
        input(row, k) = signal * target(row, k) + noise * static_cast<float>(random.normal());
      }
    }
    nn::Tape<float>& tape = training.start();
    const nn::Var guess =
        nn::forward(tape, network_, training.nodes(0, 2 * network_.weights.size()), tape.refer(input));
    const nn::Var loss = nn::mean(tape, nn::square(tape, nn::sub(tape, guess, tape.refer(target))));
    const double value =
        training.descend(loss, nn::falling_step_size(config_.step_size, step, config_.steps));
    if (step >= config_.steps - window) last_loss_ += value / window;
  }
}

std::vector<nn::Matrix<float>> DiffusionGenerator::generate(int label, int count) const {
  const auto& starts = starts_.at(static_cast<std::size_t>(label));
  if (starts.empty()) raise(std::invalid_argument("generate: no motion of the training set has this label"));
  std::vector<nn::Matrix<float>> made;
  nn::Workspace<float> workspace;
  nn::Matrix<float> input(1, inputs()), clean, last(kHistory, kPoseNumbers);
  for (int number = 0; number < count; ++number) {
    Random random(seed_,
                  {kDiffusionSamples, static_cast<std::uint64_t>(label), static_cast<std::uint64_t>(number)});
    const Start& start = starts[random.below(static_cast<std::uint32_t>(starts.size()))];
    const int frames = start.frames;
    nn::Matrix<float> motion(frames, kPoseNumbers);
    motion.topRows(kHistory) = start.numbers;
    for (int t = kHistory; t < frames; ++t) {
      last = motion.middleRows(t - kHistory, kHistory);
      for (Eigen::Index k = 0; k < kPoseNumbers; ++k) input(0, k) = static_cast<float>(random.normal());
      for (int level = config_.levels; level >= 1; --level) {
        write_input(last, label, static_cast<double>(t) / frames, frames, level, input.data());
        nn::evaluate(network_, input, workspace, clean);
        // Ho et al., Eq. 7: the change one level down, given this one and the clean one.
        const double here = kept_[static_cast<std::size_t>(level)];
        const double below = kept_[static_cast<std::size_t>(level - 1)];
        const double beta = 1.0 - here / below;
        const double of_clean = std::sqrt(below) * beta / (1.0 - here);
        const double of_noisy = std::sqrt(1.0 - beta) * (1.0 - below) / (1.0 - here);
        const double deviation = std::sqrt(beta * (1.0 - below) / (1.0 - here));
        for (Eigen::Index k = 0; k < kPoseNumbers; ++k) {
          const double mean = of_clean * double{clean(0, k)} + of_noisy * double{input(0, k)};
          input(0, k) = static_cast<float>(level > 1 ? mean + deviation * random.normal() : mean);
        }
      }
      for (Eigen::Index k = 0; k < kPoseNumbers; ++k) {
        const float change = input(0, k) / changes_.factor(0, k) + changes_.shift(0, k);
        motion(t, k) = k < kVelocities ? change : last(kHistory - 1, k) + change;
      }
    }
    made.push_back(std::move(motion));
  }
  return made;
}

}  // namespace mimicx::generate
