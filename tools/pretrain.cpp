#include "pipeline/pretrain.h"

#include <memory>

#include "commands.h"
#include "shared_arguments.h"
#include "simulation_commands.h"

namespace mimicx::tools {
namespace {

struct PretrainArguments {
  pipeline::PretrainConfig config = program::pretrain_configuration("small");
  std::vector<std::string> settings;
};

}  // namespace

int pretrain_options(pipeline::PretrainConfig config, const std::vector<std::string>& settings) {
  require_own_folder(config.inputs, config.out);
  config.clusters.seed = config.training.seed;
  apply_settings(settings, config.training);
  return with_context(false,
                      [&](const record::RunContext& context) { return pipeline::pretrain(config, context); });
}

void declare_pretrain(CommandLine& line) {
  const auto a = std::make_shared<PretrainArguments>();
  Command command =
      line.add("pretrain", "Train an option policy for every cluster of motions",
               "mimicx pretrain DIR --out out/options                              # hours\n"
               "mimicx pretrain DIR --out out/options --clusters 5 --samples 20M   # five options, sooner");
  command.choice_of<bool>(
      "--method", false, {{"options", false}, {"printed", true}},
      [a](bool printed) {
        if (printed) program::use_printed_method(a->config);
      },
      "printed: the paper's method as printed, without our additions; it changes defaults as `mimicx "
      "config` lists them");
  command.files("DIR", a->config.inputs, "motions and folders of them");
  command.folder("--out", a->config.out, "folder of the options; the same command continues it").required();
  command.number("--samples", a->config.training.samples, kFromZero,
                 "training budget of all options together, in character steps");
  add_cluster_arguments(command, a->config.clusters);
  add_read_arguments(command, a->config.read, true);
  command.choice_of<std::string>(
      "--preset", "small", {{"small", "small"}, {"large", "large"}},
      [a](const std::string& preset) {
        a->config.training.hidden = program::pretrain_configuration(preset).training.hidden;
      },
      "sizes of the networks; large: those of the paper, as far as its file sizes tell",
      {{"paper", "large"}});
  add_seed(command, a->config.training.seed);
  add_force(command, a->config.force);
  add_threads(command, a->config.threads);
  command.flag("--encoder", a->config.use_encoder,
               "policies observe their reference through a denoising encoder (default)", "--no-encoder");
  command.flag("--fit", a->config.correction.fit,
               "first fit motions to their keypoints, if they have any (default)", "--no-fit");
  add_as_is(command, a->config.correction.as_is);
  add_unfitted_keypoints(command, a->config.correction.unfitted_keypoints);
  add_settings(command, a->settings);
  command.action([a] { return pretrain_options(a->config, a->settings); });
}

}  // namespace mimicx::tools
