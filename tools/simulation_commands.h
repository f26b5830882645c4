/// Shared by the subcommands that simulate motions: their arguments, interrupts, and the work of `adapt` and
/// `pretrain`, which `run` uses too.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "arguments.h"
#include "core/setting.h"
#include "program/configurations.h"

namespace mimicx::tools {

/// --set NAME=NUMBER, repeatable.
void add_settings(Command& command, std::vector<std::string>& settings);
/// Calls apply(name, value) for every NAME=NUMBER, then check().
/// @throws UsageError for a text that is no NAME=NUMBER, and if apply or check throw std::invalid_argument
void for_each_setting(const std::vector<std::string>& settings,
                      const std::function<void(const std::string& name, double value)>& apply,
                      const std::function<void()>& check);
/// @param settings  NAME=NUMBER each: settings to change, by their names in the manifest
/// @throws UsageError for an unknown name or an impossible value
template <class Config>
void apply_settings(const std::vector<std::string>& settings, Config& config) {
  for_each_setting(
      settings, [&](const std::string& name, double value) { apply_setting(config, name, value); },
      [&] { check(config); });
}

/// Arguments of a run over motions beside its configuration.
struct RunArguments {
  std::vector<std::string> settings;  ///< NAME=NUMBER each
  std::filesystem::path json;         ///< for the results; "-": standard output; empty: none
  std::string shard;                  ///< I/N or "whole"; empty: by the environment
};
/// The arguments of every run over motions.
void add_run_arguments(Command& command, run::RunConfig& run, RunArguments& more);
/// Sets the shard of the run: the requested one, else, with --out, that of this task of a Slurm array.
/// @throws UsageError for an invalid shard
void take_shard(const std::string& asked, run::RunConfig& run);
/// The arguments of a run that trains. @param samples name of the argument for the budget
void add_training_arguments(Command& command, pipeline::TrainingConfig& training, const std::string& samples);
/// --as-is.
void add_as_is(Command& command, bool& as_is);
/// --unfitted-keypoints.
void add_unfitted_keypoints(Command& command, bool& unfitted_keypoints);
/// --fit, the default, --no-fit and --as-is.
void add_fit_arguments(Command& command, run::RunConfig& run);
/// --gains.
void add_gains_argument(Command& command, run::RunConfig& run);
/// --selector, --switch-penalty and --rescue-reward.
void add_arrangement_arguments(Command& command, pipeline::options::ArrangementConfig& arrangement);

/// Calls work(context) with progress on standard error. The first interrupt requests a stop by the context, a
/// second one ends the program. @param quiet no progress @return the exit status
/// @throws UsageError for errors of the command line
int with_context(bool quiet, const std::function<record::RunOutcome(const record::RunContext&)>& work);

/// The folder of a run or of options is no folder of inputs: with those it could not be continued.
/// @param out  may be empty @throws UsageError for the input that is this folder
void require_own_folder(const std::vector<std::string>& inputs, const std::filesystem::path& out);
/// The same, and no input is among the results of the run in this folder.
/// @param inputs  files and folders @throws UsageError also for an input in a folder of results
void require_inputs_apart(const std::vector<std::string>& inputs, const std::filesystem::path& out);

/// --json must not name what a run in this folder writes: the record of the run would be lost.
/// @param json  empty, or "-", which is standard output: nothing is refused @throws UsageError
void require_json_apart(const std::filesystem::path& json, const std::filesystem::path& out);

/// Runs all inputs in the given folder; without one, each input in its own folder beside it (NAME.mimicx),
/// with its clean motion beside it (NAME.clean.EXT).
/// @param run   its inputs and folder are set for each run
/// @param once  does the run that `run` describes @param json  file for the manifests of all runs; may be
/// empty
record::RunOutcome run_inputs(run::RunConfig& run, const std::filesystem::path& json,
                              const record::RunContext& context,
                              const std::function<record::RunOutcome()>& once);

/// @param options  sets of options to start from, in the order in which they are tried: a file, a folder with
/// options.npz, or the name of a shipped set each; empty: all shipped ones
int adapt_motions(program::AdaptConfig config, const std::vector<std::string>& options,
                  const RunArguments& more);
int pretrain_options(pipeline::PretrainConfig config, const std::vector<std::string>& settings);

}  // namespace mimicx::tools
