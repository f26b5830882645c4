#include "rl/rollout.h"

#include <algorithm>

namespace mimicx::rl {

namespace {

constexpr int kNoAgent = -1;

/// Calls visit(agent index, its raw observations [n × dim]) for every agent with rows; `scratch.rows` are
/// those rows.
template <class Visit>
void for_each_actor(const Agents& agents, const List<int>& actors, const nn::Matrix<float>& raw,
                    CollectScratch& scratch, const Visit& visit) {
  for (int agent = 0; agent < agents.count(); ++agent) {
    scratch.rows.clear();
    for (int i = 0; i < actors.count(); ++i)
      if (actors[i] == agent) scratch.rows.push_back(i);
    if (scratch.rows.empty()) continue;
    scratch.part_raw = raw(scratch.rows, Eigen::all);
    visit(agent, scratch.part_raw);
  }
}

/// V of the agent that acts: [n × 1] in scratch.part_values; leaves the normalised observations.
void value_part(const Agent& agent, const nn::Matrix<float>& raw, CollectScratch& scratch) {
  nn::normalise(agent.observations, raw, scratch.part_normalised);
  nn::evaluate(agent.critic, scratch.part_normalised, scratch.critic, scratch.part_values);
  unscale_values(agent.returns, scratch.part_values);
}

/// V of every row → scratch.values [G × 1].
void value_all(const Agents& agents, const List<int>& actors, const nn::Matrix<float>& raw,
               CollectScratch& scratch) {
  scratch.values.resize(raw.rows(), 1);  // rows without an agent keep their values
  for_each_actor(agents, actors, raw, scratch, [&](int agent, const nn::Matrix<float>& part) {
    value_part(*agents[agent], part, scratch);
    scratch.values(scratch.rows, Eigen::all) = scratch.part_values;
  });
}

}  // namespace

RolloutBuffer make_rollout_buffer(int groups, int group_size, int horizon, int observation_dim,
                                  int action_dim, int agents) {
  const int rows = horizon * group_size;
  const nn::Matrix<float> per_step = nn::Matrix<float>::Zero(horizon, group_size);
  const FlagMatrix no_flags = FlagMatrix::Constant(horizon, group_size, false);
  GroupRollout group;
  group.observations.setZero(rows, observation_dim);
  group.actions.setZero(rows, action_dim);
  group.means.setZero(rows, action_dim);
  group.log_density = group.rewards = group.values = group.final_values = group.advantages = per_step;
  group.last_values.setZero(1, group_size);
  group.terminated = group.truncated = no_flags;
  group.actors.assign(static_cast<std::size_t>(rows), 0);
  group.moments.assign(agents, nn::make_moments(observation_dim));
  group.ages.assign(group_size, 0);
  return {horizon, group_size, List<GroupRollout>(groups, group)};
}

void begin_rollout(GroupRollout& rollout) {
  for (nn::Moments& moments : rollout.moments)
    moments = nn::make_moments(static_cast<int>(rollout.observations.cols()));
  rollout.ended_episodes = rollout.ended_steps = 0;
}

void record_decision(const Agents& agents, double sigma, int t, Random& random, CollectScratch& scratch,
                     GroupRollout& rollout) {
  const Eigen::Index size = scratch.raw.rows(), first = t * size;
  scratch.means.resize(size, rollout.means.cols());
  scratch.values.resize(size, 1);
  for_each_actor(agents, scratch.actors, scratch.raw, scratch, [&](int index, const nn::Matrix<float>& part) {
    const Agent& agent = *agents[index];
    nn::merge(rollout.moments[index], nn::moments_of(part));
    value_part(agent, part, scratch);
    nn::evaluate(agent.actor, scratch.part_normalised, scratch.actor, scratch.part_means);
    scratch.values(scratch.rows, Eigen::all) = scratch.part_values;
    scratch.means(scratch.rows, Eigen::all) = scratch.part_means;
    rollout.observations.middleRows(first, size)(scratch.rows, Eigen::all) = scratch.part_normalised;
  });
  sample_actions(scratch.means, sigma, random, scratch.actions, rollout.log_density.row(t).transpose());
  rollout.values.row(t) = scratch.values.transpose();
  rollout.means.middleRows(first, size) = scratch.means;
  rollout.actions.middleRows(first, size) = scratch.actions;
  std::copy(scratch.actors.begin(), scratch.actors.end(), rollout.actors.begin() + first);
}

void record_result(const Agents& agents, int t, CollectScratch& scratch, GroupRollout& rollout) {
  const StepResult& result = scratch.result;
  rollout.rewards.row(t) = result.reward.matrix().transpose();
  rollout.terminated.row(t) = result.terminated.matrix().transpose();
  rollout.truncated.row(t) = result.truncated.matrix().transpose();
  const Eigen::Index size = result.reward.size();
  for (Eigen::Index i = 0; i < size; ++i) {
    auto& age = rollout.ages[i];
    ++age;
    if (!result.terminated[i] && !result.truncated[i]) continue;
    ++rollout.ended_episodes;
    rollout.ended_steps += age;
    age = 0;
  }
  if (!result.truncated.any()) return;
  // Only these rows: the bits of a product may depend on the number and place of rows.
  scratch.final_actors = result.final_actors;
  for (Eigen::Index i = 0; i < size; ++i)
    if (!result.truncated[i]) scratch.final_actors[i] = kNoAgent;
  scratch.values.setZero(size, 1);
  value_all(agents, scratch.final_actors, result.final_observations, scratch);
  rollout.final_values.row(t) = scratch.values.transpose();
}

void finish_rollout(const Agents& agents, const Discount& discount, CollectScratch& scratch,
                    GroupRollout& rollout) {
  value_all(agents, scratch.actors, scratch.raw, scratch);
  rollout.last_values = scratch.values.transpose();
  estimate_advantages({rollout.rewards, rollout.values, rollout.last_values, rollout.terminated,
                       rollout.truncated, rollout.final_values},
                      discount, rollout.advantages);
}

}  // namespace mimicx::rl
