#include "pipeline/training_log.h"

#include <algorithm>

#include "core/named_values.h"
#include "core/units.h"

namespace mimicx::pipeline {
namespace {

/// The columns of a row, each name beside its value.
NamedValues columns_of(const TrainingLogRow& row) {
  const rl::IterationStats& s = row.iteration;
  const rl::tracking::TrackingStatistics& tracking = row.tracking;
  const auto steps = static_cast<double>(std::max<std::int64_t>(tracking.steps, 1));
  NamedValues values = {{"iteration", static_cast<double>(s.iteration)},
                        {"samples", static_cast<double>(s.samples)},
                        {"reward", s.mean_reward},
                        {"episode_length", s.mean_episode_length}};
  for (std::size_t k = 0; k < rl::tracking::kRewardTermNames.size(); ++k)
    values.emplace_back("reward_term:" + std::string(rl::tracking::kRewardTermNames[k]),
                        tracking.reward_terms[k] / steps);
  mimicx::append(values, {{"kl", s.kl},
                          {"step_size", s.step_size},
                          {"sigma", s.sigma},
                          {"policy_loss", s.policy_loss},
                          {"value_loss", s.value_loss},
                          {"explained_variance", s.explained_variance},
                          {"clip_fraction", s.clip_fraction},
                          {"gradient_norm:actor", s.actor_gradient},
                          {"gradient_norm:critic", s.critic_gradient},
                          {"penalty", s.penalty},
                          {"saturation:actions", s.saturation},
                          {"saturation:torques", tracking.saturated_joints / (steps * kJoints)},
                          {"sharpness", row.sharpness},
                          {"rollout_reward", row.rollout_reward},
                          {"rollout_position_error_mm", kMm * row.rollout_position_error}});
  return values;
}

}  // namespace

record::Table empty_training_log() {
  record::Table log;
  for (const auto& [name, value] : columns_of({})) log.columns.push_back(name);
  return log;
}

void append(record::Table& log, const TrainingLogRow& row) {
  log.rows.emplace_back();
  for (const auto& [name, value] : columns_of(row)) log.rows.back().push_back(value);
}

}  // namespace mimicx::pipeline
