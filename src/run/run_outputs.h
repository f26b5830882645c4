/// The files that a run will write, claimed before any work (record/outputs.h).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "record/manifest.h"
#include "record/outputs.h"
#include "record/run_folder.h"

namespace mimicx::run {

/// The clean copy beside an input: NAME.clean.EXT.
std::filesystem::path copy_beside(const std::filesystem::path& input);

/// Claims the clean copies beside all inputs of a command.
/// @throws OutputRefused if a copy is an input, a file of another program, or the copy of two inputs
void claim_copies_beside(const std::vector<std::string>& inputs, bool force);

/// The inputs, spelled as in the manifest if it has them in another spelling.
std::vector<std::string> as_recorded(const std::vector<std::string>& inputs,
                                     const record::Manifest& manifest);

/// Names of the inputs in the folder: those of the manifest, else new ones in order.
/// @param wanted  names of inputs; others have their file names
std::map<std::string, std::string> sequence_names(const std::vector<std::string>& inputs,
                                                  const std::map<std::string, std::string>& wanted,
                                                  const record::Manifest& manifest);

/// Claims everything that a run writes into its folder. If the folder already holds a run, all its files are
/// ours.
/// @throws OutputRefused as Outputs does
void claim_run(const record::RunFolder& folder, const std::map<std::string, std::string>& names,
               bool continued, record::Outputs& outputs);

}  // namespace mimicx::run
