/// The agent: a Gaussian policy, its critic, and the scales of observations and returns.
///
/// π(a|s) = N(μ(s), σ²·1): the mean depends on the state, the covariance is fixed and diagonal
/// (docs/method.md §7). Training lowers σ on a schedule, so it is an argument and no parameter. Because σ is
/// the same for the old and the new policy, the normalising constant of the density cancels in every ratio
/// and is left out: `log_density` is −‖a − μ‖²/2σ².
///
/// The critic predicts (V − mean)/deviation with mean and deviation of recent returns, so that one step size
/// suits every task. V changes with these two numbers: returns that grow or shrink as a whole need no
/// relearning. (Rewriting the last layer so that V is kept, van Hasselt et al. 2016, made the critic diverge
/// on a task whose returns shrink a hundredfold.)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/npz/npz.h"
#include "nn/mlp.h"
#include "nn/normaliser.h"

namespace mimicx::rl {

/// Purposes of the random streams of this folder: the first word of their keys.
enum RandomPurpose : std::uint64_t { kActorInit = 0x7201, kCriticInit, kActionNoise, kShuffle };

/// Running scale of the returns.
struct ReturnScale {
  double mean = 0.0;
  double square = 1.0;       ///< mean of the squared returns
  std::int64_t batches = 0;  ///< batches seen; 0: the identity

  /// Standard deviation, at least a tenth of the root mean square, so that constant returns have a scale,
  /// too.
  double deviation() const;
};

struct Agent {
  nn::Mlp<float> actor;   ///< normalised observation → mean action
  nn::Mlp<float> critic;  ///< normalised observation → scaled value
  nn::Normaliser<float> observations;
  ReturnScale returns;
};

/// Sizes of the networks. Actor and critic share nothing but their widths.
struct AgentShape {
  int observation_dim = 0;
  int action_dim = 0;
  std::vector<int> hidden;         ///< widths of the hidden layers; empty: a linear policy
  float last_scale = 0.02F;        ///< actor's last layer: the untrained policy acts near zero
  float observation_limit = 5.0F;  ///< normalised observations are clipped to ± this
};

Agent make_agent(const AgentShape& shape, std::uint64_t seed);

/// actions = means + σ·noise, and log_density [n] of each row. The noise comes from `random`, row by row.
void sample_actions(const nn::Matrix<float>& means, double sigma, Random& random, nn::Matrix<float>& actions,
                    Eigen::Ref<Eigen::VectorXf> log_density);

/// Scaled predictions [n × 1] → values V, in place.
void unscale_values(const ReturnScale& scale, nn::Matrix<float>& values);

/// Updates the scale with a batch of returns: the first batch replaces it, later ones are blended in at
/// `rate`.
/// @param mean, square  mean of the returns and of their squares over the batch
void follow_returns(ReturnScale& scale, double mean, double square, double rate);

void save(Npz& archive, const std::string& prefix, const Agent& agent);
/// @throws DataError naming archive and key
Agent load_agent(const Npz& archive, const std::string& prefix);

}  // namespace mimicx::rl
