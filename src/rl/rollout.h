/// What one roll-out of T steps leaves behind, one record per group of characters.
///
/// Rows. Character i of a group at step t is row t·G + i of the group's matrices (G = group size), so every
/// step writes one contiguous block and [T][G] arrays are the same memory as [T·G] columns. A row of the
/// whole buffer is group·T·G + t·G + i. Observations are kept as the networks saw them (normalised), since
/// the statistics stay fixed while a roll-out is collected and learned from.
///
/// The recording functions know an agent and no environment; who acts in which row is the caller's choice.
#pragma once

#include <span>
#include <vector>

#include "core/random.h"
#include "nn/normaliser.h"
#include "rl/environment.h"
#include "rl/gae.h"
#include "rl/policy.h"

namespace mimicx::rl {

struct GroupRollout {
  nn::Matrix<float> observations;    ///< [T·G × observation_dim], normalised
  nn::Matrix<float> actions;         ///< [T·G × action_dim]
  nn::Matrix<float> means;           ///< [T·G × action_dim] of the policy that acted
  nn::Matrix<float> log_density;     ///< [T][G] of the actions under that policy
  nn::Matrix<float> rewards;         ///< [T][G]
  nn::Matrix<float> values;          ///< [T][G] V(s_t)
  nn::Matrix<float> last_values;     ///< [1][G] V(s_T)
  nn::Matrix<float> final_values;    ///< [T][G] V(final observation) where truncated
  nn::Matrix<float> advantages;      ///< [T][G]
  FlagMatrix terminated, truncated;  ///< [T][G]

  nn::Moments moments;              ///< of the raw observations of this roll-out
  std::vector<std::int64_t> ages;   ///< [G] steps since the last reset; lives on from roll-out to roll-out
  std::int64_t ended_episodes = 0;  ///< in this roll-out
  std::int64_t ended_steps = 0;     ///< lengths of those episodes together
};

struct RolloutBuffer {
  int horizon = 0;
  int group_size = 0;
  std::vector<GroupRollout> groups;

  int group_rows() const { return horizon * group_size; }
  int rows() const { return group_rows() * static_cast<int>(groups.size()); }
};

RolloutBuffer make_rollout_buffer(int groups, int group_size, int horizon, int observation_dim,
                                  int action_dim);

/// Buffers of one group's collection.
struct CollectScratch {
  nn::Matrix<float> raw;         ///< [G × observation_dim] as observed
  nn::Matrix<float> normalised;  ///< [G × observation_dim]
  nn::Matrix<float> means, actions, values;
  nn::Workspace<float> actor, critic;
  StepResult result;

  CollectScratch(int group_size, int observation_dim)
      : raw(group_size, observation_dim), result(group_size, observation_dim) {}
};

/// Forgets the last roll-out but keeps the ages.
void begin_rollout(GroupRollout& rollout);
/// Reads scratch.raw; records observation, value, mean, action and density of step t; leaves scratch.actions.
void record_decision(const Agent& agent, double sigma, int t, Random& random, CollectScratch& scratch,
                     GroupRollout& rollout);
/// Reads scratch.result: reward, flags, values of truncated characters' final observations, episode lengths.
void record_result(const Agent& agent, int t, CollectScratch& scratch, GroupRollout& rollout);
/// Reads scratch.raw, the observation after the last step: bootstrap values and advantages.
void finish_rollout(const Agent& agent, double gamma, double lambda, CollectScratch& scratch,
                    GroupRollout& rollout);

/// One group over the whole horizon. @param random  keyed by iteration and group
template <Environment E>
void collect_group(E& environment, int group, const Agent& agent, double sigma, double gamma, double lambda,
                   Random random, CollectScratch& scratch, GroupRollout& rollout) {
  begin_rollout(rollout);
  const int horizon = static_cast<int>(rollout.rewards.rows());
  for (int t = 0; t < horizon; ++t) {
    environment.observe(group, scratch.raw);
    record_decision(agent, sigma, t, random, scratch, rollout);
    environment.step(group, scratch.actions, scratch.result);
    record_result(agent, t, scratch, rollout);
  }
  environment.observe(group, scratch.raw);
  finish_rollout(agent, gamma, lambda, scratch, rollout);
}

}  // namespace mimicx::rl
