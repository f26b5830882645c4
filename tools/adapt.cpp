#include "pipeline/adapt.h"

#include <memory>

#include "commands.h"
#include "shipped_options.h"
#include "training.h"

namespace mimicx::tools {
namespace {

struct Arguments {
  pipeline::AdaptConfig config = pipeline::adapt_configuration();
  std::filesystem::path options;
  RunArguments more;
};

/// @param given  a file or folder, or the name of a set that comes with the program; empty: the first of
/// those
/// @throws UsageError where there are none
std::filesystem::path options_to_take(const std::filesystem::path& given) {
  const auto shipped = shipped_options();
  if (!given.empty()) return shipped && !exists(given) && exists(*shipped / given) ? *shipped / given : given;
  if (shipped) return *shipped;
  throw UsageError(
      "found no data/options beside the program: name trained options with --options, or take --method plan");
}

}  // namespace

int adapt_motions(pipeline::AdaptConfig config, std::filesystem::path options,
                  const std::vector<std::string>& settings) {
  if (config.method == pipeline::AdaptMethod::kPlan)
    config.clusters = shipped_clusters();
  else
    config.options = pipeline::options::read_options(options_to_take(options));
  apply_settings(settings, config);
  return with_context(config.run.quiet, [&](const pipeline::record::RunContext& context) {
    return run_inputs(config.run, context, [&] { return pipeline::adapt(config, context); });
  });
}

void declare_adapt(CommandLine& line) {
  const auto a = std::make_shared<Arguments>();
  Command command =
      line.add("adapt", "Clean motions: keypoint fit, then a plan, or policies that are trained for each",
               "mimicx adapt clip.bvh            # clip.clean.bvh beside it, after seconds\n"
               "mimicx adapt DIR --out out/run   # every motion in a folder; a report, forces and scores");
  command.choice("--method", a->config.method,
                 {{"auto", pipeline::AdaptMethod::kAuto},
                  {"plan", pipeline::AdaptMethod::kPlan},
                  {"paper", pipeline::AdaptMethod::kPaper}},
                 "plan: optimal control alone, seconds per motion; paper: trained options chosen and "
                 "fine-tuned, minutes per motion; auto: the plan, and only where it fails the paper's "
                 "method, whose training then takes minutes; the better of the two is kept");
  add_run_arguments(command, a->config.run, a->more);
  add_training_arguments(command, a->config.training, "--budget-samples");
  add_fit_arguments(command, a->config.run);
  add_gains_argument(command, a->config.run);
  command.path("--options", a->options,
               "trained options: a file, a folder with options.npz, or taught: those in data/options/taught, "
               "which follow more real clips before any training; default: those in data/options");
  add_arrangement_arguments(command, a->config.arrangement);
  command.action([a] {
    take_shard(a->more.shard, a->config.run);
    return adapt_motions(a->config, a->options, a->more.settings);
  });
}

}  // namespace mimicx::tools
