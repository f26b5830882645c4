#include "pipeline/adapt.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <system_error>

#include "commands.h"
#include "training.h"

namespace mimicx {
namespace {

struct Arguments {
  AdaptConfig config = adapt_configuration();
  std::string options;
  std::vector<std::string> settings;
};

/// data/options of the source tree that holds this program, or of the folder it was started in.
std::filesystem::path shipped_options() {
  const std::filesystem::path relative = std::filesystem::path("data") / "options";
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (std::filesystem::path at = program.parent_path(); !error && at != at.root_path();
       at = at.parent_path())
    if (std::filesystem::exists(at / relative / "options.npz")) return at / relative;
  if (std::filesystem::exists(relative / "options.npz")) return relative;
  throw UsageError("found no data/options beside the program: name trained options with --options");
}

}  // namespace

int adapt_motions(AdaptConfig config, std::filesystem::path options,
                  const std::vector<std::string>& settings) {
  if (options.empty()) options = shipped_options();
  config.options = read_options(options);
  apply_settings(settings, config.training);
  return with_context([&](const RunContext& context) {
    return run_inputs(config.run, context, [&] { return adapt(config, context); });
  });
}

void declare_adapt(CLI::App& app, Action& action) {
  const auto a = std::make_shared<Arguments>();
  auto* command = app.add_subcommand(
      "adapt", "Clean motions: keypoint fit, then trained options chosen and fine-tuned for each");
  add_run_arguments(*command, a->config.run, a->config.training, a->settings, "--budget-samples");
  command->add_flag(
      "--fit,!--no-fit", a->config.run.fit,
      "move motions onto their keypoints first, where they have any (default); --no-fit: do not "
      "look at keypoints at all");
  command->add_option(
      "--options", a->options,
      "trained options: a file, or a folder with options.npz; default: those in data/options");
  add_arrangement_arguments(*command, a->config.arrangement);
  command->callback(
      [a, &action] { action = [a] { return adapt_motions(a->config, a->options, a->settings); }; });
}

}  // namespace mimicx
