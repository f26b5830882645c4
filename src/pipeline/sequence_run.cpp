#include "pipeline/sequence_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/file.h"
#include "core/npz.h"
#include "motion/clip_file.h"
#include "pipeline/audit/audit.h"
#include "pipeline/audit/audit_summary.h"
#include "pipeline/audit/pose_verdict.h"
#include "pipeline/audit/substeps.h"
#include "pipeline/failure.h"
#include "pipeline/kept_files.h"
#include "pipeline/output/clean_copy.h"
#include "pipeline/output/motion_output.h"
#include "pipeline/preparation.h"
#include "pipeline/record/folder_lock.h"
#include "pipeline/record/journal.h"
#include "pipeline/record/timing.h"
#include "pipeline/reference_needs.h"
#include "pipeline/report/run_report.h"
#include "pipeline/run_outputs.h"
#include "pipeline/scores.h"

namespace mimicx::pipeline {
namespace {

constexpr std::size_t kDifferencesSaid = 4;  ///< between the settings of two runs

/// Between reports while a run goes on: s, and in parts of the time that the last one took. A report reads
/// all motions; so it costs a hundredth of the time, however many there are.
constexpr double kReportSeconds = 30.0, kReportShare = 100.0;

struct RunState {
  const RunConfig& config;
  const Method& method;
  const record::RunContext& context;
  record::RunFolder folder;
  record::Manifest manifest;
  std::vector<record::Timing> timings;
  std::vector<std::string> inputs = {};           ///< as the manifest spells them
  std::map<std::string, std::string> names = {};  ///< of the inputs, in the folder
  record::Journal journal{folder.journal()};
};

record::Manifest manifest_of(const RunConfig& config, const Method& method) {
  record::Manifest manifest;
  manifest.version = MIMICX_VERSION;
  manifest.target = MIMICX_TARGET;
  manifest.seed = method.seed;
  manifest.samples = method.samples;
  manifest.method = method.name;
  manifest.settings = method.settings;
  manifest.options = method.options;
  manifest.reading = config.read.text();
  return manifest;
}

/// The folder's own manifest where it is one of this run's settings; a new one where there is none.
record::Manifest open_manifest(const RunConfig& config, const Method& method,
                               const record::RunFolder& folder) {
  std::set<std::string> seen;
  for (const std::string& input : config.inputs)
    if (!seen.insert(input).second) throw std::invalid_argument(input + " is given twice");
  record::Manifest manifest = manifest_of(config, method);
  if (!std::filesystem::exists(folder.manifest())) return manifest;
  record::Manifest there = record::read_manifest(folder.manifest());
  if (there.samples > 0 && there.samples < manifest.samples && manifest.differences(there, true).empty())
    there.samples = manifest.samples;  // the trainings go on
  const std::vector<std::string> differences = manifest.differences(there);
  if (differences.empty()) return there;
  std::string said;
  for (std::size_t k = 0; k < std::min(differences.size(), kDifferencesSaid); ++k)
    said += (k > 0 ? "; " : "") + differences[k];
  if (differences.size() > kDifferencesSaid)
    said += "; and " + std::to_string(differences.size() - kDifferencesSaid) + " more";
  throw std::invalid_argument(folder.root.string() + " holds a run of other settings (" + said +
                              "): give another folder, or remove it first");
}

/// The run as its folder knows it, or a new one.
RunState open_run(const RunConfig& config, const Method& method, const record::RunContext& context,
                  const record::RunFolder& folder) {
  RunState run{config,
               method,
               context,
               folder,
               open_manifest(config, method, folder),
               record::read_timing(folder.timing())};
  if (std::filesystem::exists(folder.manifest()))
    record::replay_journal(folder.journal(), run.manifest, run.timings);
  run.inputs = as_recorded(config.inputs, run.manifest);
  run.names = sequence_names(run.inputs, config.names, run.manifest);
  return run;
}

/// Everything that is known, in manifest and times instead of the journal.
void write_records(RunState& run) {
  write_file_atomically(run.folder.manifest(), record::format_manifest(run.manifest));
  write_file_atomically(run.folder.timing(), record::format_timing(run.timings, run.manifest.sequences));
  run.journal.clear();
}

record::Timing& timing_of(RunState& run, const std::string& name) {
  for (auto& t : run.timings)
    if (t.name == name) return t;
  run.timings.push_back({name});
  return run.timings.back();
}

Correction correction_of(const RunConfig& config) {
  if (config.as_is) return Correction::kNone;
  return config.fit ? Correction::kKeypoints : Correction::kPoses;
}

/// Makes fit and reference of a finished sequence again where they are damaged; of other files it says so.
void restore_files(const RunState& run, const record::SequenceEntry& entry,
                   const std::vector<std::string>& damaged) {
  std::optional<PreparedMotion> motion;  // made once, where a file needs it
  for (const std::string& name : damaged) {
    const std::filesystem::path file = run.folder.root / name;
    const bool fit = file == run.folder.fit(entry.name), reference = file == run.folder.reference(entry.name);
    run.context.messages << entry.name << ": " << name << " is gone or damaged"
                         << (fit || reference ? ": made again\n" : ", and is not made again\n");
    if (!fit && !reference) continue;
    if (!motion)
      motion = prepare_motion(entry.input, run.config.read, correction_of(run.config), run.config.threads);
    make_folder(file.parent_path());
    if (fit)
      motion::write_clip(file, motion->fitted);
    else
      output::write_reference(file, motion->input, motion->reference);
  }
}

/// Whether a training ended because its budget did, and there is more of it now.
bool goes_on(const RunState& run, const record::SequenceEntry& there) {
  return there.samples > 0 && there.samples < run.method.samples &&
         (there.ending == record::Ending::kBudget || !there.ok);
}

/// Fills what is known of an input before any work. @return false where its earlier result still stands
bool begin_entry(const RunState& run, const std::string& input, record::SequenceEntry& entry) {
  const record::SequenceEntry* there = run.manifest.find(input);
  entry.input = input;
  entry.name = run.names.at(input);
  entry.seed = run.method.seed;
  entry.input_checksum = record::file_checksum(input);
  const auto has = [](const std::filesystem::path& file) { return std::filesystem::exists(file); };
  const bool complete =
      there && has(run.folder.root / there->output) &&
      (!run.config.substeps || has(run.folder.substeps(entry.name))) &&
      (!run.config.gains || there->ending != record::Ending::kFollowed || has(run.folder.gains(entry.name)));
  if (!complete || !there->finished() || there->input_checksum != entry.input_checksum) return true;
  if (goes_on(run, *there)) return true;
  const std::vector<std::string> damaged = damaged_files(run.folder, *there);
  if (std::find(damaged.begin(), damaged.end(), there->output) != damaged.end()) {
    run.context.messages << entry.name << ": " << there->output << " is damaged: made again\n";
    return true;
  }
  entry = *there;
  restore_files(run, entry, damaged);
  return false;
}

/// What the reference asks for that no body can do, into the entry.
void judge_reference(const audit::PoseNeeds& needs, record::SequenceEntry& entry) {
  if (needs.frames.empty()) return;
  const audit::PoseVerdict verdict = audit::verdict_on(needs);
  entry.feasibility = verdict.values;
  if (verdict.longest.wrong != audit::Wrong::kNothing)
    entry.notes.push_back("the reference is not feasible: " + verdict.words);
}

/// A prepared motion and what its reference asks for that no body has.
struct JudgedMotion : PreparedMotion {
  audit::PoseNeeds needs;
};

/// Reads, fits and prepares the input, and prints what was decided before any training begins: a user who
/// sees a wrong axis there can stop the run.
JudgedMotion prepare_sequence(const RunState& run, record::SequenceEntry& entry) {
  JudgedMotion motion{
      prepare_motion(entry.input, run.config.read, correction_of(run.config), run.config.threads), {}};
  motion.needs = needs_of(motion.reference);
  entry.frames = motion.reference.size();
  entry.fps = motion.reference.fps;
  entry.fit = motion.fit_values;
  entry.preparation = motion.preparation_values;
  entry.decisions = motion.input.decisions;
  entry.notes = motion.notes;
  judge_reference(motion.needs, entry);
  const std::vector<std::string>& summary = motion.input.summary;
  for (const auto* lines :
       {summary.empty() ? &std::as_const(entry.decisions) : &summary, &std::as_const(entry.notes)})
    for (const auto& line : *lines) run.context.messages << entry.name << ": " << line << '\n';
  return motion;
}

/// Whether the recorded forces explain the motion, into the entry.
void audit_sequence(const motion::Reference& reference, const physics::SimulationConfig& simulation,
                    const rl::tracking::TrackingRollout& rollout, record::SequenceEntry& entry) {
  audit::SimulatedFrames motion{reference.character, reference.fps, {}, rollout.forces};
  for (const auto& pose : rollout.poses) motion.frames.push_back(pose.frame);
  const audit::Audit audit = audit::audit_frames(motion, simulation);
  entry.audit = audit::summary_of(audit);
  for (const std::string& failure : audit.failures) entry.notes.push_back("audit: " + failure);
}

/// Scores and audit of what the method made, into the entry.
void judge_sequence(const Method& method, const motion::Reference& reference, const SimulatedSequence& made,
                    record::SequenceEntry& entry) {
  entry.method = made.method;
  entry.plan = made.plan;
  entry.policy = made.policy;
  append(entry.feasibility, help_values(made.help, reference.character.total_mass()));
  entry.samples = made.samples;
  entry.ending = made.ending;
  entry.arrangement = made.arrangement;
  entry.notes.insert(entry.notes.end(), made.notes.begin(), made.notes.end());
  if (made.before) {
    const Scores before = score_simulated(reference, *made.before);
    entry.reward_before = made.before->mean_reward;
    entry.metrics_before = before.values;
    entry.ok_before = before.success;
  }
  const Scores after = score_simulated(reference, made.after);
  entry.reward_after = made.after.mean_reward;
  entry.metrics = after.values;
  entry.ok = after.success;
  entry.reason = after.reason;
  if (!made.reason.empty()) {
    if (entry.ok)
      entry.notes.push_back(made.reason);
    else
      entry.reason = made.reason + "; " + after.reason;
  }
  audit_sequence(reference, method.simulation, made.after, entry);
}

std::filesystem::path with_parents(const std::filesystem::path& file) {
  make_folder(file.parent_path());
  return file;
}

/// Fit, reference and its feasibility, simulated motion and, where wanted, its physics steps.
void write_sequence(const RunState& run, const JudgedMotion& motion, const SimulatedSequence& made,
                    record::SequenceEntry& entry) {
  const record::RunFolder& folder = run.folder;
  if (motion.has_fit) motion::write_clip(with_parents(folder.fit(entry.name)), motion.fitted);
  output::write_reference(with_parents(folder.reference(entry.name)), motion.input, motion.reference);
  if (!motion.needs.frames.empty())
    record::write_feasibility(with_parents(folder.feasibility(entry.name)),
                              frame_feasibility(motion.needs, made.help));
  const std::string output = record::RunFolder::motion_name(entry.name, entry.ok);
  std::filesystem::remove(folder.root / record::RunFolder::motion_name(entry.name, !entry.ok));
  output::write_simulated(with_parents(folder.root / output), motion.input, motion.reference, made.after);
  std::filesystem::remove(folder.substeps(entry.name));
  if (run.config.substeps)
    audit::write_substeps(
        with_parents(folder.substeps(entry.name)),
        {motion.reference.character, run.method.simulation, made.after.substeps, made.after.last_state});
  std::filesystem::remove(folder.policy(entry.name));
  if (made.taught) output::write_policy(with_parents(folder.policy(entry.name)), motion.input, *made.taught);
  entry.output = output;
  entry.files = checksums_of(folder, entry);
}

/// Prepare → simulate → judge and write. @param told  notes of the entry that were said already
/// @return whether the sequence was interrupted
bool do_sequence(RunState& run, record::SequenceEntry& entry, std::size_t& told) {
  const double started = record::steady_seconds();
  const JudgedMotion motion = prepare_sequence(run, entry);
  told = entry.notes.size();
  if (const record::SequenceEntry* there = run.manifest.find(entry.input);
      there && goes_on(run, *there) && there->input_checksum == entry.input_checksum)
    entry.notes.push_back("goes on from a training of " + std::to_string(there->samples) +
                          " samples; one begun with more would explore longer, and be another");
  entry.input_metrics = score_input(motion.input, motion.reference);
  const SimulatedSequence made = run.method.simulate(
      motion.reference, {entry.name, entry.input_checksum, run.folder, run.config.substeps, run.config.gains,
                         run.config.threads, run.config.limit_seconds, motion.needs, run.context});
  record::Timing& timing = timing_of(run, entry.name);
  timing.planning_seconds += made.planning_seconds;
  timing.training_seconds += made.training_seconds;
  timing.threads = run.config.threads;
  if (!made.interrupted) {
    judge_sequence(run.method, motion.reference, made, entry);
    write_sequence(run, motion, made, entry);
  }
  timing.seconds += record::steady_seconds() - started;
  return made.interrupted;
}

/// "walk: ok, reward 0.912, gMPJPE 3.1 mm, MPJPE 2.8 mm"
std::string result_line(const record::SequenceEntry& entry) {
  char text[64];
  std::string line = entry.name + ": " + (entry.ok ? "ok" : "failed");
  if (!entry.reason.empty()) line += ", " + entry.reason;
  if (std::isfinite(entry.reward_before))
    std::snprintf(text, sizeof text, ", reward %.3f -> %.3f", entry.reward_before, entry.reward_after);
  else
    std::snprintf(text, sizeof text, ", reward %.3f", entry.reward_after);
  if (!entry.output.empty()) line += text;
  for (const auto& [name, value] : entry.metrics) {
    if (name != "gMPJPE" && name != "MPJPE") continue;
    std::snprintf(text, sizeof text, ", %s %.1f mm", name.c_str(), value);
    line += text;
  }
  return line;
}

/// Writes a success in its input's own format, where the clean set does not have that format already. Where
/// the sequence failed, a copy of that name from an earlier run is removed.
void copy_clean(const RunState& run, const record::SequenceEntry& entry) {
  const std::filesystem::path input(entry.input);
  const std::string suffix = output::clean_suffix(input);
  if (suffix == ".npz" && !run.config.beside && !run.config.input_rate) return;
  const std::filesystem::path copy =
      run.config.beside ? copy_beside(input) : run.folder.clean(entry.name, suffix);
  if (!entry.ok) {
    std::filesystem::remove(copy);
    return;
  }
  const std::string body = output::write_clean_copy(run.folder.root / entry.output, input, run.config.read,
                                                    run.config.input_rate, copy);
  if (run.config.beside) run.context.messages << "  clean motion: " << copy.string() << ", " << body << '\n';
}

/// Does `copy_clean` and tells what went wrong. The motion itself is written already; the same command tries
/// the copy again. @return whether nothing went wrong
bool copied_clean(const RunState& run, const record::SequenceEntry& entry) {
  try {
    copy_clean(run, entry);
    return true;
  } catch (const std::exception& error) {
    run.context.messages << "  no copy in the input's format: " << error.what() << '\n';
    return false;
  }
}

}  // namespace

NamedValues settings_of(const RunConfig& config) {
  const double fit = correction_of(config) == Correction::kKeypoints ? 1.0 : 0.0;
  return {{"fit", fit},
          {"as_is", config.as_is ? 1.0 : 0.0},
          {"keypoints", fit}};  // Eq. 3 sees keypoints where the fit does (preparation.h)
}

record::RunOutcome run_sequences(const RunConfig& config, const Method& method,
                                 const record::RunContext& context) {
  const record::RunFolder folder{config.out};
  const record::FolderLock lock(folder.root);
  RunState run = open_run(config, method, context, folder);
  std::vector<std::string> protect = config.protect;
  protect.insert(protect.end(), config.inputs.begin(), config.inputs.end());
  record::Outputs outputs(protect, config.force);
  claim_run(folder, run.names, std::filesystem::exists(folder.manifest()), outputs);
  folder.create();
  write_records(run);
  bool all_good = true;
  double next_report = record::steady_seconds() + kReportSeconds;
  const auto report = [&] {
    const double begun = record::steady_seconds();
    write_records(run);
    report::write_report(folder, run.manifest);
    const double now = record::steady_seconds();
    next_report = now + std::max(kReportSeconds, kReportShare * (now - begun));
  };
  const auto interrupted = [&](const std::string& name) {
    write_records(run);
    if (!run.manifest.sequences.empty()) report();
    context.progress.finish(name + ": interrupted; the same command continues");
    return record::RunOutcome::kInterrupted;
  };
  for (std::size_t i = 0; i < run.inputs.size(); ++i) {
    const std::string& input = run.inputs[i];
    if (i > 0 && context.should_stop()) return interrupted(input);
    record::SequenceEntry entry;
    std::size_t told = 0;
    bool kept = false;
    try {
      kept = !begin_entry(run, input, entry);
      if (!kept && do_sequence(run, entry, told)) return interrupted(entry.name);
    } catch (const std::exception& error) {
      entry.ok = false;
      entry.reason = error.what();
      entry.output.clear();  // so that the same command tries again
    }
    run.manifest.put(entry);
    if (!kept) run.journal.append(entry, timing_of(run, entry.name));
    if (i + 1 == run.inputs.size() || record::steady_seconds() > next_report) report();
    context.progress.finish(result_line(entry));
    for (const std::string& line : what_next(entry, folder)) context.messages << "  " << line << '\n';
    for (std::size_t k = told; k < entry.notes.size(); ++k)
      context.messages << "  " << entry.notes[k] << '\n';
    const bool copied = copied_clean(run, entry);
    all_good = all_good && entry.ok && copied;
  }
  return all_good ? record::RunOutcome::kAllGood : record::RunOutcome::kSomeFailed;
}

}  // namespace mimicx::pipeline
