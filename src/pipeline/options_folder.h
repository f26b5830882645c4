/// The folder of a set of options, whoever made them: trained by `mimicx pretrain` or taught by `mimicx
/// teach`.
///
///     DIR/options.npz, DIR/clusters.json, DIR/manifest.json
///
/// It holds one run of one record of settings and inputs; the same command continues it or finds it done.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "record/json.h"
#include "record/run_context.h"
#include "record/run_folder.h"

namespace mimicx::pipeline {

/// Claims what does not have an option's number in its name. In a folder of this run all of it is ours.
/// @param files  inputs, never to be overwritten
/// @throws std::invalid_argument when something would be overwritten that no run made
void claim_options(const record::RunFolder& folder, const std::vector<std::string>& files, bool force);

/// Lets the budget of the run in the folder grow: where it is this one but for fewer `samples`, those go into
/// the record's "earlier_samples", behind those that are there already. The training then spends every budget
/// in turn, so that its bytes do not depend on how far the run before had come.
/// @param record  what the results depend on; gets the earlier budgets of the run in the folder, if any
/// @return whether it grows now
bool let_budget_grow(const record::RunFolder& folder, record::Json& record);

/// How the run in the folder ended, where it is this one and its options are there to the last byte.
/// @param record  what the results depend on
/// @throws std::invalid_argument when the folder holds a run of other settings or inputs
std::optional<record::RunOutcome> finished_outcome(const record::RunFolder& folder,
                                                   const record::Json& record);

}  // namespace mimicx::pipeline
