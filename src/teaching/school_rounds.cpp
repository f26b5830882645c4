#include "teaching/school_rounds.h"

#include <algorithm>

#include "core/npz/npz.h"
#include "core/number_text.h"
#include "record/table.h"

namespace mimicx::teaching {
namespace {

constexpr double kCheckpointSeconds = 60.0;  ///< least time between two checkpoints, s

/// A teaching as its checkpoint has it, or a new one; and its log so far.
struct Progress {
  Pupil pupil;
  record::Table log{{"round", "lessons", "put_back", "loss"}, {}};
};

Progress resumed(const record::RunFolder& folder, const std::string& name, const SchoolConfig& school) {
  Progress progress{untrained_pupil(school)};
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

std::optional<Pupil> teach_option(const OptionLessons& option, const record::RunFolder& folder, int threads,
                                  const record::RunContext& context) {
  const auto& [name, motions, school, task] = option;
  const int count = static_cast<int>(motions.size());
  const Teachers teachers = [&](int k) {
    return read_teacher(option.motions[static_cast<std::size_t>(k)], option.task,
                        option.school.follow_plan ? Followed::kPlan : Followed::kReference);
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
      context.progress.update(progress.pupil.rounds, formatted("%.2f of 1000 go astray", round->put_back));
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
