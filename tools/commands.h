/// The subcommands of `mimicx`, one file each: what the command line asks for, and the work.
///
/// mimicx.cpp declares the options and calls these. Each returns the exit status. A command prints results on
/// standard output, progress and complaints on standard error.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion/synth_set.h"
#include "pipeline/imitate.h"

namespace mimicx {

inline constexpr int kAllGood = 0;
inline constexpr int kSomeFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kInterrupted = 130;  ///< as shells report an interrupt

/// The command line asks for something that cannot be: exit status 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param settings  NAME=NUMBER each: settings to change, by their names in the manifest
int run_imitate(ImitateOptions options, const std::vector<std::string>& settings);
/// @param json  where to write every value as well; empty: nowhere
int run_evaluate(const std::filesystem::path& truth, const std::filesystem::path& motions,
                 const std::filesystem::path& json);
int run_info(const std::filesystem::path& file);
int run_convert(const std::filesystem::path& in, const std::filesystem::path& out);

struct SynthArguments {
  std::filesystem::path out;  ///< folder of a set; empty: none is written
  std::filesystem::path
      data_set;  ///< folder that gets the project's own test and training split; empty: none
  SynthSetOptions set;
};
int run_synth(const SynthArguments& arguments);

}  // namespace mimicx
