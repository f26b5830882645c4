#include "teaching/school_rounds.h"

#include <algorithm>
#include <cstdio>

#include "core/npz/npz.h"
#include "core/setting.h"
#include "record/table.h"

namespace mimicx::teaching {
namespace {

constexpr double kCheckpointSeconds = 60.0;  ///< least time between two checkpoints, s

/// Calls add(name, field, least, most) for every number of the school.
template <class Config, class Add>
void for_each_school_setting(Config& school, const Add& add) {
  for (std::size_t layer = 0; layer < school.hidden.size(); ++layer)
    add("school_hidden_" + std::to_string(layer + 1), school.hidden[layer], 1, 4096);
  add("school_packs", school.packs, 1, 10000);
  add("school_passes", school.passes, 0, 1000);
  add("school_step_size", school.step_size, 0, 1);
  add("school_last_step_size", school.last_step_size, 0, 1);
  add("school_decay", school.decay, 0, 1);
  add("school_weigh", school.weigh, 0, 1);
  add("school_mirror", school.mirror, 0, 1);
  add("school_follow_plan", school.follow_plan, 0, 1);
  add("school_see_shape", school.see_shape, 0, 1);
  add("school_action_noise", school.lessons.action_noise, 0, 1);
  add("school_push", school.lessons.push, 0, 10);
  add("school_push_every", school.lessons.push_every, 1, 1e6);
  add("school_off_path", school.lessons.off_path, 1e-3, 10);
  add("school_teacher_lanes", school.lessons.teacher_lanes, 1, 16);
  add("school_minibatch", school.regression.minibatch, 1, 1e6);
  add("school_slots", school.regression.slots, 1, 64);
  add("school_gradient_norm", school.regression.gradient_norm, 1e-9, 1e9);
}

/// A pupil from its checkpoint, or a new one, and the log so far.
struct Progress {
  Pupil pupil;
  record::Table log{{"round", "lessons", "put_back", "loss"}, {}};
};

Progress resumed(const record::RunFolder& folder, const std::string& name, const SchoolConfig& school) {
  Progress progress{new_pupil(school)};
  if (!std::filesystem::exists(folder.checkpoint(name))) return progress;
  progress.pupil = load_pupil(read_npz(folder.checkpoint(name)), "");
  progress.log = record::read_csv(folder.log(name));
  progress.log.rows.resize(
      std::min(progress.log.rows.size(), static_cast<std::size_t>(progress.pupil.rounds)));
  return progress;
}

void write_checkpoint(const record::RunFolder& folder, const std::string& name, const Progress& progress) {
  make_folder(folder.log(name).parent_path());
  make_folder(folder.checkpoint(name).parent_path());
  write_file_atomically(folder.log(name), record::format_csv(progress.log));
  Npz archive;
  save(archive, "", progress.pupil);
  write_npz(folder.checkpoint(name), archive);
}

}  // namespace

NamedValues school_settings(const SchoolConfig& school) {
  return numbers_in([&](const auto& add) { for_each_school_setting(school, add); });
}

bool change_setting(SchoolConfig& school, const std::string& name, double value) {
  return change_one([&](const auto& add) { for_each_school_setting(school, add); }, name, value);
}

void check(const SchoolConfig& school) {
  require_ranges([&](const auto& add) { for_each_school_setting(school, add); });
}

std::optional<Pupil> teach_option(const std::vector<PlannedMotion>& motions, const SchoolConfig& school,
                                  const rl::tracking::TrackingConfig& task, const record::RunFolder& folder,
                                  const std::string& name, int threads, const record::RunContext& context) {
  const int count = static_cast<int>(motions.size());
  const Teachers teachers = [&](int k) {
    return read_teacher(motions[static_cast<std::size_t>(k)], task,
                        school.follow_plan ? Followed::kPlan : Followed::kReference);
  };
  control::PlanControl control;
  control.threads = threads;
  control.should_stop = context.should_stop;
  Progress progress = resumed(folder, name, school);
  context.progress.start(name + " (" + std::to_string(count) + " motions)", progress.pupil.rounds,
                         school.rounds, "rounds");
  double written = record::steady_seconds();
  while (progress.pupil.rounds < school.rounds) {
    const auto round = teach_round(teachers, count, task, school, control, progress.pupil);
    if (round) {
      progress.log.rows.push_back({static_cast<double>(round->round), static_cast<double>(round->lessons),
                                   round->put_back, round->loss});
      char detail[64];
      std::snprintf(detail, sizeof detail, "%.2f of 1000 go astray", round->put_back);
      context.progress.update(progress.pupil.rounds, detail);
    }
    const bool stop = !round || (context.should_stop && context.should_stop());
    const bool last = progress.pupil.rounds == school.rounds;
    if (stop || last || record::steady_seconds() - written > kCheckpointSeconds) {
      write_checkpoint(folder, name, progress);
      written = record::steady_seconds();
    }
    if (stop && !last) return {};
  }
  return std::move(progress.pupil);
}

}  // namespace mimicx::teaching
