#include "teaching/teaching_settings.h"

#include "core/setting.h"

namespace mimicx::teaching {
namespace {

/// Calls add(name, field, least, most) for every number.
template <class Config, class Add>
void for_each_teaching_setting(Config& config, const Add& add) {
  add("teach", config.teach, 0, 1);
  auto& teacher = config.teacher;
  add("teach_gain_residual", teacher.gains.residual, 1e-9, 1e9);
  add("teach_gain_change", teacher.gains.change, 0, 1e9);
  add("teach_less_smoothing", teacher.less_smoothing, 0.1, 100);
  add("teach_enough", teacher.enough, 0, 1);
  add("teach_max_correction", teacher.max_correction, 0, 10);
  auto& student = config.student;
  add("teach_hidden", student.hidden, 1, 4096);
  add("teach_wider", student.wider, 1, 64);
  add("teach_rounds", student.rounds, 1, 10000);
  add("teach_stages", student.stages, 1, 1000);
  add("teach_packs", student.packs, 1, 1000);
  add("teach_steps_per_frame", student.steps_per_frame, 0, 1000);
  add("teach_least_steps", student.least_steps, 1, 1e6);
  add("teach_step_size", student.step_size, 0, 1);
  add("teach_last_step_size", student.last_step_size, 0, 1);
  add("teach_rows", student.most_rows, 1, 1e8);
  add("teach_action_noise", student.lessons.action_noise, 0, 1);
  add("teach_push", student.lessons.push, 0, 10);
  add("teach_push_every", student.lessons.push_every, 1, 1e6);
  add("teach_off_path", student.lessons.off_path, 1e-3, 10);
  add("teach_teacher_lanes", student.lessons.teacher_lanes, 1, 16);
  add("teach_minibatch", student.regression.minibatch, 1, 1e6);
  add("teach_slots", student.regression.slots, 1, 64);
  add("teach_gradient_norm", student.regression.gradient_norm, 1e-9, 1e9);
  add("polish_samples", config.polish_samples, 0, 1e12);
  add("polish_reward", config.polish_reward, 0, 1);
}

}  // namespace

NamedValues teaching_settings(const TeachingConfig& config) {
  return numbers_in([&](const auto& add) { for_each_teaching_setting(config, add); });
}

bool change_setting(TeachingConfig& config, const std::string& name, double value) {
  return change_one([&](const auto& add) { for_each_teaching_setting(config, add); }, name, value);
}

void check(const TeachingConfig& config) {
  require_ranges([&](const auto& add) { for_each_teaching_setting(config, add); });
}

}  // namespace mimicx::teaching
