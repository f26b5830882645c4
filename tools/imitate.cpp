#include "pipeline/imitate.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "training.h"

namespace mimicx::tools {
namespace {

struct Arguments {
  pipeline::ImitateConfig config = pipeline::imitate_configuration();
  std::vector<std::string> settings;
};

int imitate_motions(Arguments a) {
  apply_settings(a.settings, a.config.training);
  return with_context([&](const pipeline::record::RunContext& context) {
    return run_inputs(a.config.run, context, [&] { return pipeline::imitate(a.config, context); });
  });
}

}  // namespace

void declare_imitate(CLI::App& app, Action& action) {
  const auto a = std::make_shared<Arguments>();
  auto* command = app.add_subcommand("imitate", "Train a simulated character to follow each motion");
  add_run_arguments(*command, a->config.run, a->settings);
  add_training_arguments(*command, a->config.training, "--samples");
  command->add_flag("--fit", a->config.run.fit,
                    "move motions onto their keypoints first, where they have any");
  add_as_is(*command, a->config.run);
  command->callback([a, &action] { action = [a] { return imitate_motions(*a); }; });
}

}  // namespace mimicx::tools
