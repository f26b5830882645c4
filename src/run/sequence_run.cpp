#include "run/sequence_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <mutex>
#include <optional>
#include <sstream>
#include <utility>

#include "audit/scene_search.h"
#include "core/error.h"
#include "core/file.h"
#include "core/npz/npz.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "files/clean_copy.h"
#include "files/motion_output.h"
#include "judge/reference_needs.h"
#include "judge/scores.h"
#include "motion/clip_file.h"
#include "report/clip_report.h"
#include "report/clip_script_file.h"
#include "report/run_report.h"
#include "run/preparation.h"
#include "run/run_messages.h"
#include "run/run_outputs.h"
#include "run/run_state.h"
#include "run/sequence_result.h"

namespace mimicx::run {
namespace {

/// Time between two reports of a running run: at least so many seconds, and so many times as long as the last
/// report took. A report reads all motions; this way it takes at most a hundredth of the time.
constexpr double kReportSeconds = 30.0, kReportShare = 100.0;

/// The work on one motion: the run, and this motion's own context and threads. With several in parallel,
/// `run` is only read; `publish` changes it under a lock.
struct Worker {
  const RunState& run;
  record::RunContext context;
  int threads;
};

PreparedMotion prepared(const RunConfig& config, const std::string& input, int threads) {
  return prepare_motion(input, config.read, config.correction, threads);
}

bool is_readable(const RunConfig& config, const std::string& input) {
  try {
    import::read_motion(input, config.read);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

/// Remakes damaged input, fit and reference files of a finished sequence; reports other damaged files.
void restore_files(const Worker& worker, const record::SequenceEntry& entry,
                   const std::vector<std::string>& damaged) {
  const RunState& run = worker.run;
  std::optional<PreparedMotion> motion;  // prepared once, if a file needs it
  for (const std::string& name : damaged) {
    const std::filesystem::path file = run.folder.root / name;
    const bool input = file == run.folder.input(entry.name), fit = file == run.folder.fit(entry.name),
               again = input || fit || file == run.folder.reference(entry.name);
    worker.context.messages << entry.name << ": " << name << " is gone or damaged"
                            << (again ? ": made again\n" : ", and is not made again\n");
    if (!again) continue;
    if (!motion) motion = prepared(run.config, entry.input, worker.threads);
    make_folder(file.parent_path());
    if (input)
      files::write_input(file, motion->input);
    else if (fit)
      motion::write_clip(file, motion->fitted);
    else
      files::write_reference(file, motion->input, motion->reference);
  }
}

/// Whether a training spent its budget and now has a larger one.
bool goes_on(const RunState& run, const record::SequenceEntry& there) {
  return there.spent_its_budget() && there.samples < run.method.samples;
}

/// Fills in what is known before any work on an input. @param there  its earlier result, or null
/// @return false if that result is kept
bool begin_entry(const Worker& worker, const std::string& input, const record::SequenceEntry* there,
                 record::SequenceEntry& entry) {
  const RunState& run = worker.run;
  entry.input = input;
  entry.name = run.names.at(input);
  entry.seed = run.method.seed;
  entry.input_checksum = record::file_checksum(input);
  const auto has = [](const std::filesystem::path& file) { return std::filesystem::exists(file); };
  const bool complete = there && has(run.folder.root / there->output) &&
                        (!run.config.substeps || has(run.folder.substeps(entry.name))) &&
                        (!run.config.gains || there->ending != record::SequenceEnding::kFollowed ||
                         has(run.folder.gains(entry.name)));
  if (!complete || !there->finished()) return true;
  if (there->input_checksum != entry.input_checksum) {
    worker.context.messages << entry.name << ": " << input << " has changed since its result: made again\n";
    return true;
  }
  if (goes_on(run, *there)) return true;
  const std::vector<std::string> damaged = damaged_files(run.folder, *there);
  if (std::find(damaged.begin(), damaged.end(), there->output) != damaged.end()) {
    worker.context.messages << entry.name << ": " << there->output << " is damaged: made again\n";
    return true;
  }
  entry = *there;
  restore_files(worker, entry, damaged);
  return false;
}

/// A note where a motion on the flat floor looks as if something else stood there; else empty.
std::string look_for_a_scene(const motion::Clip& clip) {
  if (!clip.scene.flat() || clip.frames() < 3) return "";
  const audit::FoundScene found = find_scene_of_file(clip);
  if (found.scene.flat()) return "";
  return "looks like steps or a seat (" + found.words.front() + "): try --scene auto, with another --out";
}

/// Reads, fits and prepares the input, and prints the decisions before any training: a user who sees a wrong
/// axis can stop the run.
JudgedMotion prepare_sequence(const Worker& worker, record::SequenceEntry& entry) {
  const RunState& run = worker.run;
  JudgedMotion motion{prepared(run.config, entry.input, worker.threads), {}, {}};
  motion.needs = judge::needs_of(motion.reference, run.method.simulation);
  motion.input_scores = judge::score_input(motion.input, motion.reference, run.method.simulation.gravity);
  entry.frames = motion.reference.size();
  entry.fps = motion.reference.fps;
  entry.fit = motion.fit_values;
  entry.preparation = motion.preparation_values;
  entry.decisions = motion.input.decisions;
  entry.notes = motion.notes;
  const bool looked = run.config.read.scene_from_motion;
  if (const std::string note = looked ? "" : look_for_a_scene(motion.input); !note.empty())
    entry.notes.push_back(note);
  entry.input_metrics = motion.input_scores.values;
  judge_reference(motion.needs, entry);
  const std::vector<std::string>& summary = motion.input.summary;
  if (run.config.quiet) return motion;
  for (const auto* lines :
       {summary.empty() ? &std::as_const(entry.decisions) : &summary, &std::as_const(entry.notes)})
    for (const auto& line : *lines) worker.context.messages << entry.name << ": " << line << '\n';
  return motion;
}

/// The outcome of the work on a motion.
struct Done {
  record::SequenceEntry entry;
  std::size_t told = 0;                   ///< notes of the entry that were printed already
  bool kept = false;                      ///< the earlier result is kept
  std::optional<std::string> error = {};  ///< that the earlier result outlived
  bool interrupted = false;               ///< only the time is recorded
  record::Timing timing;                  ///< of this time
};

/// What can be followed of a motion that is no success.
FollowedParts parts_of(const Method& method, const motion::Reference& reference,
                       const SimulatedSequence& made, const SequenceJob& job,
                       const record::SequenceEntry& entry) {
  if (entry.ok || !method.parts) return {};
  return method.parts(reference, made.after,
                      after_seconds(job, made.planning_seconds + made.training_seconds));
}

/// Whether there is an earlier result, of another input. @param there  it, or null
bool is_of_another_input(const record::SequenceEntry* there, const record::SequenceEntry& entry) {
  return there && there->input_checksum != entry.input_checksum;
}

/// Whether a file is written that only some commands ask for: this one does, or an earlier one did for the
/// same input. @param there  the earlier result, or null
bool is_wanted(bool asked, const std::filesystem::path& file, const record::SequenceEntry* there,
               const record::SequenceEntry& entry) {
  const bool same = there && !is_of_another_input(there, entry);
  return asked || (same && std::filesystem::exists(file));
}

/// Prepare → simulate → judge and write. @param there  the earlier result, or null
void do_sequence(const Worker& worker, const record::SequenceEntry* there, Done& done) {
  const RunState& run = worker.run;
  record::SequenceEntry& entry = done.entry;
  const double started = record::steady_seconds();
  const JudgedMotion motion = prepare_sequence(worker, entry);
  if (is_of_another_input(there, entry)) remove_result(run.folder, *there);
  done.told = entry.notes.size();
  const bool substeps = is_wanted(run.config.substeps, run.folder.substeps(entry.name), there, entry),
             gains = is_wanted(run.config.gains, run.folder.gains(entry.name), there, entry);
  const SequenceJob job{entry.name,     entry.input_checksum,     run.folder,   substeps,      gains,
                        worker.threads, run.config.limit_seconds, motion.needs, worker.context};
  const SimulatedSequence made = run.method.simulate(motion.reference, job);
  done.timing.planning_seconds = made.planning_seconds;
  done.timing.training_seconds = made.training_seconds;
  done.interrupted = made.interrupted;
  if (!made.interrupted) {
    if (made.begun_samples > 0)
      entry.notes.push_back("goes on from a training of " + std::to_string(made.begun_samples) +
                            " samples; one begun with more would explore longer, and be another");
    judge_sequence(motion, run.method.simulation, made, entry);
    const FollowedParts found = parts_of(run.method, motion.reference, made, job, entry);
    done.timing.planning_seconds += found.seconds;
    done.interrupted = found.interrupted;
    if (found.timed_out) entry.ending = record::SequenceEnding::kLimitSeconds;
    if (!done.interrupted) write_sequence(run, motion, made, found.parts, entry);
  }
  if (!done.interrupted) {
    if (static_cast<std::ptrdiff_t>(run.in_all) > report::kMostEmbedded)
      report::write_clip_script(run.folder, entry, report::report_metrics(false));
  }
  done.timing.seconds = record::steady_seconds() - started;
}

/// Removes the motion and the parts of an earlier run of the same name: `motions/` holds those of the
/// manifest.
void remove_motions(const record::RunFolder& folder, const std::string& name) {
  if (name.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(folder.root / record::RunFolder::motion_name(name, true), ignored);
  for (int k = 1; k <= record::kMostParts; ++k) std::filesystem::remove(folder.part(name, k), ignored);
}

/// Whether an earlier result stays after an error: there is one, and its input is the same or cannot be read
/// now. @param there  the earlier result, or null
bool outlives_an_error(const RunConfig& config, const std::string& input,
                       const record::SequenceEntry* there) {
  if (!there || there->output.empty()) return false;
  return record::checksum_or_none(input) == there->input_checksum || !is_readable(config, input);
}

/// All the work on one input. An error becomes its reason, or is told where an earlier result stays.
/// @param there  that result, or null
Done work_on(const Worker& worker, const std::string& input, const record::SequenceEntry* there) {
  Done done;
  try {
    done.kept = !begin_entry(worker, input, there, done.entry);
    if (!done.kept) do_sequence(worker, there, done);
  } catch (const std::exception& error) {
    if (outlives_an_error(worker.run.config, input, there)) {
      done.entry = *there;
      done.error = reason_of(error);
      return done;
    }
    done.entry.ok = false;
    done.entry.reason = reason_of(error);
    done.entry.output.clear();  // so that the same command tries again
    done.entry.parts.clear();
    if (is_of_another_input(there, done.entry)) remove_result(worker.run.folder, *there);
    remove_motions(worker.run.folder, done.entry.name);
  }
  return done;
}

/// Adds this time's seconds to those of the motion.
void add_timing(RunState& run, const std::string& name, const record::Timing& now, int threads) {
  record::Timing& timing = timing_of(run, name);
  timing.seconds += now.seconds;
  timing.planning_seconds += now.planning_seconds;
  timing.training_seconds += now.training_seconds;
  timing.threads = threads;
}

/// Removes plans that a new run finds for its motions: without a manifest nothing says with which settings
/// they were made, and an interruption must not let them pass for its own.
void remove_plans(const RunState& run) {
  std::error_code ignored;
  for (const auto& [input, name] : run.names) std::filesystem::remove(run.folder.plan(name), ignored);
}

constexpr double kToldFeet = 0.01;  ///< m

/// Writes a success in its input's format and body convention. For a failed sequence, removes an earlier
/// copy.
void copy_clean(const RunState& run, const record::SequenceEntry& entry) {
  const std::filesystem::path input(entry.input);
  const std::string suffix = files::clean_suffix(input);
  const std::filesystem::path copy =
      run.config.beside ? copy_beside(input) : run.folder.clean(entry.name, suffix);
  if (!entry.ok) {
    std::filesystem::remove(copy);
    return;
  }
  const files::CleanCopy written = files::write_clean_copy(run.folder.root / entry.output, input,
                                                           run.config.read, run.config.input_rate, copy);
  if (run.config.beside && !run.config.quiet)
    run.context.messages << "  clean motion: " << copy.string() << ", " << written.body << '\n';
  if (std::abs(written.feet) > kToldFeet && !run.config.quiet)
    run.context.messages << formatted(
        "  the copy in the input's format has the input's body with other legs than the simulated body: its "
        "feet are %.0f mm too %s\n",
        1000.0 * std::abs(written.feet), written.feet > 0.0 ? "high" : "low");
}

/// Calls `copy_clean` and prints its error. The motion itself is written already; the same command tries the
/// copy again. @return whether it succeeded
bool copied_clean(const RunState& run, const record::SequenceEntry& entry) {
  try {
    copy_clean(run, entry);
    return true;
  } catch (const std::exception& error) {
    run.context.messages << "  no copy in the input's format: " << reason_of(error) << '\n';
    return false;
  }
}

/// Does the motions of a run, one after the other or several in parallel, with the same results. In parallel,
/// the messages of a motion are printed together when it is done.
class ParallelRun {
 public:
  ParallelRun(RunState& run, int jobs) : run_(run), jobs_(jobs) {
    if (jobs_ > 1)
      run_.context.progress.start("motions", 0.0, static_cast<double>(run_.inputs.size()), "motions");
  }

  /// Works on input `i`, unless a stop was requested.
  void on(int i) {
    const std::string& input = run_.inputs[static_cast<std::size_t>(i)];
    std::optional<record::SequenceEntry> there;
    {
      const std::lock_guard guard(mutex_);
      if (stopped_ || (i > 0 && ask())) return interrupted(run_.names.at(input));
      if (const record::SequenceEntry* entry = run_.manifest.find(input)) there = *entry;
    }
    std::ostringstream said;
    record::Progress silent(said, false, [] { return 0.0; });
    const bool alone = jobs_ == 1;
    const auto should_stop = [this] {
      const std::lock_guard guard(mutex_);
      return ask();
    };
    const Worker worker{
        run_,
        {alone ? run_.context.progress : silent, alone ? run_.context.messages : said, should_stop},
        std::max(1, run_.config.threads / jobs_)};
    const Done done = work_on(worker, input, there ? &*there : nullptr);
    const std::lock_guard guard(mutex_);
    if (!alone) run_.context.messages << said.str();
    publish(input, done, worker);
  }

  /// Writes records and report after all work has ended.
  record::RunOutcome outcome() {
    if (stopped_) {
      run_.manifest.sequences.empty() ? write_records(run_) : report();
      run_.context.progress.finish(interrupted_ + ": interrupted; the same command continues");
      return record::RunOutcome::kInterrupted;
    }
    report();
    sum_up();
    return all_good_ ? record::RunOutcome::kAllGood : record::RunOutcome::kSomeFailed;
  }

 private:
  void sum_up() {
    if (run_.config.quiet || run_.inputs.size() < 2) return;
    std::vector<record::SequenceEntry> entries;
    for (const std::string& input : run_.inputs)
      if (const record::SequenceEntry* entry = run_.manifest.find(input)) entries.push_back(*entry);
    const std::string next = run_.folder.is_part()
                                 ? "when all parts are done: mimicx merge " + run_.folder.root.string()
                                 : "to look at: " + run_.folder.report().string();
    for (const std::string& line : summary(entries, record::steady_seconds() - begun_, next))
      run_.context.messages << line << '\n';
  }

  bool ask() { return stopped_ = stopped_ || run_.context.should_stop(); }

  void interrupted(const std::string& name) {
    stopped_ = true;
    if (interrupted_.empty()) interrupted_ = name;
  }

  void report() {
    const double begun = record::steady_seconds();
    write_records(run_);
    if (!run_.folder.is_part())
      report::write_report(run_.folder, run_.manifest, {.map = run_.config.map.draw, .keep = true});
    const double now = record::steady_seconds();
    next_report_ = now + std::max(kReportSeconds, kReportShare * (now - begun));
  }

  void publish(const std::string& input, const Done& done, const Worker& worker) {
    const record::SequenceEntry& entry = done.entry;
    if (done.error) {
      run_.context.progress.finish(entry.name + ": failed: " + *done.error + "; its earlier result is kept");
      all_good_ = false;
      if (jobs_ > 1) run_.context.progress.update(++finished_, "");
      return;
    }
    if (!done.kept) add_timing(run_, run_.names.at(input), done.timing, worker.threads);
    if (done.interrupted) return interrupted(entry.name);
    run_.manifest.put(entry);
    if (!done.kept) run_.journal.append(entry, timing_of(run_, entry.name));
    if (record::steady_seconds() > next_report_) report();
    tell(entry, done.told);
    const bool copied = copied_clean(run_, entry);
    all_good_ = all_good_ && entry.ok && copied;
    if (jobs_ > 1) run_.context.progress.update(++finished_, "");
  }

  /// @param told  number of notes that were printed before
  void tell(const record::SequenceEntry& entry, std::size_t told) {
    if (run_.config.quiet && entry.ok) return;
    run_.context.progress.finish(result_line(entry));
    for (const std::string& line : what_next(entry, run_.folder))
      run_.context.messages << "  " << line << '\n';
    for (std::size_t k = told; k < entry.notes.size(); ++k)
      run_.context.messages << "  " << entry.notes[k] << '\n';
  }

  RunState& run_;
  const int jobs_;
  std::mutex mutex_;
  bool stopped_ = false, all_good_ = true;
  std::string interrupted_;  ///< the first motion that was not done
  int finished_ = 0;
  const double begun_ = record::steady_seconds();
  double next_report_ = record::steady_seconds() + kReportSeconds;
};

}  // namespace

NamedValues manifest_settings(const RunConfig& config) { return settings_of(config.correction); }

record::RunOutcome run_sequences(const RunConfig& config, const Method& method,
                                 const record::RunContext& context) {
  const std::optional<record::ShardList> list = shard_list_of(config, method);
  check_folder(config, list);
  const record::RunFolder folder =
      list ? record::shard_folder(config.out, *config.shard) : record::RunFolder{config.out};
  const RunLocks locks(folder);
  RunState run = open_run(config, method, context, folder, list);
  std::vector<std::string> protect = config.protect;
  protect.insert(protect.end(), config.inputs.begin(), config.inputs.end());
  record::Outputs outputs(protect, config.force);
  const bool continued = std::filesystem::exists(folder.manifest());
  claim_run(folder, run.names, continued, outputs);
  if (list) record::agree_on(*list, folder);  // after all that may refuse the run
  if (!continued) remove_plans(run);
  folder.create();
  if (config.map.keep) config.map.keep(folder, context.messages);
  write_records(run);
  const int count = static_cast<int>(run.inputs.size());
  if (list)
    context.messages << "shard " << config.shard->index << '/' << config.shard->count << ": " << count
                     << " of " << list->inputs.size() << " motions\n";
  const int jobs = std::clamp(config.jobs > 0 ? config.jobs : config.threads, 1, std::max(count, 1));
  ParallelRun work(run, jobs);
  parallel_for(count, jobs, [&](int i) { work.on(i); });
  return work.outcome();
}

}  // namespace mimicx::run
