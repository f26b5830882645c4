#include "pipeline/pretrain.h"

#include <memory>
#include <optional>

#include "commands.h"
#include "shared_arguments.h"
#include "simulation_commands.h"

namespace mimicx::tools {
namespace {

struct PretrainArguments {
  pipeline::PretrainConfig config = program::pretrain_configuration("small");
  std::string preset = "small";
  std::optional<std::int64_t> samples;  ///< of all options together; none: that of the preset
  std::vector<std::string> settings;
};

/// The configuration with the training of the requested preset.
pipeline::PretrainConfig preset_of(const PretrainArguments& a) {
  pipeline::PretrainConfig config = a.config;
  config.training = program::pretrain_configuration(a.preset).training;
  config.training.seed = a.config.training.seed;
  if (a.samples) config.training.samples = *a.samples;
  return config;
}

}  // namespace

int pretrain_options(pipeline::PretrainConfig config, const std::vector<std::string>& settings) {
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
  command.files("DIR", a->config.inputs, "motions and folders of them");
  command.path("--out", a->config.out, "folder of the options; the same command continues it").required();
  command
      .number("--samples", a->samples, kFromZero,
              "training budget of all options together, in character steps")
      .defaults_to(std::to_string(a->config.training.samples));
  add_cluster_arguments(command, a->config.clusters);
  add_read_arguments(command, a->config.read);
  command.one_of("--preset", a->preset, {"small", "paper"},
                 "sizes of the networks, as `mimicx config` lists them");
  add_seed(command, a->config.training.seed);
  add_force(command, a->config.force);
  add_threads(command, a->config.threads);
  command.flag("--encoder", a->config.use_encoder,
               "policies observe their reference through a denoising encoder (default)", "--no-encoder");
  command.flag("--fit", a->config.fit, "first fit motions to their keypoints, if they have any (default)",
               "--no-fit");
  add_as_is(command, a->config.as_is);
  add_unfitted_keypoints(command, a->config.unfitted_keypoints);
  add_settings(command, a->settings);
  command.action([a] { return pretrain_options(preset_of(*a), a->settings); });
}

}  // namespace mimicx::tools
