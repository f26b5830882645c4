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
    const double fell = alone.broken                                      ? kFar
                        : alone.worst_distance > motion::kMaxBodyDistance ? alone.worst_distance
                                                                          : 0.0;
    const double score = alone.mean_position_error + fell;
    if (score < distance) *this = {candidate, score};
  }
  bool followed() const { return distance < motion::kMaxBodyDistance; }

  static constexpr double kFar = 100.0;
};

/// A student with its optimiser.
struct Student {
  /// @param times  factor on width and steps
  Student(const Teacher& teacher, const StudentConfig& config, int times)
      : agent(beginner(teacher.clip->state_size(), {times * config.hidden, times * config.hidden},
                       config.seed)),
        adam(nn::make_adam<float>(nn::parameters(agent.actor))),
        steps(times * std::max(config.least_steps,
                               static_cast<int>(std::lround(config.steps_per_frame * teacher.size())))) {}

  rl::Agent agent;
  nn::Adam<float> adam;
  int steps;  ///< of a round
};

/// The regression of one round. @param of_stage  index of the round in its stage
/// @return the mean loss; none if it was stopped
std::optional<double> study(const Lessons& lessons, const Teacher& teacher, const StudentConfig& config,
                            int of_stage, const control::PlanControl& control, Random& random,
                            RegressionScratch& scratch, Student& student) {
  List<int> rows(config.regression.minibatch);
  double loss = 0.0;
  for (int step = 0; step < student.steps; ++step) {
    if (control.should_stop && control.should_stop()) return {};
    const double done = (of_stage + (step + 0.5) / student.steps) / config.rounds;
    const double fall = (1.0 - done) * (1.0 - done);
    const double step_size = config.last_step_size + fall * (config.step_size - config.last_step_size);
    for (int& row : rows) row = static_cast<int>(random.below(static_cast<std::uint32_t>(lessons.rows())));
    loss += regression_step(lessons, teacher.importance, rows, config.regression, step_size, control.threads,
                            student.agent, student.adam, scratch) /
            student.steps;
  }
  return loss;
}

}  // namespace

std::optional<rl::Agent> teach(const Teacher& teacher, const rl::tracking::TrackingConfig& task,
                               const StudentConfig& config, const control::PlanControl& control,
                               const std::function<void(const RoundStats&, const rl::Agent&)>& watch) {
  Student student(teacher, config, 1);
  Best best{student.agent};
  RegressionScratch scratch;
  Lessons all;
  Random random(config.seed, {kStudentRows});
  RoundStats stats;
  for (int round = 0; round < config.stages * config.rounds; ++round) {
    const int of_stage = round % config.rounds;
    if (of_stage == 0 && best.followed()) break;
    List<Lessons> fresh(config.packs);
    parallel_for(config.packs, control.threads, [&](int pack) {
      const auto key = static_cast<std::uint64_t>(round * config.packs + pack);
      fresh[pack] =
          take_lessons(teacher, task, config.lessons, round > 0 ? &student.agent : nullptr, config.seed, key);
    });
    stats.round = round;
    stats.put_back = 0;
    for (const Lessons& lessons : fresh) {
      add(lessons, student.agent.actor.inputs(), config.most_rows, all);
      stats.put_back += lessons.put_back;
      stats.taken += lessons.rows();
    }
    const bool another = round == config.rounds && config.wider > 1;
    if (another) student = Student(teacher, config, config.wider);
    if (round == 0 || another) scale_inputs(all, student.agent);
    const auto loss = study(all, teacher, config, of_stage, control, random, scratch, student);
    if (!loss) return {};
    stats.loss = *loss;
    if (2 * (of_stage + 1) > config.rounds) best.consider(teacher, task, student.agent);
    if (control.progress) control.progress(round + 1, config.stages * config.rounds);
    if (watch) watch(stats, student.agent);
  }
  return best.agent;
}

}  // namespace mimicx::teaching
