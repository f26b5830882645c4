/// What the learner asks of an environment: independent groups of characters.
///
/// A roll-out runs over groups in parallel and over time inside a group without any barrier, so `observe`,
/// `actor` and `step` of different groups must be safe to call at the same time; everything an environment
/// shares between groups (failure statistics, curricula) is gathered per group and merged by `end_iteration`,
/// which runs alone. Large groups (64 characters and more) keep the policy's matrix products efficient.
///
/// Several agents may act in one environment: it says how many there are, and which of them acts for a
/// character now. An environment of a single agent says 1 and 0.
///
/// Termination is a true end: nothing is earned after it. Truncation is a time limit: the episode would
/// have gone on, and the learner bootstraps with V of the observation it would have gone on from (Pardo et
/// al., "Time limits in reinforcement learning", ICML 2018). An ended character is reset inside `step`.
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

/// What one step of one group returns; rows are characters.
struct StepResult {
  Eigen::ArrayXf reward;                 ///< [group_size]
  Flags terminated;                      ///< [group_size]; wins where both flags are set
  Flags truncated;                       ///< [group_size]
  nn::Matrix<float> final_observations;  ///< [group_size × observation_dim]; a row is read where truncated
  List<int> final_actors;                ///< [group_size] the agent whose observation that is

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
  // Alone, after every roll-out; returns the characters that it has put at the start of a new episode.
  { environment.end_iteration() } -> std::convertible_to<std::vector<CharacterPlace>>;
  constant.save(archive, prefix);  // everything an exact continuation needs
  environment.load(constant_archive, prefix);
};

}  // namespace mimicx::rl
