#include "plan/plan_command.h"

#include <memory>

#include "commands.h"
#include "core/error.h"
#include "pipeline/cluster_map.h"
#include "shipped_options.h"
#include "simulation_commands.h"

namespace mimicx::tools {
namespace {

struct PlanArguments {
  plan::PlanMotionsConfig config = plan::plan_configuration();
  RunArguments more;
};

int plan(PlanArguments a) {
  a.config.run.map = pipeline::run_map(shipped_clusters());
  take_shard(a.more.shard, a.config.run);
  apply_settings(a.more.settings, a.config.planning);
  return with_context(a.config.run.quiet, [&](const record::RunContext& context) {
    return run_inputs(a.config.run, a.more.json, context,
                      [&] { return plan::plan_motions(a.config, context); });
  });
}

}  // namespace

void declare_plan(CommandLine& line) {
  const auto a = std::make_shared<PlanArguments>();
  Command command =
      line.add("plan", "Clean motions by optimal control: keypoint fit, then a plan in the simulator",
               "mimicx plan clip.bvh                    # clip.clean.bvh beside it, after seconds\n"
               "mimicx plan DIR --out out/run --gains   # every motion in a folder, with feedback gains");
  add_run_arguments(command, a->config.run, a->more);
  add_fit_arguments(command, a->config.run);
  add_gains_argument(command, a->config.run);
  command.action([a] { return plan(*a); });
}

}  // namespace mimicx::tools
