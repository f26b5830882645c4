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

/// The defaults train one motion from scratch. Where they come from: docs/method.md §12 and
/// docs/experiments.md. PPO for tracking takes many small iterations with a generous KL, and a discount that
/// looks 0.4 s ahead, because a pose error costs reward at once.
struct PpoConfig {
  // Roll-out and returns.
  int horizon = 16;     ///< steps of every character in one iteration
  double gamma = 0.92;  ///< discount per step
  double lambda = 0.9;  ///< of the advantage estimation

  // Exploration: σ falls linearly from start to end (`exploration_sigma`).
  double sigma_start = 0.07;
  double sigma_end = 0.04;

  // Update. Value losses are not clipped and there is no entropy bonus: the one does not help [A], the other
  // means nothing for a fixed σ. Advantages are normalised over the whole iteration.
  int epochs = 2;              ///< passes over the roll-out
  int minibatch = 1024;        ///< rows; an iteration is cut into the nearest number of equal minibatches
  double clip = 0.2;           ///< the ratio counts within 1 ± clip [S, Eq. 7]
  double gradient_norm = 1.0;  ///< limit of each network's gradient; the critic's loss is in scaled returns
  double critic_step_size = 5e-4;  ///< Adam's, constant: the critic's steps do not move the policy
  double return_rate = 0.1;        ///< share of the new batch in the running scale of the returns

  // Step size of the actor: divided (multiplied) by `step_factor` after an iteration whose last epoch saw a
  // KL(old ‖ new) above twice (under half) the target [R]; an iteration ends early where a minibatch finds
  // it above `kl_stop` times the target.
  double step_size = 1e-4;  ///< at the start
  double step_factor = 1.5;
  double step_min = 1e-6;
  double step_max = 2e-3;
  double kl_target = 0.06;
  double kl_stop = 4.0;

  // Gradient penalty: weight · σ² · mean ‖∇_s log π(a|s)‖² on normalised observations [C]; for the σ² see
  // docs/method.md §7. A weight of 0 switches it off.
  double penalty_weight = 0.0;
  double penalty_fraction = 0.125;  ///< share of every minibatch on which it is evaluated

  // How the work is cut. The bits of the result depend on it; they do not depend on the number of threads.
  int gradient_slots = 4;  ///< parts of a minibatch whose gradients are taken side by side
  int pass_rows = 256;     ///< rows of one forward and backward pass
};

/// core/setting.h.
void visit_settings(PpoConfig& p, const auto& visit) {
  visit("horizon", p.horizon, 1, 1e5, "steps of every character in one iteration");
  visit("gamma", p.gamma, 0, 1, "discount per step");
  visit("lambda", p.lambda, 0, 1, "lambda of the advantage estimation");
  visit("sigma_start", p.sigma_start, 1e-4, 10, "exploration noise at the start, rad");
  visit("sigma_end", p.sigma_end, 1e-4, 10, "exploration noise at the end, rad");
  visit("epochs", p.epochs, 1, 1e4, "passes over the roll-out of an iteration");
  visit("minibatch", p.minibatch, 1, 1e9, "rows of a minibatch");
  visit("clip", p.clip, 0, 1e9, "the probability ratio counts within 1 ± clip");
  visit("gradient_norm", p.gradient_norm, 0, 1e9, "limit of the norm of each network's gradient");
  visit("critic_step_size", p.critic_step_size, 0, 1e9, "Adam's step size of the critic, constant");
  visit("step_size", p.step_size, 0, 1e9, "Adam's step size of the actor, at the start");
  visit("step_min", p.step_min, 0, 1e9, "least step size of the actor");
  visit("step_max", p.step_max, 0, 1e9, "largest step size of the actor");
  visit("kl_target", p.kl_target, 0, 1e9, "KL per iteration at which the step size stays");
  visit("kl_stop", p.kl_stop, 0, 1e9, "times kl_target: a larger KL ends the iteration");
  visit("penalty_weight", p.penalty_weight, 0, 1e9, "weight of the gradient penalty; 0: none");
  visit("pass_rows", p.pass_rows, 1, 1e9, "rows of one forward and backward pass");
}

/// σ after `samples` samples: it falls while the first `falling_samples` are drawn and stays then.
double exploration_sigma(const PpoConfig& config, std::int64_t falling_samples, std::int64_t samples);

/// The actor's next step size. @param kl  that the last step size led to
double adapted_step_size(const PpoConfig& config, double step_size, double kl);

}  // namespace mimicx::rl
