/// The record of a roll-out of H steps, one per group of characters.
///
/// Rows. Character i of a group at step t is row t·G + i of the group's matrices (G = group size), so every
/// step writes one contiguous block, and [H][G] arrays are the same memory as [H·G] columns. A row of the
/// whole buffer is group·H·G + t·G + i. Observations are stored normalised, because the statistics stay fixed
/// while a roll-out is collected and learned from.
///
/// Several agents may share a roll-out: `actors` names the agent of each row, whose policy acts and whose
/// critic gives the value. A return that crosses from one agent's rows into another's is therefore
/// bootstrapped with the other's critic (docs/method.md §9). The recording functions know no environment: the
/// caller passes the agent of each row.
#pragma once

#include <vector>

#include "core/containers.h"
#include "core/random.h"
#include "nn/normaliser.h"
#include "rl/environment.h"
#include "rl/gae.h"
#include "rl/policy.h"

namespace mimicx::rl {

/// The agents of a roll-out, by reference.
using Agents = List<const Agent*>;

struct GroupRollout {
  nn::Matrix<float> observations;    ///< [H·G × observation_dim], normalised
  nn::Matrix<float> actions;         ///< [H·G × action_dim]
  nn::Matrix<float> means;           ///< [H·G × action_dim] of the policy that acted
  nn::Matrix<float> log_density;     ///< [H][G] of the actions under that policy
  nn::Matrix<float> rewards;         ///< [H][G]
  nn::Matrix<float> values;          ///< [H][G] V(s_t)
  nn::Matrix<float> last_values;     ///< [1][G] V(s_H)
  nn::Matrix<float> final_values;    ///< [H][G] V(final observation) if truncated
  nn::Matrix<float> advantages;      ///< [H][G]
  FlagMatrix terminated, truncated;  ///< [H][G]

  std::vector<int> actors;  ///< [H·G] the agent that acted

  List<nn::Moments> moments;        ///< [agent] of its raw observations in this roll-out
  List<std::int64_t> ages;          ///< [G] steps since the last reset; kept between roll-outs
  std::int64_t ended_episodes = 0;  ///< in this roll-out
  std::int64_t ended_steps = 0;     ///< total length of these episodes
};

struct RolloutBuffer {
  int horizon = 0;
  int group_size = 0;
  List<GroupRollout> groups;

  int group_rows() const { return horizon * group_size; }
  int rows() const { return group_rows() * groups.count(); }
};

RolloutBuffer make_rollout_buffer(int groups, int group_size, int horizon, int observation_dim,
                                  int action_dim, int agents = 1);

/// Buffers of one group's collection.
struct CollectScratch {
  nn::Matrix<float> raw;                     ///< [G × observation_dim] as observed
  List<int> actors;                          ///< [G] the agent that acts
  nn::Matrix<float> means, actions, values;  ///< [G × …]
  StepResult result;

  // Of one agent's rows.
  List<int> rows, final_actors;
  nn::Matrix<float> part_raw, part_normalised, part_means, part_values;
  nn::Workspace<float> actor, critic;

  CollectScratch(int group_size, int observation_dim)
      : raw(group_size, observation_dim), actors(group_size, 0), result(group_size, observation_dim) {}
};

/// Clears the record of the last roll-out but keeps the ages.
void begin_rollout(GroupRollout& rollout);
/// Reads scratch.raw and scratch.actors; records observation, value, mean, action and density of step t;
/// writes scratch.actions.
void record_decision(const Agents& agents, double sigma, int t, Random& random, CollectScratch& scratch,
                     GroupRollout& rollout);
/// Reads scratch.result; records rewards, flags, values of truncated characters' final observations and
/// episode lengths.
void record_result(const Agents& agents, int t, CollectScratch& scratch, GroupRollout& rollout);
/// Reads scratch.raw and scratch.actors after the last step; computes bootstrap values and advantages.
void finish_rollout(const Agents& agents, const Discount& discount, CollectScratch& scratch,
                    GroupRollout& rollout);

/// Settings of all groups of a roll-out.
struct CollectSettings {
  Agents agents;
  double sigma;  ///< σ of the actions' noise
  Discount discount;
};

/// Collects one group over the whole horizon. @param random  keyed by iteration and group
template <Environment World>
void collect_group(World& environment, int group, const CollectSettings& settings, Random random,
                   CollectScratch& scratch, GroupRollout& rollout) {
  const Agents& agents = settings.agents;
  const auto observe = [&] {
    environment.observe(group, scratch.raw);
    for (int i = 0; i < scratch.actors.count(); ++i) scratch.actors[i] = environment.actor(group, i);
  };
  begin_rollout(rollout);
  const int horizon = static_cast<int>(rollout.rewards.rows());
  for (int t = 0; t < horizon; ++t) {
    observe();
    record_decision(agents, settings.sigma, t, random, scratch, rollout);
    environment.step(group, scratch.actions, scratch.result);
    record_result(agents, t, scratch, rollout);
  }
  observe();
  finish_rollout(agents, settings.discount, scratch, rollout);
}

}  // namespace mimicx::rl
