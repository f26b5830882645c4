/// The configuration of PPO.
///
/// Sources: [S] Schulman et al., "Proximal policy optimization algorithms", 2017; [A] Andrychowicz et al.,
/// "What matters for on-policy deep actor-critic methods?", ICLR 2021; [R] Rudin et al., "Learning to walk in
/// minutes using massively parallel deep reinforcement learning", CoRL 2021; [C] Chen et al., "Learning
/// smooth humanoid locomotion through Lipschitz-constrained policies", 2024; the rest is docs/method.md §12
/// and the measurements of docs/experiments.md.
#pragma once

#include <cstdint>

namespace mimicx::rl {

/// There are no defaults: each training sets every member (src/program/configurations.h has the trainings
/// that people run).
struct PpoConfig {
  // Roll-out and returns.
  int horizon;    ///< steps of every character in one iteration
  double gamma;   ///< discount per step
  double lambda;  ///< of the advantage estimation

  // Exploration: σ falls linearly from start to end (`exploration_sigma`).
  double sigma_start;
  double sigma_end;

  // Update. Value losses are not clipped: clipping does not help [A]. There is no entropy bonus: it has no
  // effect for a fixed σ. Advantages are normalised over the whole iteration.
  int epochs;               ///< passes over the roll-out
  int minibatch;            ///< rows; an iteration is cut into the nearest number of equal minibatches
  double clip;              ///< the ratio is clipped to 1 ± clip [S, Eq. 7]
  double gradient_norm;     ///< limit of each network's gradient; the critic's loss is in scaled returns
  double critic_step_size;  ///< Adam's, constant: the critic's steps do not move the policy
  double return_rate;       ///< share of the new batch in the running scale of the returns

  // Step size of the actor: divided (multiplied) by `step_factor` after an iteration with a KL(old ‖ new) in
  // its last epoch above twice (under half) the target [R]. An iteration ends early if the KL of a minibatch
  // is above `kl_stop` times the target.
  double step_size;  ///< at the start
  double step_factor;
  double step_min;
  double step_max;
  double kl_target;
  double kl_stop;

  // Gradient penalty: weight · σ² · mean ‖∇_s log π(a|s)‖² on normalised observations [C]; for the σ² see
  // docs/method.md §7. A weight of 0 switches it off.
  double penalty_weight;
  double penalty_fraction;  ///< share of the rows on which it is evaluated

  // How the work is cut. The bits of the result depend on it; they do not depend on the number of threads.
  int gradient_slots;  ///< parts of a minibatch whose gradients are taken side by side
  int pass_rows;       ///< rows of one forward and backward pass
};

/// σ after `samples` samples: falls over the first `falling_samples`, then stays constant.
double exploration_sigma(const PpoConfig& config, std::int64_t falling_samples, std::int64_t samples);

/// The actor's next step size. @param kl  that the last step size led to
double adapted_step_size(const PpoConfig& config, double step_size, double kl);

}  // namespace mimicx::rl
