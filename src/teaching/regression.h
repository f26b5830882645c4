/// Regression of a policy onto lessons: gradient steps on minibatches.
///
///     L = ½ · mean (μ(s) − u)ᵀ W_t (μ(s) − u)
///
/// μ is the actor's mean action, u the teacher's action, W_t the cost of a control error at that frame
/// (Teacher::importance), so that harmless errors count little. The bytes do not depend on the number of
/// threads: a minibatch is cut into slots, whose gradients are added in order.
#pragma once

#include <optional>
#include <span>

#include "control/plan_control.h"
#include "nn/adam.h"
#include "nn/tape.h"
#include "teaching/lessons.h"

namespace mimicx::teaching {

struct RegressionConfig {
  int minibatch = 256;         ///< rows
  int slots = 2;               ///< parts of a minibatch whose gradients are computed in parallel
  double gradient_norm = 5.0;  ///< limit of the gradient's norm
};

/// Buffers of one slot; their contents are valid for one step.
struct RegressionSlot {
  nn::Tape<float> tape;
  nn::Matrix<float> states, normalised, actions, pull;  ///< [rows × dim]
  std::vector<nn::Matrix<float>> gradient;
  double loss = 0.0;
};

struct RegressionScratch {
  List<RegressionSlot> slots;
};

/// A policy that learns from lessons.
struct PolicyInTraining {
  rl::Agent agent;
  nn::Adam<float> adam;  ///< of the actor
};
/// Its mean actions are near zero.
PolicyInTraining untrained_policy(int state_size, const std::vector<int>& hidden, std::uint64_t seed);

/// What a policy regresses onto. Refers to its parts.
struct WeighedLessons {
  const Lessons& lessons;
  const List<Eigen::MatrixXf>& importance;  ///< W_t, by `weighed_by` of the lessons
};

/// One step of Adam.
struct RegressionStep {
  std::span<const int> rows;  ///< of the lessons
  double step_size;
};
/// @return L before the step
double regression_step(const WeighedLessons& data, const RegressionStep& step, const RegressionConfig& config,
                       int threads, PolicyInTraining& policy, RegressionScratch& scratch);

/// The gradient steps of one round, each on random rows.
struct RegressionRound {
  int round, rounds;  ///< its number, and how many there are
  int steps;
  double step_size, last_step_size;  ///< falls with the square of what is left of the rounds
};
/// @return the mean of L over the steps; none where it was told to stop
std::optional<double> regression_round(const WeighedLessons& data, const RegressionRound& round,
                                       const RegressionConfig& config, const control::PlanControl& control,
                                       Random& random, PolicyInTraining& policy);

}  // namespace mimicx::teaching
