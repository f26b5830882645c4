#include "teaching/student.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/random.h"
#include "motion/metrics.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::teaching {
namespace {

enum StudentStream : std::uint64_t { kStudentRows = 0x57d0 };

/// Appends lessons and drops the oldest beyond `most` rows.
void add(const Lessons& fresh, int state_size, int most, Lessons& all) {
  append_lessons(fresh, all);
  const int extra = all.rows() - most;
  if (extra <= 0) return;
  all.states.erase(all.states.begin(), all.states.begin() + std::ptrdiff_t{extra} * state_size);
  all.actions.erase(all.actions.begin(), all.actions.begin() + std::ptrdiff_t{extra} * kDofs);
  all.weighed_by.erase(all.weighed_by.begin(), all.weighed_by.begin() + extra);
}

/// The student with the smallest distance from the motion in an unaided roll-out; students that fall rank
/// last.
struct Best {
  rl::Agent agent;
  double distance = std::numeric_limits<double>::infinity();

  void consider(const Teacher& teacher, const rl::tracking::TrackingConfig& task,
                const rl::Agent& candidate) {
    const auto alone = rl::tracking::roll_out(teacher.clip, task, rl::tracking::mean_action({candidate}));
    const double score = rl::tracking::distance_from_clip(alone);
    if (score < distance) *this = {candidate, score};
  }
  bool followed() const { return distance < motion::kMaxBodyDistance; }
};

/// @param times  as wide as the first student
PolicyInTraining new_student(const Teacher& teacher, const StudentConfig& config, int times) {
  return untrained_policy(teacher.clip->state_size(), {times * config.hidden, times * config.hidden},
                          config.seed);
}

}  // namespace

std::optional<rl::Agent> teach_student(
    const Teacher& teacher, const rl::tracking::TrackingConfig& task, const StudentConfig& config,
    const control::PlanControl& control,
    const std::function<void(const RoundStats&, const rl::Agent&)>& watch) {
  PolicyInTraining student = new_student(teacher, config, 1);
  int steps =
      std::max(config.least_steps, static_cast<int>(std::lround(config.steps_per_frame * teacher.size())));
  Best best{student.agent};
  Lessons all;
  Random random(config.seed, {kStudentRows});
  RoundStats stats;
  for (int round = 0; round < config.stages * config.rounds; ++round) {
    const int of_stage = round % config.rounds;
    if (of_stage == 0 && best.followed()) break;
    List<Lessons> fresh(config.packs);
    parallel_for(config.packs, control.threads, [&](int pack) {
      const LessonKey key = {config.seed, static_cast<std::uint64_t>(round * config.packs + pack)};
      fresh[pack] = take_lessons(teacher, task, config.lessons, round > 0 ? &student.agent : nullptr, key);
    });
    stats.round = round;
    stats.put_back = 0;
    for (const Lessons& lessons : fresh) {
      add(lessons, student.agent.actor.inputs(), config.most_rows, all);
      stats.put_back += lessons.put_back;
      stats.taken += lessons.rows();
    }
    const bool another = round == config.rounds && config.wider > 1;
    if (another) {
      student = new_student(teacher, config, config.wider);
      steps *= config.wider;
    }
    if (round == 0 || another) scale_inputs(all, student.agent);
    const RegressionRound of_this = {of_stage, config.rounds, steps, config.step_size, config.last_step_size};
    const auto loss =
        regression_round({all, teacher.importance}, of_this, config.regression, control, random, student);
    if (!loss) return {};
    stats.loss = *loss;
    if (2 * (of_stage + 1) > config.rounds) best.consider(teacher, task, student.agent);
    if (control.progress) control.progress(round + 1, config.stages * config.rounds);
    if (watch) watch(stats, student.agent);
  }
  return best.agent;
}

}  // namespace mimicx::teaching
