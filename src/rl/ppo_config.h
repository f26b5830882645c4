/// Everything PPO can be told, with its defaults.
///
/// Sources: [S] Schulman et al., "Proximal policy optimization algorithms", 2017; [A] Andrychowicz et al.,
/// "What matters for on-policy deep actor-critic methods?", ICLR 2021; [R] Rudin et al., "Learning to walk in
/// minutes using massively parallel deep reinforcement learning", CoRL 2021; [C] Chen et al., "Learning
/// smooth humanoid locomotion through Lipschitz-constrained policies", 2024; the rest is METHOD §12 and the
/// measurements of docs/experiments.md.
#pragma once

#include <cstdint>

namespace mimicx::rl {

struct PpoConfig {
  std::uint64_t seed = 1;  ///< of the networks, the action noise and the shuffles

  // Roll-out and returns.
  int horizon = 32;      ///< steps of every character in one iteration
  double gamma = 0.97;   ///< discount per step
  double lambda = 0.95;  ///< of the advantage estimation

  // Exploration: σ falls linearly from start to end while the first `sigma_samples` samples are drawn.
  double sigma_start = 0.07;
  double sigma_end = 0.04;
  std::int64_t sigma_samples = 2'000'000;

  // Update. Value losses are not clipped and there is no entropy bonus: the one does not help [A], the other
  // means nothing for a fixed σ. Advantages are normalised over the whole iteration.
  int epochs = 2;              ///< passes over the roll-out
  int minibatch = 4096;        ///< rows; an iteration is cut into the nearest number of equal minibatches
  double clip = 0.2;           ///< ratio stays in 1 ± clip [S, Eq. 7]
  double gradient_norm = 1.0;  ///< limit of each network's gradient; the critic's loss is in scaled returns
  double critic_step_size = 5e-4;  ///< Adam's, constant: the critic's steps do not move the policy
  double return_rate = 0.1;        ///< how fast the scale of the returns follows

  // Step size of the actor: divided (multiplied) by `step_factor` after an iteration whose last epoch saw a
  // KL(old ‖ new) above twice (under half) the target [R]; an iteration ends early where a minibatch finds
  // it above `kl_stop` times the target.
  double step_size = 5e-5;
  double step_factor = 1.5;
  double step_min = 1e-6;
  double step_max = 2e-3;
  double kl_target = 0.02;
  double kl_stop = 4.0;

  // Gradient penalty: weight · σ² · mean ‖∇_s log π(a|s)‖² on normalised observations [C]; the σ² is METHOD
  // §7. 0 switches it off. It is evaluated on this fraction of every minibatch.
  double penalty_weight = 0.0;
  double penalty_fraction = 0.125;

  // Means beyond ± mean_bound cost weight · Σ excess² and are counted as saturated.
  double bound_weight = 0.0;
  double mean_bound = 3.0;

  // Work division; part of the result's bits, unlike the number of threads.
  int gradient_slots = 4;  ///< parts of a minibatch whose gradients are taken side by side
  int pass_rows = 512;     ///< rows of one forward and backward pass
};

/// σ after that many samples.
double exploration_sigma(const PpoConfig& config, std::int64_t samples);

/// The actor's next step size, from the KL that the last one led to.
double adapted_step_size(const PpoConfig& config, double step_size, double kl);

}  // namespace mimicx::rl
