#include "program/adapt_command.h"

#include <iostream>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "pipeline/cluster_map.h"
#include "shipped_options.h"
#include "simulation_commands.h"

namespace mimicx::tools {
namespace {

/// The methods by their names.
const std::vector<std::pair<std::string, program::AdaptMethod>>& methods() {
  static const std::vector<std::pair<std::string, program::AdaptMethod>> kMethods = {
      {"auto", program::AdaptMethod::kAuto},
      {"plan", program::AdaptMethod::kPlan},
      {"options", program::AdaptMethod::kOptions},
      {"printed", program::AdaptMethod::kPrinted}};
  return kMethods;
}

std::string name_of(program::AdaptMethod method) {
  for (const auto& [name, known] : methods())
    if (known == method) return name;
  throw std::logic_error("adapt: a method without a name");
}

struct AdaptArguments {
  program::AdaptConfig config = program::adapt_configuration();
  std::vector<std::string> options;
  RunArguments more;
};

/// @throws UsageError if none are given, and the program has none of this method
pipeline::options::OptionSets read_sets(const std::vector<std::string>& given, program::AdaptMethod method) {
  if (given.empty() && method == program::AdaptMethod::kPrinted)
    throw UsageError(
        "--method printed: the program has no such options; train them with `mimicx pretrain --method "
        "printed DIR --out OPTIONS` and name them with --options OPTIONS");
  std::vector<std::filesystem::path> places;
  for (const std::string& set : given) {
    if (set.empty()) throw UsageError("--options: expected a set of options, found the empty text");
    places.push_back(options_named(set));
  }
  if (given.empty()) places = shipped_sets();
  if (places.empty())
    throw UsageError(
        "found no trained options beside the program or in MIMICX_DATA: name trained options with --options; "
        "motions are planned without them by --method plan, without --policy");
  pipeline::options::OptionSets sets;
  for (const std::filesystem::path& place : places) {
    sets.push_back(pipeline::options::read_options(place));
    for (int s = 0; s + 1 < sets.count(); ++s)
      if (sets[s]->checksum == sets.back()->checksum)
        throw UsageError("--options: " + place.string() + " is given twice");
  }
  return sets;
}

/// @param options  those that the method does not use @param users  the methods that use them, in words
/// @throws UsageError if the line has one of them
void refuse_given(const Command& command, const std::vector<std::string>& options, const std::string& users,
                  program::AdaptMethod method) {
  for (const std::string& option : options)
    if (command.given(option))
      throw UsageError(option + ": expected --method " + users + ", found " + name_of(method));
}

/// @throws UsageError for what the method would ignore: a plan alone has no options, options have no gains
void refuse_unused(const Command& command, program::AdaptMethod method) {
  using program::AdaptMethod;
  if (method == AdaptMethod::kPlan)
    refuse_given(command,
                 {"--options", "--budget-samples", "--selector", "--switch-penalty", "--rescue-reward"},
                 "auto, options or printed", method);
  if (method == AdaptMethod::kOptions || method == AdaptMethod::kPrinted)
    refuse_given(command, {"--gains"}, "auto or plan", method);
}

}  // namespace

int adapt_motions(program::AdaptConfig config, const std::vector<std::string>& options,
                  const RunArguments& more) {
  using program::AdaptMethod;
  if (config.method == AdaptMethod::kAuto && options.empty() && !config.teaching.teach &&
      shipped_sets().empty()) {
    std::cerr
        << "no trained options are installed (MIMICX_DATA): motions are planned alone, as by --method plan\n";
    config.method = AdaptMethod::kPlan;
  }
  if (config.method == AdaptMethod::kPlan)
    config.run.map = pipeline::run_map(shipped_clusters());
  else
    config.options = read_sets(options, config.method);
  if (config.teaching.teach && config.method != AdaptMethod::kAuto)
    throw UsageError("--policy: expected --method auto, whose plan teaches it, found another one");
  apply_settings(more.settings, config);
  return with_context(config.run.quiet, [&](const record::RunContext& context) {
    return run_inputs(config.run, more.json, context, [&] { return program::adapt(config, context); });
  });
}

void declare_adapt(CommandLine& line) {
  const auto a = std::make_shared<AdaptArguments>();
  Command command =
      line.add("adapt", "Clean motions: keypoint fit, then a plan; trained policies if the plan fails",
               "mimicx adapt clip.bvh            # clip.clean.bvh beside it, after seconds\n"
               "mimicx adapt DIR --out out/run   # every motion in a folder; a report, forces and scores");
  command.choice_of<program::AdaptMethod>(
      "--method", a->config.method, methods(),
      [a](program::AdaptMethod method) {
        a->config.method = method;
        if (method == program::AdaptMethod::kPrinted) program::use_printed_method(a->config);
      },
      "plan: optimal control alone, seconds per motion; options: trained options chosen and fine-tuned, "
      "minutes per motion; auto: the plan, and only if it fails the options; the better result is kept; "
      "printed: options by the paper's method as printed, without our additions; it changes defaults as "
      "`mimicx config` lists them, and --options must name one set of `pretrain --method printed`",
      {{"paper", "options"}});
  command.flag("--policy", a->config.teaching.teach,
               "every successful plan also teaches a policy, which follows the motion unaided and withstands "
               "pushes: policies/NAME.npz; takes one to two times the motion's length");
  add_run_arguments(command, a->config.run, a->more);
  add_training_arguments(command, a->config.training, "--budget-samples");
  add_fit_arguments(command, a->config.run);
  add_unfitted_keypoints(command, a->config.run.correction.unfitted_keypoints);
  add_gains_argument(command, a->config.run);
  command.texts(
      "--options", a->options, "SET",
      "trained options to start from: a file, a folder with options.npz, or a set that comes with the "
      "program, trained or taught; repeatable: the first set that follows the whole motion is used, "
      "else the best; default: trained, then taught");
  add_arrangement_arguments(command, a->config.arrangement);
  command.action([a, command] {
    refuse_unused(command, a->config.method);
    take_shard(a->more.shard, a->config.run);
    return adapt_motions(a->config, a->options, a->more);
  });
}

}  // namespace mimicx::tools
