#include "plan/plan_command.h"

#include <iostream>
#include <memory>

#include "audit/scene_search.h"
#include "commands.h"
#include "core/error.h"
#include "files/inputs.h"
#include "pipeline/cluster_map.h"
#include "shipped_options.h"
#include "simulation_commands.h"

namespace mimicx::tools {
namespace {

struct PlanArguments {
  plan::PlanMotionsConfig config = plan::plan_configuration();
  RunArguments more;
};

/// The scene of the only motion of the run, found from it.
void find_scene_of(run::RunConfig& run) {
  run.read.scene_from_motion = false;
  audit::FoundScene found;
  try {
    const motion::Clip clip = import::read_motion(run.inputs.front(), run.read);
    if (!clip.scene.flat()) return;
    found = audit::find_scene(clip);
  } catch (const std::exception& error) {
    return;  // the run tells why the motion cannot be read
  }
  for (const std::string& line : found.words) std::cerr << "scene: " << line << '\n';
  if (found.scene.flat())
    std::cerr << "scene: no plate found; planned on the flat floor\n";
  else
    run.read.scene = found.scene;
}

int plan(PlanArguments a) {
  a.config.run.map = pipeline::run_map(shipped_clusters());
  take_shard(a.more.shard, a.config.run);
  apply_settings(a.more.settings, a.config.planning);
  const import::ReadConfig asked = a.config.run.read;
  if (asked.scene_from_motion && !a.config.run.out.empty() &&
      files::find_motions(a.config.run.inputs, {}, nullptr).size() != 1)
    throw UsageError("plan: --scene auto with --out takes one motion; leave out --out, or plan one by one");
  return with_context(a.config.run.quiet, [&](const record::RunContext& context) {
    return run_inputs(a.config.run, a.more.json, context, [&] {
      a.config.run.read = asked;
      if (asked.scene_from_motion && !asked.scene && a.config.run.inputs.size() == 1)
        find_scene_of(a.config.run);
      return plan::plan_motions(a.config, context);
    });
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
