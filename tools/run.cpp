// `mimicx run`: pretrain on a folder, then adapt all of it.
#include <algorithm>
#include <memory>

#include "commands.h"
#include "core/file.h"
#include "record/outputs.h"
#include "shared_arguments.h"
#include "simulation_commands.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct RunFileArguments {
  std::filesystem::path in, out, json;
  pipeline::PretrainConfig pretrain = program::pretrain_configuration("small");
  program::AdaptConfig adapt = program::adapt_configuration();
};

/// @throws UsageError if --json names a file of one of the stages
void require_json_apart_from_stages(const RunFileArguments& a) {
  if (a.json.empty() || is_standard_output(a.json)) return;
  require_json_apart(a.json, a.out / "clean");
  if (is_within(a.json, a.out / "options"))
    throw UsageError("--json: expected a file outside the folder of the options, found " + a.json.string());
}

int run_all_stages(RunFileArguments a) {
  require_json_apart_from_stages(a);
  require_inputs_apart({a.in.string()}, a.out / "clean");
  if (!is_standard_output(a.json))  // not after hours
    record::Outputs({a.in.string()}, a.pretrain.force).claim(a.json, record::kJsonOpening);
  a.pretrain.inputs = a.adapt.run.inputs = {a.in.string()};
  a.pretrain.out = a.out / "options";
  a.adapt.run.out = a.out / "clean";
  a.adapt.method = program::AdaptMethod::kOptions;  // uses the trained options
  a.adapt.training.seed = a.pretrain.training.seed;
  a.adapt.run.threads = a.pretrain.threads;
  a.adapt.run.force = a.pretrain.force;
  a.adapt.run.read = a.pretrain.read;
  const int status = pretrain_options(a.pretrain, {});
  if (status == kInterrupted) return status;
  RunArguments more;
  more.json = a.json;
  return std::max(status, adapt_motions(a.adapt, {a.pretrain.out.string()}, more));
}

}  // namespace

void declare_run(CommandLine& line) {
  const auto a = std::make_shared<RunFileArguments>();
  Command command =
      line.add("run", "All stages on a folder: pretrain options on it, then adapt all of it",
               "mimicx run DIR --out out/all                                               # hours\n"
               "mimicx run DIR --out out/try --pretrain-samples 1M --budget-samples 200k   # a quick test");
  command.file("DIR", a->in, "folder of motions");
  command.folder("--out", a->out, "folder of the two stages: options/ and clean/").required();
  command.number("--pretrain-samples", a->pretrain.training.samples, kFromZero,
                 "training budget of all options together, in character steps");
  add_cluster_arguments(command, a->pretrain.clusters);
  add_read_arguments(command, a->pretrain.read, true);
  command.number("--budget-samples", a->adapt.training.samples, kFromZero,
                 "fine-tuning budget per motion, in character steps");
  add_arrangement_arguments(command, a->adapt.arrangement);
  add_json(command, a->json);
  add_seed(command, a->pretrain.training.seed);
  add_force(command, a->pretrain.force);
  add_threads(command, a->pretrain.threads);
  command.action([a] { return run_all_stages(*a); });
}

}  // namespace mimicx::tools
