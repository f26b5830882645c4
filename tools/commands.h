/// The subcommands of `mimicx`, a file each: what the command line may ask for, and the work.
///
/// `declare_X` adds the subcommand X to the command line. Where the user asks for X, `action` becomes its
/// work, which returns the exit status. A command prints results on standard output, progress and complaints
/// on standard error.
#pragma once

#include <functional>
#include <stdexcept>

namespace CLI {
class App;
}

namespace mimicx::tools {

inline constexpr int kAllGood = 0;
inline constexpr int kSomeFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kInterrupted = 130;  ///< as shells report an interrupt

/// The command line asks for something that cannot be: exit status 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Action = std::function<int()>;

void declare_run(CLI::App& app, Action& action);
void declare_plan(CLI::App& app, Action& action);
void declare_pretrain(CLI::App& app, Action& action);
void declare_adapt(CLI::App& app, Action& action);
void declare_imitate(CLI::App& app, Action& action);
void declare_evaluate(CLI::App& app, Action& action);
void declare_cluster(CLI::App& app, Action& action);
void declare_fit(CLI::App& app, Action& action);
void declare_info(CLI::App& app, Action& action);
void declare_convert(CLI::App& app, Action& action);
void declare_corrupt(CLI::App& app, Action& action);
void declare_audit(CLI::App& app, Action& action);
void declare_export_mjcf(CLI::App& app, Action& action);
void declare_synth(CLI::App& app, Action& action);
void declare_config(CLI::App& app, Action& action);

}  // namespace mimicx::tools
