/// What the subcommands that simulate motions have in common: their arguments, interrupts, and what `run`
/// does with two of them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/configurations.h"

namespace CLI {
class App;
}

namespace mimicx {

/// --set NAME=NUMBER, repeatable.
void add_settings(CLI::App& command, std::vector<std::string>& settings);
/// @param settings  NAME=NUMBER each: settings to change, by their names in the manifest
/// @param apply  changes one @param check  looks at all of them, at the end
/// @throws UsageError for a setting that `apply` or `check` does not take
void apply_settings(const std::vector<std::string>& settings,
                    const std::function<void(const std::string& name, double value)>& apply,
                    const std::function<void()>& check);
/// By the configuration's own apply_setting and check.
template <class Config>
void apply_settings(const std::vector<std::string>& settings, Config& config) {
  apply_settings(
      settings, [&](const std::string& name, double value) { apply_setting(config, name, value); },
      [&] { check(config); });
}

/// The arguments of a run over motions.
void add_run_arguments(CLI::App& command, RunConfig& run, std::vector<std::string>& settings);
/// The budget and the seed of a training. @param samples  name of the argument for the budget
void add_training_arguments(CLI::App& command, TrainingConfig& training, const std::string& samples);
/// --fit and --no-fit.
void add_fit_flag(CLI::App& command, bool& fit);
/// --gains.
void add_gains_flag(CLI::App& command, bool& gains);

/// --switch-penalty and --rescue-reward.
void add_arrangement_arguments(CLI::App& command, ArrangementConfig& arrangement);

/// Calls work(context) with progress on standard error; the first interrupt makes the context ask to stop, a
/// second one ends the program. @return the exit status
/// @throws UsageError for what the command line got wrong
int with_context(const std::function<RunOutcome(const RunContext&)>& work);

/// Runs all inputs in the folder that was named; without one, every input in a folder beside it
/// (NAME.mimicx), its clean motion beside it (NAME.clean.EXT).
/// @param run   its inputs and folder are changed from run to run
/// @param once  does the run that `run` then describes
RunOutcome run_inputs(RunConfig& run, const RunContext& context, const std::function<RunOutcome()>& once);

/// @param options  trained options to start from: a file, or a folder with options.npz; empty: the shipped
/// ones
int adapt_motions(AdaptConfig config, std::filesystem::path options,
                  const std::vector<std::string>& settings);
int pretrain_options(PretrainConfig config, const std::vector<std::string>& settings);

}  // namespace mimicx
