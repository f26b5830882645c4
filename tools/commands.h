/// The subcommands of `mimicx`, a file each: arguments and work.
///
/// `declare_X` adds the subcommand X to the command line, with its work, which returns the exit status. A
/// command prints results on standard output, progress and errors on standard error.
#pragma once

#include <stdexcept>

namespace mimicx::tools {

inline constexpr int kAllGood = 0;
inline constexpr int kSomeFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kInterrupted = 130;  ///< as shells report an interrupt

/// An error of the command line: exit status 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class CommandLine;

void declare_run(CommandLine& line);
void declare_plan(CommandLine& line);
void declare_pretrain(CommandLine& line);
void declare_teach(CommandLine& line);
void declare_adapt(CommandLine& line);
void declare_imitate(CommandLine& line);
void declare_evaluate(CommandLine& line);
void declare_cluster(CommandLine& line);
void declare_fit(CommandLine& line);
void declare_info(CommandLine& line);
void declare_convert(CommandLine& line);
void declare_corrupt(CommandLine& line);
void declare_audit(CommandLine& line);
void declare_certify(CommandLine& line);
void declare_report(CommandLine& line);
void declare_render(CommandLine& line);
void declare_export_mjcf(CommandLine& line);
void declare_export_policy(CommandLine& line);
void declare_synth(CommandLine& line);
void declare_scene(CommandLine& line);
void declare_merge(CommandLine& line);
void declare_config(CommandLine& line);

}  // namespace mimicx::tools
