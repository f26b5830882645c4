/// The subcommands of `mimicx`, one file each.
///
/// Every `add_…` declares its options and sets `run` when its subcommand is the one that was called. `run`
/// returns the exit status: 0 all good, 1 some inputs failed (the rest is done), 2 wrong usage.
/// A command prints results on standard output, progress and complaints on standard error.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>

namespace mimicx {

inline constexpr int kAllGood = 0;
inline constexpr int kSomeFailed = 1;
inline constexpr int kWrongUsage = 2;

/// The command line asks for something that cannot be: exit status 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Run = std::function<int()>;

void add_imitate(CLI::App& app, Run& run);
void add_evaluate(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_convert(CLI::App& app, Run& run);
void add_synth(CLI::App& app, Run& run);

}  // namespace mimicx
