#include "pipeline/teach.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "core/npz.h"
#include "core/parallel.h"
#include "motion/features.h"
#include "pipeline/options/option_set.h"
#include "pipeline/options_folder.h"
#include "pipeline/plan_teachers.h"
#include "pipeline/record/folder_lock.h"
#include "pipeline/record/names.h"
#include "pipeline/record/table.h"
#include "pipeline/setting.h"

namespace mimicx::pipeline {
namespace {

constexpr double kCheckpointSeconds = 60.0;  ///< at least so long between two checkpoints

/// Calls add(name, field, least, most) for every number of the school.
template <class Config, class Add>
void for_each_setting(Config& school, const Add& add) {
  for (std::size_t layer = 0; layer < school.hidden.size(); ++layer)
    add("school_hidden_" + std::to_string(layer + 1), school.hidden[layer], 1, 4096);
  add("school_rounds", school.rounds, 1, 1e6);
  add("school_packs", school.packs, 1, 10000);
  add("school_passes", school.passes, 0, 1000);
  add("school_step_size", school.step_size, 0, 1);
  add("school_last_step_size", school.last_step_size, 0, 1);
  add("school_decay", school.decay, 0, 1);
  add("school_weigh", school.weigh, 0, 1);
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

/// Plans the motions that have no plan yet.
record::RunOutcome plan_inputs(const TeachConfig& config, const record::RunContext& context) {
  PlanMotionsConfig planning = config.planning;
  planning.run.out = config.out / "plans";
  planning.run.gains = true;
  return plan_motions(planning, context);
}

/// All that there is to learn from: those of earlier runs, then those of this one.
std::vector<PlannedMotion> motions_of(const TeachConfig& config) {
  std::vector<PlannedMotion> motions;
  std::vector<std::filesystem::path> folders(config.plans.begin(), config.plans.end());
  if (!config.planning.run.inputs.empty()) folders.push_back(config.out / "plans");
  for (const std::filesystem::path& folder : folders) {
    std::vector<PlannedMotion> more = followed_plans({folder});
    if (more.empty())
      throw std::invalid_argument(folder.string() +
                                  " has no plan that was followed and has feedback gains: `mimicx plan "
                                  "--gains` leaves them");
    motions.insert(motions.end(), more.begin(), more.end());
  }
  return motions;
}

record::Json run_record(const TeachConfig& config, const std::vector<PlannedMotion>& motions) {
  record::Json settings = record::Json::object(), inputs = record::Json::array();
  for (const auto& [name, value] : settings_of(config)) settings[name] = value;
  for (const PlannedMotion& motion : motions)
    inputs.push_back({{"input", record::to_utf8(motion.input)}, {"checksum", motion.checksum}});
  return {{"version", MIMICX_VERSION},
          {"target", MIMICX_TARGET},
          {"seed", config.school.seed},
          {"settings", settings},
          {"inputs", inputs}};
}

/// The motions' names in the set, one for each, whatever folder they come from.
std::vector<std::string> names_of(const std::vector<PlannedMotion>& motions) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const PlannedMotion& motion : motions)
    taken.insert(names.emplace_back(record::unique_name(motion.name, taken)));
  return names;
}

options::Clusters cluster(const TeachConfig& config, const std::vector<PlannedMotion>& motions,
                          const std::vector<std::string>& names) {
  List<options::NamedFeatures> features(static_cast<int>(motions.size()));
  parallel_for(features.count(), config.planning.run.threads, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    features[i] = {names[k], motion::motion_features(reference_of(motions[k]))};
  });
  options::Clusters clusters = options::cluster_motions(features, config.clusters);
  options::write_clusters(config.out / "clusters.json", clusters);
  return clusters;
}

/// A teaching as its checkpoint has it, or a new one; and its log so far.
struct Progress {
  teaching::Pupil pupil;
  record::Table log{{"round", "lessons", "put_back", "loss"}, {}};
};

Progress resumed(const record::RunFolder& folder, const std::string& name,
                 const teaching::SchoolConfig& school) {
  Progress progress{teaching::new_pupil(school)};
  if (!std::filesystem::exists(folder.checkpoint(name))) return progress;
  progress.pupil = teaching::load_pupil(read_npz(folder.checkpoint(name)), "");
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
  teaching::save(archive, "", progress.pupil);
  write_npz(folder.checkpoint(name), archive);
}

/// @return none where it was interrupted
std::optional<teaching::Pupil> teach_option(const TeachConfig& config, const record::RunContext& context,
                                            const std::vector<PlannedMotion>& motions,
                                            const std::string& name, std::uint64_t seed) {
  const record::RunFolder folder{config.out};
  teaching::SchoolConfig school = config.school;
  school.seed = seed;
  rl::tracking::TrackingConfig task;
  task.simulation = config.planning.planning.simulation;
  const teaching::Teachers teachers = [&](int k) {
    return read_teacher(motions[static_cast<std::size_t>(k)], task);
  };
  control::PlanControl control;
  control.threads = config.planning.run.threads;
  control.should_stop = context.should_stop;
  Progress progress = resumed(folder, name, school);
  context.progress.start(name + " (" + std::to_string(motions.size()) + " motions)", progress.pupil.rounds,
                         school.rounds, "rounds");
  double written = record::steady_seconds();
  while (progress.pupil.rounds < school.rounds) {
    const auto round = teaching::teach_round(teachers, static_cast<int>(motions.size()), task, school,
                                             control, progress.pupil);
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

/// The motions of these names.
std::vector<PlannedMotion> members(const options::MotionCluster& cluster,
                                   const std::vector<PlannedMotion>& motions,
                                   const std::vector<std::string>& names) {
  std::vector<PlannedMotion> found;
  for (const std::string& member : cluster.members)
    found.push_back(
        motions[static_cast<std::size_t>(std::find(names.begin(), names.end(), member) - names.begin())]);
  return found;
}

}  // namespace

NamedValues settings_of(const TeachConfig& config) {
  NamedValues values;
  for_each_setting(config.school, [&](const std::string& name, const auto& field, double, double) {
    values.emplace_back(name, number_of(field));
  });
  values.emplace_back("cluster_radius", config.clusters.radius);
  values.emplace_back("clusters", config.clusters.clusters.value_or(0));
  append(values, settings_of(config.planning));
  return values;
}

void apply_setting(TeachConfig& config, const std::string& name, double value) {
  bool found = false;
  for_each_setting(config.school, [&](const std::string& known, auto& field, double, double) {
    if (known != name) return;
    assign(field, value);
    found = true;
  });
  if (!found) apply_setting(config.planning.planning, name, value);
}

void check(const TeachConfig& config) {
  for_each_setting(config.school, [](const std::string& name, const auto& field, double least, double most) {
    require_range(name, number_of(field), least, most);
  });
  check(config.planning.planning);
}

record::RunOutcome teach(const TeachConfig& config, const record::RunContext& context) {
  const record::RunFolder folder{config.out};
  std::vector<std::string> files = config.planning.run.inputs;
  files.insert(files.end(), config.plans.begin(), config.plans.end());
  claim_options(folder, files, config.planning.run.force);
  const record::FolderLock lock(folder.root);
  record::RunOutcome outcome = record::RunOutcome::kAllGood;
  if (!config.planning.run.inputs.empty()) outcome = plan_inputs(config, context);
  if (outcome == record::RunOutcome::kInterrupted) return outcome;
  const std::vector<PlannedMotion> motions = motions_of(config);
  const record::Json record = run_record(config, motions);
  if (finished_outcome(folder, record)) {
    context.messages << folder.root.string() << ": these options are taught already\n";
    return outcome;
  }
  folder.create();
  write_file_atomically(folder.manifest(), record::Json({{"run", record}}).dump(1) + "\n");
  const std::vector<std::string> names = names_of(motions);
  const options::Clusters clusters = cluster(config, motions, names);
  options::OptionSet set;
  record::Json taught = record::Json::array();
  for (int index = 0; index < clusters.clusters.count(); ++index) {
    const options::MotionCluster& cluster = clusters.clusters[index];
    const std::string name = "option" + std::to_string(index);
    const auto pupil = teach_option(config, context, members(cluster, motions, names), name,
                                    config.school.seed + static_cast<std::uint64_t>(index));
    if (!pupil) {
      context.progress.finish("interrupted; the same command continues");
      return record::RunOutcome::kInterrupted;
    }
    context.progress.finish(name + ": done, " + cluster.description);
    set.options.push_back({{pupil->agent, {}},
                           cluster.description,
                           cluster.centre,
                           static_cast<int>(cluster.members.size()),
                           pupil->taken});
    taught.push_back({{"name", name},
                      {"description", cluster.description},
                      {"motions", cluster.members.size()},
                      {"lessons", pupil->taken}});
  }
  options::write_options(config.out / "options.npz", set);
  write_file_atomically(folder.manifest(),
                        record::Json({{"run", record},
                                      {"inputs", record::Json::array()},
                                      {"options", taught},
                                      {"checksum", record::file_checksum(config.out / "options.npz")}})
                                .dump(1) +
                            "\n");
  return outcome;
}

}  // namespace mimicx::pipeline
