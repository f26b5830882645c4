#include "pipeline/sequences.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "core/npz.h"
#include "pipeline/audit/audit.h"
#include "pipeline/audit/substeps.h"
#include "pipeline/options/selector.h"
#include "pipeline/options/side_by_side.h"
#include "pipeline/preparation.h"
#include "pipeline/record/clean_copy.h"
#include "pipeline/record/motion_output.h"
#include "pipeline/report/run_report.h"
#include "pipeline/scores.h"
#include "rl/tracking/rollout.h"

namespace mimicx {
namespace {

constexpr double kReportSeconds = 30.0;  ///< between reports while a run goes on

struct RunState {
  const RunOptions& options;
  const RunContext& context;
  RunFolder folder;
  Manifest manifest;
  std::vector<Timing> timings;
};

Manifest manifest_of(const RunOptions& options) {
  Manifest manifest;
  manifest.version = MIMICX_VERSION;
  manifest.target = MIMICX_TARGET;
  manifest.seed = options.training.seed;
  manifest.samples = options.training.samples;
  manifest.settings = settings_of(options.training);
  manifest.settings.emplace_back("fit", options.fit ? 1.0 : 0.0);
  manifest.settings.emplace_back("keypoints", options.keypoints ? 1.0 : 0.0);
  manifest.reading = options.read.text();
  if (options.options) {
    manifest.options = options.options->checksum;
    manifest.settings.emplace_back("switch_penalty", options.switch_penalty);
    manifest.settings.emplace_back("rescue_reward", options.rescue_reward);
  }
  return manifest;
}

/// The folder's own manifest where it is one of this run's settings; a new one where there is none.
Manifest open_manifest(const RunOptions& options, const RunFolder& folder) {
  for (std::size_t i = 0; i < options.inputs.size(); ++i)
    if (std::count(options.inputs.begin(), options.inputs.end(), options.inputs[i]) > 1)
      throw std::invalid_argument(options.inputs[i] + " is given twice");
  Manifest manifest = manifest_of(options);
  if (!std::filesystem::exists(folder.manifest())) return manifest;
  Manifest there = read_manifest(folder.manifest());
  if (!there.same_settings(manifest))
    throw std::invalid_argument(folder.root.string() + " holds a run of other settings (seed " +
                                std::to_string(there.seed) + ", " + std::to_string(there.samples) +
                                " samples, " + there.version + " for " + there.target +
                                "): give another folder, or remove it first");
  return there;
}

void write_records(const RunState& run) {
  write_file_atomically(run.folder.manifest(), format_manifest(run.manifest));
  write_file_atomically(run.folder.timing(), format_timing(run.timings, run.manifest.sequences));
}

Timing& timing_of(RunState& run, const std::string& name) {
  for (auto& t : run.timings)
    if (t.name == name) return t;
  run.timings.push_back({name, 0.0, 0.0, 0});
  return run.timings.back();
}

TrainingControl control_of(const RunState& run, const SequenceEntry& entry) {
  TrainingControl control;
  control.threads = run.options.threads;
  control.limit_seconds = run.options.limit_seconds;
  control.should_stop = run.context.should_stop;
  control.progress = [&run, &entry, started = false](std::int64_t samples,
                                                     const std::string& detail) mutable {
    const auto done = static_cast<double>(samples);
    if (!started)
      run.context.progress.start(entry.name, done, static_cast<double>(run.options.training.samples));
    started = true;
    run.context.progress.update(done, detail);
  };
  return control;
}

/// The clip with what acts on it, and the agents to start from.
struct Task {
  std::shared_ptr<const rl::TrackingClip> clip;
  std::vector<rl::Agent> agents;
};

/// The arrangement as {first frame, option} per stretch.
std::vector<std::array<int, 2>> stretches_of(const std::vector<int>& options) {
  std::vector<std::array<int, 2>> stretches;
  for (std::size_t t = 0; t < options.size(); ++t)
    if (t == 0 || options[t] != options[t - 1]) stretches.push_back({static_cast<int>(t), options[t]});
  return stretches;
}

/// Chooses the options of every frame (Eq. 4) and keeps those that occur.
Task arrange(const RunOptions& run, const std::shared_ptr<const rl::TrackingClip>& plain,
             SequenceEntry& entry) {
  std::vector<const rl::Option*> all;
  for (const TrainedOption& trained : run.options->options) all.push_back(&trained.option);
  const auto seen = rl::encoded_for(plain, all);
  const rl::SideBySide rewards =
      rl::roll_out_side_by_side(seen, run.training.tracking, all, run.rescue_reward);
  // The option of frame t acts towards frame t + 1: the reward of its choice is found there.
  std::vector<std::vector<double>> earned(rewards.rewards.begin() + 1, rewards.rewards.end());
  std::vector<int> chosen = select_options(earned, run.switch_penalty).options;
  chosen.push_back(chosen.back());
  entry.arrangement = stretches_of(chosen);
  if (!rewards.breaks.empty())
    entry.notes.push_back("no option could follow at " + std::to_string(rewards.breaks.size()) +
                          " frames, first at frame " + std::to_string(rewards.breaks.front()));

  std::vector<int> used = chosen;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<const rl::Option*> kept;
  Task task;
  for (const int option : used) {
    kept.push_back(all[static_cast<std::size_t>(option)]);
    task.agents.push_back(kept.back()->agent);
  }
  auto clip = std::make_shared<rl::TrackingClip>(*rl::encoded_for(plain, kept));
  for (const int option : chosen)
    clip->arrangement.push_back(
        static_cast<int>(std::lower_bound(used.begin(), used.end(), option) - used.begin()));
  task.clip = clip;
  return task;
}

/// Whether the recorded forces explain the motion, into the entry.
void audit_sequence(const Reference& reference, const SimulationOptions& simulation,
                    const rl::TrackingRollout& rollout, SequenceEntry& entry) {
  SimulatedFrames motion{reference.character, reference.fps, {}, rollout.forces};
  for (const auto& pose : rollout.poses) motion.frames.push_back(pose.frame);
  const Audit audit = audit_frames(motion, simulation);
  entry.audit = summary_of(audit);
  for (const std::string& failure : audit.failures) entry.notes.push_back("audit: " + failure);
}

/// Rolls the policies out and writes what came of it. @return the roll-out's scores in the entry
void finish_sequence(const RunState& run, const PreparedMotion& motion, const Task& task,
                     const TrainingResult& training, SequenceEntry& entry) {
  const rl::TrackingConfig& config = run.options.training.tracking;
  const auto before = rl::roll_out(task.clip, config, rl::mean_action(task.agents));
  const auto after = rl::roll_out(task.clip, config, rl::mean_action(training.agents), run.options.substeps);
  const Reference& reference = motion.reference;
  entry.samples = training.samples;
  entry.ending = training.ending;
  entry.reward_before = before.mean_reward;
  entry.reward_after = after.mean_reward;
  if (motion.has_fit) {
    std::filesystem::create_directories(run.folder.fit(entry.name).parent_path());
    write_clip(run.folder.fit(entry.name), motion.fitted);
  }
  write_reference(run.folder.reference(entry.name), motion.input, reference);
  const Scores first = score_simulated(reference, before), last = score_simulated(reference, after);
  entry.metrics_before = first.values;
  entry.ok_before = first.success;
  entry.metrics = last.values;
  entry.ok = last.success;
  entry.reason = last.reason;
  audit_sequence(reference, config.simulation, after, entry);
  entry.output = RunFolder::motion_name(entry.name, entry.ok);
  std::filesystem::create_directories((run.folder.root / entry.output).parent_path());
  std::filesystem::remove(run.folder.root / RunFolder::motion_name(entry.name, !entry.ok));
  write_simulated(run.folder.root / entry.output, motion.input, reference, after, entry.notes);
  std::filesystem::remove(run.folder.substeps(entry.name));
  if (run.options.substeps) {
    std::filesystem::create_directories(run.folder.substeps(entry.name).parent_path());
    write_substeps(run.folder.substeps(entry.name),
                   {reference.character, config.simulation, after.substeps, after.last_state});
  }
}

/// What reading and preparation found: who sees a wrong axis need not wait for the end of the training.
void tell_before_training(const RunState& run, const SequenceEntry& entry) {
  for (const auto* lines : {&entry.decisions, &entry.notes})
    for (const auto& line : *lines) run.context.messages << entry.name << ": " << line << '\n';
}

/// @param told  the first notes of the entry that were said already
/// @return whether the sequence was interrupted
bool train_sequence(RunState& run, SequenceEntry& entry, std::size_t& told) {
  const double started = steady_seconds();
  const TrainingConfig& config = run.options.training;
  PreparedMotion motion = prepare_motion(entry.input, run.options.read, run.options.fit);
  if (!run.options.keypoints) motion.reference.keypoints.reset();
  entry.frames = motion.reference.size();
  entry.fps = motion.reference.fps;
  entry.fit = motion.fit_values;
  entry.preparation = motion.preparation_values;
  entry.decisions = motion.input.decisions;
  entry.notes = motion.notes;
  tell_before_training(run, entry);
  told = entry.notes.size();
  entry.input_metrics = score_input(motion.input, motion.reference);

  const auto plain = rl::make_tracking_clip(motion.reference, config.tracking);
  const Task task =
      run.options.options ? arrange(run.options, plain, entry) : Task{plain, {untrained_agent(config)}};
  const TrainingFiles files = {run.folder.checkpoint(entry.name), run.folder.log(entry.name),
                               run.folder.falls(entry.name), entry.input_checksum};
  const TrainingResult training = train({task.clip}, task.agents, config, files, control_of(run, entry));
  Timing& timing = timing_of(run, entry.name);
  timing.training_seconds += training.seconds;
  timing.threads = run.options.threads;
  if (!training.interrupted) finish_sequence(run, motion, task, training, entry);
  timing.seconds += steady_seconds() - started;
  return training.interrupted;
}

std::string summary_of(const SequenceEntry& entry) {
  char rewards[64];
  std::snprintf(rewards, sizeof rewards, "reward %.3f -> %.3f", entry.reward_before, entry.reward_after);
  std::string line = entry.name + ": " + (entry.ok ? "ok" : "failed");
  if (!entry.reason.empty()) line += ", " + entry.reason;
  if (!entry.output.empty()) line += ", " + std::string(rewards);
  for (const auto& [name, value] : entry.metrics) {
    if (name != "gMPJPE" && name != "MPJPE") continue;
    std::snprintf(rewards, sizeof rewards, ", %s %.1f mm", name.c_str(), value);
    line += rewards;
  }
  return line;
}

/// The entry to start from. @return false where the result that is there already stands
bool begin_entry(const RunState& run, const std::string& input, SequenceEntry& entry) {
  const SequenceEntry* there = run.manifest.find(input);
  std::vector<std::string> taken;
  for (const auto& e : run.manifest.sequences) taken.push_back(e.name);
  entry.input = input;
  entry.name = there ? there->name : unique_name(input, taken);
  entry.seed = run.options.training.seed;
  entry.input_checksum = file_checksum(input);
  const bool complete = there && std::filesystem::exists(run.folder.root / there->output) &&
                        (!run.options.substeps || std::filesystem::exists(run.folder.substeps(entry.name)));
  const bool stands = complete && there->finished() && there->input_checksum == entry.input_checksum;
  if (stands) entry = *there;
  return !stands;
}

/// Writes a success in its input's own format, where the clean set is not that already. A failure has no
/// copy: that of another input of its name is removed.
void copy_clean(const RunState& run, const SequenceEntry& entry) {
  const std::filesystem::path input(entry.input);
  const std::string suffix = clean_suffix(input);
  if (suffix == ".npz" && !run.options.beside && !run.options.input_rate) return;
  const std::filesystem::path copy = run.options.beside
                                         ? input.parent_path() / (input.stem().string() + ".clean" + suffix)
                                         : run.folder.clean(entry.name, suffix);
  if (!entry.ok) {
    std::filesystem::remove(copy);
    return;
  }
  write_clean_copy(run.folder.root / entry.output, input, run.options.read, run.options.input_rate, copy);
  if (run.options.beside) run.context.messages << "  clean motion: " << copy.string() << '\n';
}

}  // namespace

TrainingConfig fine_tuning_defaults() {
  TrainingConfig config;
  config.samples = 3'000'000;
  config.characters = 128;
  config.group_size = 32;
  config.ppo.sigma_start = 0.04;
  config.ppo.sigma_end = 0.02;
  config.ppo.epochs = 6;
  config.ppo.kl_target = 0.16;
  config.ppo.critic_step_size = 1e-3;
  config.stop_reward = 0.985;
  config.stall_evaluations = 12;
  return config;
}

RunOutcome run_sequences(const RunOptions& options, const RunContext& context) {
  const RunFolder folder{options.out};
  RunState run{options, context, folder, open_manifest(options, folder), read_timing(folder.timing())};
  folder.create();
  write_records(run);
  bool all_good = true;
  double reported = steady_seconds();
  const auto report = [&] {
    write_report(folder, run.manifest);
    reported = steady_seconds();
  };
  const auto interrupted = [&](const std::string& name) {
    write_records(run);
    if (!run.manifest.sequences.empty()) report();
    context.progress.finish(name + ": interrupted; the same command continues");
    return RunOutcome::kInterrupted;
  };
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    const std::string& input = options.inputs[i];
    if (i > 0 && context.should_stop()) return interrupted(input);
    SequenceEntry entry;
    std::size_t told = 0;
    try {
      if (begin_entry(run, input, entry) && train_sequence(run, entry, told)) return interrupted(entry.name);
    } catch (const std::exception& error) {
      entry.ok = false;
      entry.reason = error.what();
      entry.output.clear();  // so that the same command tries again
    }
    run.manifest.put(entry);
    write_records(run);
    if (i + 1 == options.inputs.size() || steady_seconds() - reported > kReportSeconds) report();
    context.progress.finish(summary_of(entry));
    for (std::size_t k = told; k < entry.notes.size(); ++k)
      context.messages << "  " << entry.notes[k] << '\n';
    all_good = all_good && entry.ok;
    try {
      copy_clean(run, entry);
    } catch (const std::exception& error) {  // the motion itself is there; the same command copies again
      context.messages << "  no copy in the input's format: " << error.what() << '\n';
      all_good = false;
    }
  }
  return all_good ? RunOutcome::kAllGood : RunOutcome::kSomeFailed;
}

}  // namespace mimicx
