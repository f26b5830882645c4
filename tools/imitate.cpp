#include "pipeline/imitate_command.h"

#include <memory>

#include "commands.h"
#include "simulation_commands.h"

namespace mimicx::tools {
namespace {

struct ImitateArguments {
  pipeline::ImitateConfig config = program::imitate_configuration();
  RunArguments more;
};

int imitate_motions(ImitateArguments a) {
  take_shard(a.more.shard, a.config.run);
  apply_settings(a.more.settings, a.config.training);
  return with_context(a.config.run.quiet, [&](const record::RunContext& context) {
    return run_inputs(a.config.run, a.more.json, context,
                      [&] { return pipeline::imitate(a.config, context); });
  });
}

}  // namespace

void declare_imitate(CommandLine& line) {
  const auto a = std::make_shared<ImitateArguments>();
  Command command = line.add(
      "imitate", "Train a policy to follow each motion, from scratch",
      "mimicx imitate clip.npz                             # clip.clean.npz beside it, after minutes\n"
      "mimicx imitate DIR --fit --samples 3M --out out/run   # a folder, fitted to keypoints first");
  add_run_arguments(command, a->config.run, a->more);
  add_training_arguments(command, a->config.training, "--samples");
  command.flag("--fit", a->config.run.correction.fit,
               "first fit motions to their keypoints, if they have any");
  add_as_is(command, a->config.run.correction.as_is);
  add_unfitted_keypoints(command, a->config.run.correction.unfitted_keypoints);
  command.action([a] { return imitate_motions(*a); });
}

}  // namespace mimicx::tools
