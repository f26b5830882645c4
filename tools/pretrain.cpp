#include "pipeline/pretrain.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "training.h"

namespace mimicx::tools {
namespace {

struct Arguments {
  pipeline::PretrainConfig config = pipeline::pretrain_configuration("small");
  std::string preset = "small";
  std::optional<std::int64_t> samples;  ///< of all options together; none: what the preset says
  std::vector<std::string> settings;
};

/// The configuration with the training of the preset that was asked for.
pipeline::PretrainConfig preset_of(const Arguments& a) {
  pipeline::PretrainConfig config = a.config;
  config.training = pipeline::pretrain_configuration(a.preset).training;
  config.training.seed = a.config.training.seed;
  if (a.samples) config.training.samples = *a.samples;
  return config;
}

}  // namespace

int pretrain_options(pipeline::PretrainConfig config, const std::vector<std::string>& settings) {
  config.clusters.seed = config.training.seed;
  apply_settings(settings, config.training);
  return with_context(
      [&](const pipeline::record::RunContext& context) { return pipeline::pretrain(config, context); });
}

void declare_pretrain(CLI::App& app, Action& action) {
  const auto a = std::make_shared<Arguments>();
  auto* command = app.add_subcommand("pretrain", "Train an option policy for every cluster of motions");
  command->add_option("DIR", a->config.inputs, "motions and folders of them")->required();
  command
      ->add_option("--out", a->config.out, "folder of the options; the same command continues what is there")
      ->check(refuse_empty_path)
      ->required();
  command->add_option("--samples", a->samples, "training budget of all options together, in character steps")
      ->check(CLI::NonNegativeNumber)
      ->default_str(std::to_string(a->config.training.samples));
  add_cluster_arguments(*command, a->config.clusters);
  add_read_arguments(*command, a->config.read);
  command
      ->add_option("--preset", a->preset,
                   "sizes of the networks: small or paper, as `mimicx config` lists them")
      ->check(CLI::IsMember({"small", "paper"}))
      ->capture_default_str();
  add_seed(*command, a->config.training.seed);
  add_force(*command, a->config.force);
  add_threads(*command, a->config.threads);
  command->add_flag("--encoder,!--no-encoder", a->config.use_encoder,
                    "policies see their reference through a denoising encoder (default)");
  command->add_flag("--fit,!--no-fit", a->config.fit,
                    "move motions onto their keypoints first, where they have any (default)");
  add_settings(*command, a->settings);
  command->callback([a, &action] { action = [a] { return pretrain_options(preset_of(*a), a->settings); }; });
}

}  // namespace mimicx::tools
