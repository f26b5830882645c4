/// What the learner asks of an environment: independent groups of characters.
///
/// A roll-out runs over groups in parallel and over time inside a group without any barrier, so `observe`
/// and `step` of different groups must be safe to call at the same time; everything an environment shares
/// between groups (failure statistics, curricula) is gathered per group and merged by `end_iteration`,
/// which runs alone. Large groups (64 characters and more) keep the policy's matrix products efficient.
///
/// Termination is a true end: nothing is earned after it. Truncation is a time limit: the episode would
/// have gone on, and the learner bootstraps with V of the observation it would have gone on from (Pardo et
/// al., "Time limits in reinforcement learning", ICML 2018). An ended character is reset inside `step`.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <string>
#include <vector>

#include "core/npz.h"
#include "nn/matrix.h"

namespace mimicx::rl {

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// What one step of one group returns; rows are characters.
struct StepResult {
  Eigen::ArrayXf reward;                 ///< [group_size]
  Flags terminated;                      ///< [group_size]; wins where both flags are set
  Flags truncated;                       ///< [group_size]
  nn::Matrix<float> final_observations;  ///< [group_size × observation_dim]; a row is read where truncated
  std::vector<int> final_actors;         ///< [group_size] whose observation that is: 0 for a single agent

  StepResult(int group_size, int observation_dim)
      : reward(Eigen::ArrayXf::Zero(group_size)),
        terminated(Flags::Constant(group_size, false)),
        truncated(Flags::Constant(group_size, false)),
        final_observations(nn::Matrix<float>::Zero(group_size, observation_dim)),
        final_actors(static_cast<std::size_t>(group_size), 0) {}
};

template <class E>
concept Environment = requires(E environment, const E& constant, int group,
                               Eigen::Ref<nn::Matrix<float>> observations,
                               const Eigen::Ref<const nn::Matrix<float>>& actions, StepResult& result,
                               Npz& archive, const Npz& constant_archive, const std::string& prefix) {
  { constant.groups() } -> std::convertible_to<int>;
  { constant.group_size() } -> std::convertible_to<int>;
  { constant.observation_dim() } -> std::convertible_to<int>;
  { constant.action_dim() } -> std::convertible_to<int>;
  constant.observe(group, observations);     // [group_size × observation_dim]
  environment.step(group, actions, result);  // [group_size × action_dim]; overwrites all of `result`
  environment.end_iteration();               // alone, after every roll-out
  constant.save(archive, prefix);            // everything an exact continuation needs
  environment.load(constant_archive, prefix);
};

/// Which agent acts for a character now: environments for several agents have a member `actor(group,
/// character)`; in all others there is one agent, number 0.
template <Environment E>
int acting_agent(const E& environment, int group, int character) {
  if constexpr (requires { environment.actor(group, character); })
    return environment.actor(group, character);
  else
    return 0;
}

}  // namespace mimicx::rl
