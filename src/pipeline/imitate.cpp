#include "pipeline/imitate.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "core/npz.h"
#include "motion/reference.h"
#include "pipeline/motion_output.h"
#include "pipeline/run_report.h"
#include "pipeline/scores.h"
#include "rl/tracking_rollout.h"

namespace mimicx {
namespace {

struct RunState {
  const ImitateOptions& options;
  const ImitateContext& context;
  RunFolder folder;
  Manifest manifest;
  std::vector<Timing> timings;
};

Manifest manifest_of(const ImitateOptions& options) {
  Manifest manifest;
  manifest.version = MIMICX_VERSION;
  manifest.target = MIMICX_TARGET;
  manifest.seed = options.training.seed;
  manifest.samples = options.training.samples;
  manifest.settings = settings_of(options.training);
  return manifest;
}

/// The folder's own manifest where it is one of this run's settings; a new one where there is none.
Manifest open_manifest(const ImitateOptions& options, const RunFolder& folder) {
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

NamedValues values_of(const PreparationReport& r) {
  return {{"floor_shift_mm", r.floor_shift_mm},
          {"max_floor_shift_mm", r.max_floor_shift_mm},
          {"hinge_residual_mean_mm", r.hinge_residual_mean_mm},
          {"hinge_residual_max_mm", r.hinge_residual_max_mm},
          {"change_mean_mm", r.change_mean_mm},
          {"change_max_mm", r.change_max_mm},
          {"foot_level_deg", r.foot_level_deg},
          {"flagged_frames", static_cast<double>(r.flagged_frames)}};
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

/// Rolls the policy out and writes what came of it. @return the roll-out's scores in the entry
void finish_sequence(const RunState& run, const Clip& clip,
                     const std::shared_ptr<const rl::TrackingClip>& tracking, const TrainingResult& training,
                     SequenceEntry& entry) {
  const TrainingConfig& config = run.options.training;
  const auto before = rl::roll_out(tracking, config.tracking, rl::mean_action(untrained_agent(config)));
  const auto after = rl::roll_out(tracking, config.tracking, rl::mean_action(training.agent));
  const Reference& reference = tracking->reference;
  entry.samples = training.samples;
  entry.ending = training.ending;
  entry.reward_before = before.mean_reward;
  entry.reward_after = after.mean_reward;
  write_simulated(run.folder.motion(entry.name), clip, reference, after, entry.notes);
  write_reference(run.folder.reference(entry.name), reference);
  entry.output = RunFolder::motion_name(entry.name);
  const Scores scores = score_simulated(reference, after);
  entry.metrics = scores.values;
  entry.ok = scores.success;
  entry.reason = scores.reason;
}

/// @return whether the sequence was interrupted
bool train_sequence(RunState& run, SequenceEntry& entry) {
  const double started = steady_seconds();
  const Clip clip = read_clip(entry.input);
  entry.notes = clip.warnings;
  PreparationReport report;
  const Reference reference = prepare_reference(clip, {}, &report);
  entry.frames = reference.size();
  entry.fps = reference.fps;
  entry.preparation = values_of(report);
  entry.notes.insert(entry.notes.end(), report.notes.begin(), report.notes.end());
  entry.input_metrics = score_input(clip, reference);

  const auto tracking = rl::make_tracking_clip(reference, run.options.training.tracking);
  const TrainingFiles files = {run.folder.checkpoint(entry.name), run.folder.log(entry.name),
                               run.folder.falls(entry.name), entry.input_checksum};
  const TrainingResult training = train(tracking, run.options.training, files, control_of(run, entry));
  Timing& timing = timing_of(run, entry.name);
  timing.training_seconds += training.seconds;
  timing.threads = run.options.threads;
  if (!training.interrupted) finish_sequence(run, clip, tracking, training, entry);
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
  const bool stands = there && there->finished() && there->input_checksum == entry.input_checksum;
  if (stands) entry = *there;
  return !stands;
}

}  // namespace

ImitateOutcome imitate(const ImitateOptions& options, const ImitateContext& context) {
  const RunFolder folder{options.out};
  RunState run{options, context, folder, open_manifest(options, folder), read_timing(folder.timing())};
  folder.create();
  write_records(run);
  bool all_good = true;
  for (const auto& input : options.inputs) {
    SequenceEntry entry;
    try {
      if (begin_entry(run, input, entry) && train_sequence(run, entry)) {
        write_records(run);
        context.progress.finish(entry.name + ": interrupted; the same command continues");
        return ImitateOutcome::kInterrupted;
      }
    } catch (const std::exception& error) {
      entry.ok = false;
      entry.reason = error.what();
    }
    all_good = all_good && entry.ok;
    run.manifest.put(entry);
    write_records(run);
    write_report(folder, run.manifest);
    context.progress.finish(summary_of(entry));
    for (const auto& note : entry.notes) context.messages << "  " << note << '\n';
  }
  return all_good ? ImitateOutcome::kAllGood : ImitateOutcome::kSomeFailed;
}

}  // namespace mimicx
