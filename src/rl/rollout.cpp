#include "rl/rollout.h"

namespace mimicx::rl {

RolloutBuffer make_rollout_buffer(int groups, int group_size, int horizon, int observation_dim,
                                  int action_dim) {
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
  group.moments = nn::make_moments(observation_dim);
  group.ages.assign(static_cast<std::size_t>(group_size), 0);
  return {horizon, group_size, std::vector<GroupRollout>(static_cast<std::size_t>(groups), group)};
}

void begin_rollout(GroupRollout& rollout) {
  rollout.moments = nn::make_moments(static_cast<int>(rollout.observations.cols()));
  rollout.ended_episodes = rollout.ended_steps = 0;
}

void record_decision(const Agent& agent, double sigma, int t, Random& random, CollectScratch& scratch,
                     GroupRollout& rollout) {
  const Eigen::Index size = scratch.raw.rows(), first = t * size;
  nn::merge(rollout.moments, nn::moments_of(scratch.raw));
  nn::normalise(agent.observations, scratch.raw, scratch.normalised);
  nn::evaluate(agent.critic, scratch.normalised, scratch.critic, scratch.values);
  unscale_values(agent.returns, scratch.values);
  nn::evaluate(agent.actor, scratch.normalised, scratch.actor, scratch.means);
  sample_actions(scratch.means, sigma, random, scratch.actions, rollout.log_density.row(t).transpose());

  rollout.observations.middleRows(first, size) = scratch.normalised;
  rollout.values.row(t) = scratch.values.transpose();
  rollout.means.middleRows(first, size) = scratch.means;
  rollout.actions.middleRows(first, size) = scratch.actions;
}

void record_result(const Agent& agent, int t, CollectScratch& scratch, GroupRollout& rollout) {
  const StepResult& result = scratch.result;
  rollout.rewards.row(t) = result.reward.matrix().transpose();
  rollout.terminated.row(t) = result.terminated.matrix().transpose();
  rollout.truncated.row(t) = result.truncated.matrix().transpose();
  const Eigen::Index size = result.reward.size();
  for (Eigen::Index i = 0; i < size; ++i) {
    auto& age = rollout.ages[static_cast<std::size_t>(i)];
    ++age;
    if (!result.terminated[i] && !result.truncated[i]) continue;
    ++rollout.ended_episodes;
    rollout.ended_steps += age;
    age = 0;
  }
  if (!result.truncated.any()) return;
  nn::normalise(agent.observations, result.final_observations, scratch.normalised);
  nn::evaluate(agent.critic, scratch.normalised, scratch.critic, scratch.values);
  unscale_values(agent.returns, scratch.values);
  rollout.final_values.row(t) = scratch.values.transpose();
}

void finish_rollout(const Agent& agent, double gamma, double lambda, CollectScratch& scratch,
                    GroupRollout& rollout) {
  nn::normalise(agent.observations, scratch.raw, scratch.normalised);
  nn::evaluate(agent.critic, scratch.normalised, scratch.critic, scratch.values);
  unscale_values(agent.returns, scratch.values);
  rollout.last_values = scratch.values.transpose();
  estimate_advantages({rollout.rewards, rollout.values, rollout.last_values, rollout.terminated,
                       rollout.truncated, rollout.final_values},
                      gamma, lambda, rollout.advantages);
}

}  // namespace mimicx::rl
