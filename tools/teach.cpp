#include "teaching/teach_command.h"

#include <memory>

#include "commands.h"
#include "files/inputs.h"
#include "shared_arguments.h"
#include "simulation_commands.h"

namespace mimicx::tools {
namespace {

struct TeachArguments {
  teaching::TeachConfig config = program::teach_configuration();
  std::vector<std::string> settings;
};

int teach(TeachArguments a) {
  apply_settings(a.settings, a.config);
  if (a.config.planning.run.inputs.empty() && a.config.plans.empty())
    throw UsageError("teach: expected motions to plan, or --plans");
  require_own_folder(a.config.planning.run.inputs, a.config.out);
  require_inputs_apart(a.config.planning.run.inputs, a.config.out / "plans");
  return with_context(false, [&](const record::RunContext& context) {
    run::RunConfig& run = a.config.planning.run;
    if (!run.inputs.empty()) {
      const auto found = files::find_motions(run.inputs, a.config.out, &context.messages);
      run.inputs = files::paths_of(found);
    }
    return teaching::teach_options(a.config, context);
  });
}

}  // namespace

void declare_teach(CommandLine& line) {
  const auto a = std::make_shared<TeachArguments>();
  Command command =
      line.add("teach", "Teach option policies by plans: one for every cluster of motions",
               "mimicx teach DIR --out out/options                  # plan all of it, then teach\n"
               "mimicx teach --plans out/run --out out/options      # by existing plans");
  run::RunConfig& run = a->config.planning.run;
  command.optional_files("FILE", run.inputs, "motions and folders of them, to plan first");
  command.texts("--plans", a->config.plans, "DIR", "folder of a run of `mimicx plan --gains`; repeatable");
  command.folder("--out", a->config.out, "folder of the options; the same command continues it").required();
  command.number("--clusters", a->config.clusters.clusters, kFromOne, "number of options");
  add_read_arguments(command, run.read, true);
  add_fit_arguments(command, run);
  add_seed(command, a->config.school.seed);
  add_force(command, run.force);
  add_threads(command, run.threads);
  add_settings(command, a->settings);
  command.action([a] { return teach(*a); });
}

}  // namespace mimicx::tools
