// `mimicx run`: pretrain on a folder, then adapt all of it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "arguments.h"
#include "commands.h"
#include "training.h"

namespace mimicx::tools {
namespace {

struct Arguments {
  std::filesystem::path in, out;
  pipeline::PretrainConfig pretrain = pipeline::pretrain_configuration("small");
  pipeline::AdaptConfig adapt = pipeline::adapt_configuration();
};

int run_all_stages(Arguments a) {
  a.pretrain.inputs = a.adapt.run.inputs = {a.in.string()};
  a.pretrain.out = a.out / "options";
  a.adapt.run.out = a.out / "clean";
  a.adapt.method = pipeline::AdaptMethod::kPaper;  // it is the options that are to be tried
  a.adapt.training.seed = a.pretrain.training.seed;
  a.adapt.run.threads = a.pretrain.threads;
  a.adapt.run.force = a.pretrain.force;
  a.adapt.run.read = a.pretrain.read;
  const int status = pretrain_options(a.pretrain, {});
  if (status == kInterrupted) return status;
  return std::max(status, adapt_motions(a.adapt, a.pretrain.out, {}));
}

}  // namespace

void declare_run(CLI::App& app, Action& action) {
  const auto a = std::make_shared<Arguments>();
  auto* command =
      app.add_subcommand("run", "All stages on a folder: pretrain options on it, then adapt all of it");
  command->add_option("DIR", a->in, "folder of motions")->required();
  command->add_option("--out", a->out, "where the folders of the two stages go: options/ and clean/")
      ->check(refuse_empty_path)
      ->required();
  command
      ->add_option("--pretrain-samples", a->pretrain.training.samples,
                   "training budget of all options together, in character steps")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_cluster_arguments(*command, a->pretrain.clusters);
  add_read_arguments(*command, a->pretrain.read);
  command
      ->add_option("--budget-samples", a->adapt.training.samples,
                   "fine-tuning budget per motion, in character steps")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_arrangement_arguments(*command, a->adapt.arrangement);
  add_seed(*command, a->pretrain.training.seed);
  add_force(*command, a->pretrain.force);
  add_threads(*command, a->pretrain.threads);
  command->callback([a, &action] { action = [a] { return run_all_stages(*a); }; });
}

}  // namespace mimicx::tools
