/// The terms of PPO's loss on a tape. All are sums over rows: the caller divides by the rows of the
/// minibatch, so that parts of a minibatch add up.
///
/// Sources: [S] Schulman et al., "Proximal policy optimization algorithms", 2017; [C] Chen et al., "Learning
/// smooth humanoid locomotion through Lipschitz-constrained policies", 2024. S is float or double.
#pragma once

#include "nn/mlp.h"

namespace mimicx::rl {

/// log π(a|s) without its constant: −‖a − μ‖²/2σ².  means, actions [n × action_dim] → [n × 1]
template <class S>
nn::Var log_density(nn::Tape<S>& tape, nn::Var means, nn::Var actions, S sigma);

/// −Σ min(ρ·A, clip(ρ, 1 ± ε)·A) with ρ = exp(log π − log π_old) [S, Eq. 7].
/// The logarithm of ρ is limited to ± 20 first, where the exponential is still finite. All [n × 1] → [1 × 1].
template <class S>
nn::Var surrogate_loss(nn::Tape<S>& tape, nn::Var log_density, nn::Var old_log_density, nn::Var advantages,
                       S clip);

/// σ² · Σ ‖∇_s log π(a|s)‖² [C, Eq. 6], scaled as in docs/method.md §7, (1): by its identity for Gaussians
/// the expectation is Σ_i ‖∇μ_i‖² whatever σ is.
/// @param parameters    of the actor on this tape  @param observations  [n × observation_dim], normalised
template <class S>
nn::Var gradient_penalty(nn::Tape<S>& tape, const nn::Mlp<S>& actor, std::span<const nn::Var> parameters,
                         nn::Var observations, nn::Var actions, S sigma);

/// ½ Σ (v − target)².
template <class S>
nn::Var value_loss(nn::Tape<S>& tape, nn::Var values, nn::Var targets);

}  // namespace mimicx::rl
