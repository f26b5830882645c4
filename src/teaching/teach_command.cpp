#include "teaching/teach_command.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "core/bits.h"
#include "core/npz/npz.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "pipeline/options/features.h"
#include "pipeline/options_folder.h"
#include "record/folder_lock.h"
#include "record/table.h"
#include "record/utf8_names.h"
#include "teaching/plan_teachers.h"

namespace mimicx::teaching {
namespace {

constexpr double kCheckpointSeconds = 60.0;  ///< least time between two checkpoints, s
constexpr const char* kIdentityKey = "input_checksum";

/// Plans the motions that have no plan yet.
record::RunOutcome plan_inputs(const TeachConfig& config, const record::RunContext& context) {
  plan::PlanMotionsConfig planning = config.planning;
  planning.run.out = config.out / "plans";
  planning.run.gains = true;
  return plan::plan_motions(planning, context);
}

/// All plans to learn from: those of earlier runs, then those of this one.
std::vector<PlannedMotion> motions_of(const TeachConfig& config, std::ostream& told) {
  std::vector<PlannedMotion> motions;
  std::vector<std::filesystem::path> folders(config.plans.begin(), config.plans.end());
  if (!config.planning.run.inputs.empty()) folders.push_back(config.out / "plans");
  for (const std::filesystem::path& folder : folders) {
    std::vector<PlannedMotion> more = followed_plans({folder}, &told);
    if (more.empty())
      throw std::invalid_argument(folder.string() +
                                  " has no plan that was followed and has feedback gains: `mimicx plan "
                                  "--gains` leaves them");
    motions.insert(motions.end(), more.begin(), more.end());
  }
  return motions;
}

record::Json teaching_record(const TeachConfig& config, const std::vector<PlannedMotion>& motions) {
  record::Json inputs = record::Json::array();
  for (const PlannedMotion& motion : motions)
    inputs.push_back({{"input", record::to_utf8(motion.input)}, {"checksum", motion.checksum}});
  return {{"version", MIMICX_VERSION},
          {"target", kArithmetic},
          {"seed", config.school.seed},
          {"settings", record::to_json(manifest_settings(config))},
          {"inputs", inputs}};
}

/// Unique names of the motions in the set.
std::vector<std::string> names_of(const std::vector<PlannedMotion>& motions) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const PlannedMotion& motion : motions)
    taken.insert(names.emplace_back(record::unique_name(motion.name, taken)));
  return names;
}

/// Sets packs and rounds so that every motion gets its visits. A round visits no motion twice.
SchoolConfig school_for(const TeachConfig& config, int motions) {
  SchoolConfig school = config.school;
  school.packs = std::min(school.packs, motions);
  school.rounds = (config.visits * motions + school.packs - 1) / school.packs;
  return school;
}

pipeline::options::Clusters cluster(const TeachConfig& config, const std::vector<PlannedMotion>& motions,
                                    const std::vector<std::string>& names) {
  List<pipeline::options::NamedFeatures> features(static_cast<int>(motions.size()));
  parallel_for(features.count(), config.planning.run.threads, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    features[i] = {names[k], pipeline::options::motion_features(reference_of(motions[k]))};
  });
  pipeline::options::ClusterConfig settings = config.clusters;
  // The default seed keeps the clusters of seed 0, which the set that comes with the program has.
  if (config.school.seed != SchoolConfig{}.seed) settings.seed = config.school.seed;
  pipeline::options::Clusters clusters = pipeline::options::cluster_motions(features, settings);
  pipeline::options::write_clusters(config.out / "clusters.json", clusters);
  return clusters;
}

/// The motions of these names.
std::vector<PlannedMotion> members(const pipeline::options::MotionCluster& cluster,
                                   const std::vector<PlannedMotion>& motions,
                                   const std::vector<std::string>& names) {
  std::vector<PlannedMotion> found;
  for (const std::string& member : cluster.members)
    found.push_back(
        motions[static_cast<std::size_t>(std::find(names.begin(), names.end(), member) - names.begin())]);
  return found;
}

/// One policy to be taught.
struct OptionLessons {
  std::string name;                    ///< of its files
  std::string identity;                ///< options_folder.h
  std::vector<PlannedMotion> motions;  ///< whose plans teach it
  SchoolConfig school;
  rl::tracking::TrackingConfig task;  ///< with the simulation of all plans
};

/// A teaching as its checkpoint has it, or a new one; and its log so far.
struct TeachingState {
  Pupil pupil;
  record::Table log{{"round", "lessons", "put_back", "loss"}, {}};
};

TeachingState resumed(const record::RunFolder& folder, const OptionLessons& option) {
  TeachingState state{untrained_pupil(option.school)};
  const std::filesystem::path checkpoint = folder.checkpoint(option.name);
  if (!std::filesystem::exists(checkpoint)) return state;
  const Npz archive = read_npz(checkpoint);
  if (!archive.has(kIdentityKey) || text_at(archive, kIdentityKey) != option.identity) return state;
  state.pupil = load_pupil(archive, "");
  state.log = record::read_csv(folder.log(option.name));
  state.log.rows.resize(std::min(state.log.rows.size(), static_cast<std::size_t>(state.pupil.rounds)));
  return state;
}

void write_checkpoint(const record::RunFolder& folder, const OptionLessons& option,
                      const TeachingState& state) {
  const std::filesystem::path log = folder.log(option.name), checkpoint = folder.checkpoint(option.name);
  make_folder(log.parent_path());
  make_folder(checkpoint.parent_path());
  write_file_atomically(log, record::format_csv(state.log));
  Npz archive;
  archive.set(kIdentityKey, NpyArray::scalar_text(option.identity));
  save(archive, "", state.pupil);
  write_npz(checkpoint, archive);
}

/// Teaches one policy by all of the plans; continues from the checkpoint in the folder.
///
///     DIR/training/NAME.csv     a row per round: lessons, resets per thousand lessons, loss
///     DIR/checkpoints/NAME.npz  the pupil
///
/// @return none if it was interrupted; the checkpoint then has the finished rounds
std::optional<Pupil> teach_option(const OptionLessons& option, const record::RunFolder& folder, int threads,
                                  const record::RunContext& context) {
  const SchoolConfig& school = option.school;
  const int count = static_cast<int>(option.motions.size());
  const Teachers teachers = [&](int k) {
    return read_teacher(option.motions[static_cast<std::size_t>(k)], option.task,
                        option.school.follow_plan ? Followed::kPlan : Followed::kReference);
  };
  control::PlanControl control;
  control.threads = threads;
  control.should_stop = context.should_stop;
  TeachingState state = resumed(folder, option);
  context.progress.start(option.name + " (" + std::to_string(count) + " motions)", state.pupil.rounds,
                         school.rounds, "rounds");
  double written = record::steady_seconds();
  while (state.pupil.rounds < school.rounds) {
    const auto round = teach_round(teachers, count, option.task, school, control, state.pupil);
    if (round) {
      state.log.rows.push_back({static_cast<double>(round->round), static_cast<double>(round->lessons),
                                round->put_back, round->loss});
      context.progress.update(state.pupil.rounds, formatted("%.2f of 1000 go astray", round->put_back));
    }
    const bool stop = !round || (context.should_stop && context.should_stop());
    const bool last = state.pupil.rounds == school.rounds;
    if (stop || last || record::steady_seconds() - written > kCheckpointSeconds) {
      write_checkpoint(folder, option, state);
      written = record::steady_seconds();
    }
    if (stop && !last) return {};
  }
  return std::move(state.pupil);
}

}  // namespace

NamedValues manifest_settings(const TeachConfig& config) {
  NamedValues values = settings_of(config);
  append(values, manifest_settings(config.planning.run));
  values.emplace_back("cluster_radius", config.clusters.radius);
  values.emplace_back("clusters", config.clusters.clusters.value_or(0));
  return values;
}

void check(const TeachConfig& config) {
  require_ranges(config);
  check(config.planning.planning);
}

record::RunOutcome teach_options(const TeachConfig& config, const record::RunContext& context) {
  const record::RunFolder folder{config.out};
  std::vector<std::string> files = config.planning.run.inputs;
  files.insert(files.end(), config.plans.begin(), config.plans.end());
  pipeline::claim_options(folder, files, config.planning.run.force);
  const record::FolderLock lock(folder.root);
  record::RunOutcome outcome = record::RunOutcome::kAllGood;
  if (!config.planning.run.inputs.empty()) outcome = plan_inputs(config, context);
  if (outcome == record::RunOutcome::kInterrupted) return outcome;
  const std::vector<PlannedMotion> motions = motions_of(config, context.messages);
  const record::Json record = teaching_record(config, motions);
  if (pipeline::finished_outcome(folder, record)) {
    context.messages << folder.root.string() << ": these options are taught already\n";
    return outcome;
  }
  pipeline::begin_options(folder, record);
  const std::vector<std::string> names = names_of(motions);
  const pipeline::options::Clusters clusters = cluster(config, motions, names);
  rl::tracking::TrackingConfig task;
  task.simulation = config.planning.planning.simulation;
  pipeline::options::OptionSet set;
  record::Json taught = record::Json::array();
  for (int index = 0; index < clusters.clusters.count(); ++index) {
    const pipeline::options::MotionCluster& cluster = clusters.clusters[index];
    const std::string name = "option" + std::to_string(index);
    SchoolConfig school = school_for(config, static_cast<int>(cluster.members.size()));
    school.seed += static_cast<std::uint64_t>(index);
    const OptionLessons lessons = {name, pipeline::identity_of_option(record, cluster.members),
                                   members(cluster, motions, names), school, task};
    const auto pupil = teach_option(lessons, folder, config.planning.run.threads, context);
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
  pipeline::finish_options(folder, set, record, record::Json::array(), taught);
  return outcome;
}

}  // namespace mimicx::teaching
