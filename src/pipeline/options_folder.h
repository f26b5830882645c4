/// The folder of a set of options, trained by `mimicx pretrain` or taught by `mimicx teach`.
///
///     DIR/options.npz, DIR/clusters.json, DIR/manifest.json
///
/// It holds one run, identified by its settings and inputs; the same command continues it or finds it done.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/options/option_set.h"
#include "record/json.h"
#include "record/progress.h"
#include "record/run_folder.h"

namespace mimicx::pipeline {

/// Claims all output files but those of single options. In a folder of this run all files are ours.
/// @param files  inputs, which are never overwritten
/// @throws std::invalid_argument if a file of another program would be overwritten
void claim_options(const record::RunFolder& folder, const std::vector<std::string>& files, bool force);

/// Lets the budget of the run in the folder grow. If the folder's run differs from this one only by fewer
/// `samples`, these are appended to the record's "earlier_samples". The training then spends all budgets in
/// turn, so that its bytes do not depend on where the earlier run stopped.
/// @param record  everything that the results depend on; gets the earlier budgets of the folder's run, if any
/// @return whether this command has a larger budget than the folder's run
bool let_budget_grow(const record::RunFolder& folder, record::Json& record);

/// How the run in the folder ended, if it is this one and its options are complete and unchanged.
/// @param record  everything that the results depend on @throws std::invalid_argument if the folder holds a
/// run of other settings or inputs
std::optional<record::RunOutcome> finished_outcome(const record::RunFolder& folder,
                                                   const record::Json& record);

/// Identifies the training of one option, whatever its budgets: a checkpoint of another one is not continued.
/// @param record  everything that the run's results depend on
/// @param members  names of the option's motions
std::string identity_of_option(record::Json record, const std::vector<std::string>& members);

/// Makes the folder and writes the manifest of a run that begins.
void begin_options(const record::RunFolder& folder, const record::Json& record);

/// Writes the options, then the manifest that says that they are complete.
/// @param inputs, trained  what the manifest says about each input and each option
void finish_options(const record::RunFolder& folder, const options::OptionSet& set,
                    const record::Json& record, const record::Json& inputs, const record::Json& trained);

}  // namespace mimicx::pipeline
