/// The environment concept of the learner: independent groups of characters.
///
/// A roll-out runs groups in parallel, without barriers between time steps, so `observe`, `actor` and `step`
/// of different groups must be safe to call concurrently. Data shared between groups (failure statistics,
/// curricula) is collected per group and merged by `end_iteration`, which runs alone. Large groups (64
/// characters and more) keep the policy's matrix products efficient.
///
/// Several agents may act in one environment: `agents` is their number, and `actor` is the agent that acts
/// for a character now. For a single agent these are 1 and 0.
///
/// Termination is a true end: no reward follows. Truncation is a time limit: the episode would have
/// continued, and the learner bootstraps with V of the observation from which it would have continued (Pardo
/// et al., "Time limits in reinforcement learning", ICML 2018). `step` resets a character whose episode
/// ended.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <string>
#include <vector>

#include "core/containers.h"
#include "core/npz/npz.h"
#include "nn/matrix.h"

namespace mimicx::rl {

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// Result of one step of one group; rows are characters.
struct StepResult {
  Eigen::ArrayXf reward;                 ///< [group_size]
  Flags terminated;                      ///< [group_size]; wins where both flags are set
  Flags truncated;                       ///< [group_size]
  nn::Matrix<float> final_observations;  ///< [group_size × observation_dim]; read if truncated
  List<int> final_actors;                ///< [group_size] the agent that would act there

  StepResult(int group_size, int observation_dim)
      : reward(Eigen::ArrayXf::Zero(group_size)),
        terminated(Flags::Constant(group_size, false)),
        truncated(Flags::Constant(group_size, false)),
        final_observations(nn::Matrix<float>::Zero(group_size, observation_dim)),
        final_actors(group_size, 0) {}
};

/// A character of an environment.
struct CharacterPlace {
  int group, character;
};

template <class World>
concept Environment = requires(World environment, const World& constant, int group, int character,
                               Eigen::Ref<nn::Matrix<float>> observations,
                               const Eigen::Ref<const nn::Matrix<float>>& actions, StepResult& result,
                               Npz& archive, const Npz& constant_archive, const std::string& prefix) {
  { constant.groups() } -> std::convertible_to<int>;
  { constant.group_size() } -> std::convertible_to<int>;
  { constant.observation_dim() } -> std::convertible_to<int>;
  { constant.action_dim() } -> std::convertible_to<int>;
  { constant.agents() } -> std::convertible_to<int>;
  { constant.actor(group, character) } -> std::convertible_to<int>;  // 0 … agents − 1: who acts now
  constant.observe(group, observations);                             // [group_size × observation_dim]
  environment.step(group, actions, result);  // [group_size × action_dim]; overwrites all of `result`
  // Runs alone, after every roll-out; returns the characters that it has reset to a new episode.
  { environment.end_iteration() } -> std::convertible_to<std::vector<CharacterPlace>>;
  constant.save(archive, prefix);  // the complete state, for an exact continuation
  environment.load(constant_archive, prefix);
};

}  // namespace mimicx::rl
