#include "simulation_commands.h"

#include <cstdlib>
#include <iostream>

#include "command_line_numbers.h"
#include "commands.h"
#include "core/error.h"
#include "core/file.h"
#include "files/inputs.h"
#include "interrupts.h"
#include "record/json.h"
#include "record/outputs.h"
#include "record/run_folder.h"
#include "record/shard.h"
#include "record/utf8_names.h"
#include "run/run_outputs.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

int status_of(record::RunOutcome outcome) {
  switch (outcome) {
    case record::RunOutcome::kAllGood:
      return kAllGood;
    case record::RunOutcome::kSomeFailed:
      return kSomeFailed;
    case record::RunOutcome::kInterrupted:
      return kInterrupted;
  }
  return kSomeFailed;
}

}  // namespace

void add_settings(Command& command, std::vector<std::string>& settings) {
  command.texts("--set", settings, "NAME=NUMBER",
                "change a setting by the name that `mimicx config` lists, for experiments; repeatable");
}

void for_each_setting(const std::vector<std::string>& settings,
                      const std::function<void(const std::string& name, double value)>& apply,
                      const std::function<void()>& check) {
  for (const std::string& setting : settings) {
    const auto equals = std::min(setting.find('='), setting.size() - 1);
    const std::optional<double> value = number_of(setting.substr(equals + 1));
    if (!value) throw UsageError("--set: expected NAME=NUMBER, found '" + setting + "'");
    try {
      apply(setting.substr(0, equals), *value);
    } catch (const std::invalid_argument& error) {
      throw UsageError("--set " + setting + ": " + error.what());
    }
  }
  try {
    check();
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--set: ") + error.what());
  }
}

void add_run_arguments(Command& command, run::RunConfig& run, RunArguments& more) {
  command.files("FILE", run.inputs, "motions and folders of them");
  command.folder(
      "--out", run.out,
      "folder of the run; the same command continues it; default: NAME.mimicx beside "
      "every input, with its clean motion as NAME.clean.EXT. Its clean/ is for trainers and viewers of "
      "SMPL bodies: the inputs' own formats and body models; its motions/ has our body and the forces");
  add_read_arguments(command, run.read, true);
  command.choice("--rate", run.input_rate, {{"30", false}, {"input", true}},
                 "frame rate of the clean copies in the inputs' own formats");
  command.flag("--substeps", run.substeps,
               "also write substeps/NAME.npz: every physics step of the result, for an exact audit");
  command.flag("--quiet", run.quiet, "print only failures");
  add_force(command, run.force);
  add_threads(command, run.threads);
  run.jobs = 0;
  command.number("--jobs", run.jobs, kFromZero,
                 "motions done in parallel, each with its share of the threads; the results are the same; "
                 "0: as many as threads");
  command.text(
      "--shard", [&more](const std::string& text) { more.shard = text; }, "I/N|whole",
      "do shard I of N (from 0) of the motions, for N machines with the same --out; then `mimicx merge`; "
      "default: the shard of the Slurm array task, else whole");
  command.number("--limit-seconds", run.limit_seconds, kPositive,
                 "time limit per motion: ends its plan or training early; the result then depends on the "
                 "machine, and the manifest says so");
  add_settings(command, more.settings);
  add_json(command, more.json);
}

void take_shard(const std::string& asked, run::RunConfig& run) try {
  if (asked == "whole") return;
  if (asked.empty() && run.out.empty()) return;  // each motion is a run of its own
  run.shard = asked.empty() ? record::shard_of_array([](const char* name) { return std::getenv(name); })
                            : record::parse_shard(asked);
  if (run.out.empty()) throw UsageError("--shard: needs --out, the folder that all shards share");
} catch (const std::invalid_argument& error) {
  throw UsageError(error.what());
}

void add_training_arguments(Command& command, pipeline::TrainingConfig& training,
                            const std::string& samples) {
  command.number(samples, training.samples, kFromZero, "training budget per motion, in character steps");
  add_seed(command, training.seed);
}

void add_as_is(Command& command, bool& as_is) {
  command.flag("--as-is", as_is, "follow the poses unchanged: no fit and no repair, regardless of --fit",
               "--no-as-is");
}

void add_unfitted_keypoints(Command& command, bool& unfitted_keypoints) {
  command.flag("--unfitted-keypoints", unfitted_keypoints,
               "Eq. 3 rewards agreement with the keypoints of motions that were not fitted to them, too",
               "--no-unfitted-keypoints");
}

void add_fit_arguments(Command& command, run::RunConfig& run) {
  command.flag("--fit", run.correction.fit,
               "first fit motions to their keypoints, if they have any (default); --no-fit: ignore "
               "keypoints and correct the motion by its feet, the floor and balance alone, as for "
               "files without keypoints",
               "--no-fit");
  add_as_is(command, run.correction.as_is);
}

void add_gains_argument(Command& command, run::RunConfig& run) {
  command.flag("--gains", run.gains,
               "also write gains/NAME.npz: softened feedback gains around every plan, 39 kB per frame");
}

void add_arrangement_arguments(Command& command, pipeline::options::ArrangementConfig& arrangement) {
  using pipeline::options::Selector;
  command.choice(
      "--selector", arrangement.selector,
      {{"dp", Selector::kDp},
       {"beam", Selector::kBeam},
       {"single", Selector::kSingle},
       {"nearest", Selector::kNearest}},
      "how options are chosen; dp: Eq. 4 on the rewards of options side by side, the paper's; beam: "
      "a search over real roll-outs; single: the best option alone; nearest: that of the nearest "
      "cluster");
  command.number("--switch-penalty", arrangement.switch_penalty, {kAnyNumber.least, 0.0},
                 "w_p of Eq. 4, in rewards");
  command.number("--rescue-reward", arrangement.rescue.reward, {0.0, 1.0},
                 "dp: an option whose reward falls under this continues from the "
                 "state of the best one");
}

int with_context(bool quiet, const std::function<record::RunOutcome(const record::RunContext&)>& work) {
  catch_interrupts();
  record::Progress progress(std::cerr, record::stderr_is_terminal(), record::steady_seconds);
  if (quiet) progress.silence();
  try {
    return status_of(work(record::RunContext{progress, std::cerr, interrupted}));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

namespace {

/// The manifest of a finished run as JSON, with its folder.
record::Json results_of(const std::filesystem::path& folder) {
  record::Json manifest = record::Json::parse(read_file(record::RunFolder{folder}.manifest()));
  manifest["folder"] = record::to_utf8(folder.string());
  return manifest;
}

constexpr const char* kResultsAlone = "--out: expected a folder for the results alone";

/// The folders in a run's folder that hold its results.
std::vector<std::filesystem::path> result_folders(const record::RunFolder& folder) {
  std::vector<std::filesystem::path> folders = {folder.root / "shards", folder.report_clip("a").parent_path(),
                                                folder.clean("a", "").parent_path()};
  for (const std::filesystem::path& file : folder.files_of("a")) folders.push_back(file.parent_path());
  return folders;
}

/// The folder of a run of one input, beside it.
std::filesystem::path folder_beside(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + ".mimicx");
}

[[noreturn]] void refuse_json(const std::filesystem::path& json) {
  throw UsageError("--json: expected a file that is not the run's own, found " + json.string());
}

/// @param files  all inputs @param out  the folder of the run; empty: each has its own, beside it
void require_json_apart_from_all(const std::filesystem::path& json, const std::filesystem::path& out,
                                 const std::vector<std::string>& files) {
  if (json.empty() || is_standard_output(json)) return;
  if (!out.empty()) return require_json_apart(json, out);
  for (const std::string& file : files) {
    require_json_apart(json, folder_beside(file));
    if (is_within(json, run::copy_beside(file))) refuse_json(json);
  }
}

}  // namespace

void require_own_folder(const std::vector<std::string>& inputs, const std::filesystem::path& out) {
  if (out.empty()) return;
  for (const std::string& input : inputs)
    if (is_within(input, out) && is_within(out, input))
      throw UsageError(std::string(kResultsAlone) + ", found that of the inputs, " + input);
}

void require_inputs_apart(const std::vector<std::string>& inputs, const std::filesystem::path& out) {
  require_own_folder(inputs, out);
  for (const std::string& input : inputs) {
    if (out.empty() || !is_within(input, out)) continue;
    for (const std::filesystem::path& folder : result_folders({out}))
      if (is_within(input, folder))
        throw UsageError(kResultsAlone + ("; " + input) + " is an input in its " +
                         folder.filename().string() + "/");
  }
}

void require_json_apart(const std::filesystem::path& json, const std::filesystem::path& out) {
  if (json.empty() || is_standard_output(json)) return;
  if (is_within(out, json)) refuse_json(json);  // the folder itself, or one around it
  if (!is_within(json, out)) return;
  const record::RunFolder folder{out};
  std::vector<std::filesystem::path> own = result_folders(folder);
  own.insert(own.end(), {folder.manifest(), folder.journal(), folder.timing(), folder.report(),
                         folder.clusters(), out / "lock"});
  for (const std::filesystem::path& path : own)
    if (is_within(json, path)) refuse_json(json);
}

record::RunOutcome run_inputs(run::RunConfig& run, const std::filesystem::path& json,
                              const record::RunContext& context,
                              const std::function<record::RunOutcome()>& once) {
  if (!json.empty() && run.shard)
    throw UsageError(
        "--json: a shard has a part of the results; `mimicx merge` joins them, whose --json counts them");
  require_inputs_apart(run.inputs, run.out);
  record::Json runs = record::Json::array();
  const std::vector<files::MotionInput> inputs = files::find_motions(run.inputs, run.out, &context.messages);
  const std::vector<std::string> files = files::paths_of(inputs);
  require_inputs_apart(files, run.out);  // a folder of inputs may have links into that of the run
  require_json_apart_from_all(json, run.out, files);
  if (!is_standard_output(json)) record::Outputs(files, run.force).claim(json, record::kJsonOpening);
  const auto tell = [&](record::RunOutcome outcome) {
    if (!json.empty()) write_json(json, record::document({{"runs", runs}}));
    return outcome;
  };
  if (!run.out.empty()) {
    for (const files::MotionInput& input : inputs) run.names[input.path] = input.name;
    run.inputs = files;
    const record::RunOutcome outcome = once();
    if (!json.empty()) runs.push_back(results_of(run.out));
    return tell(outcome);
  }
  record::RunOutcome all = record::RunOutcome::kAllGood;
  run.beside = true;
  run.protect = files;
  run::claim_copies_beside(files, run.force);
  for (const std::filesystem::path file : files) {
    run.inputs = {file.string()};
    run.out = folder_beside(file);
    try {
      if (!std::filesystem::exists(file)) throw std::runtime_error("expected a readable file, found none");
      const record::RunOutcome outcome = once();
      if (!json.empty()) runs.push_back(results_of(run.out));
      if (outcome == record::RunOutcome::kInterrupted) return tell(outcome);
      if (outcome != record::RunOutcome::kAllGood) all = outcome;
    } catch (const std::exception& error) {  // its folder cannot be created or read, or holds another run
      context.messages << file.string() << ": left out: " << reason_of(error) << '\n';
      all = record::RunOutcome::kSomeFailed;
    }
  }
  return tell(all);
}

}  // namespace mimicx::tools
