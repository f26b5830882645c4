#include "pipeline/adapt.h"

#include <memory>
#include <utility>

#include "commands.h"
#include "shipped_options.h"
#include "training.h"

namespace mimicx::tools {
namespace {

struct Arguments {
  pipeline::AdaptConfig config = pipeline::adapt_configuration();
  std::vector<std::string> options;
  RunArguments more;
};

/// @throws UsageError where none are given, and none have come with the program
pipeline::options::OptionSets read_sets(std::vector<std::string> names) {
  if (names.empty()) names = shipped_sets();
  if (names.empty())
    throw UsageError(
        "found no data/options beside the program: name trained options with --options, or take --method "
        "plan");
  pipeline::options::OptionSets sets;
  for (const std::string& name : names) sets.push_back(pipeline::options::read_options(options_named(name)));
  return sets;
}

}  // namespace

int adapt_motions(pipeline::AdaptConfig config, std::vector<std::string> options,
                  const std::vector<std::string>& settings) {
  if (config.method == pipeline::AdaptMethod::kPlan)
    config.clusters = shipped_clusters();
  else
    config.options = read_sets(std::move(options));
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
  command.texts(
      "--options", a->options, "SET",
      "trained options to start from: a file, a folder with options.npz, or a set that comes with the "
      "program: trained or taught; repeatable: the first set that follows the whole motion is taken, "
      "else the best; default: trained, then taught");
  add_arrangement_arguments(command, a->config.arrangement);
  command.action([a] {
    take_shard(a->more.shard, a->config.run);
    return adapt_motions(a->config, a->options, a->more.settings);
  });
}

}  // namespace mimicx::tools
