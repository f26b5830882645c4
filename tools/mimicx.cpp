/// `mimicx`: one binary, a subcommand per task. This file is the whole command line.

#include <CLI/CLI.hpp>
#include <exception>
#include <functional>
#include <iostream>
#include <map>

#include "commands.h"
#include "core/parallel.h"

namespace mimicx {
namespace {

/// What the command line holds; the members of the subcommand that was not called stay as they are.
struct Arguments {
  ImitateOptions imitate;
  SynthArguments synth;
  std::vector<std::string> settings;
  std::string truth, motions, json;
  std::string file, in, out;
  std::function<int()> run;
};

void declare_imitate(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("imitate", "Train a simulated character to follow each motion");
  a.imitate.threads = available_threads();
  command->add_option("FILE", a.imitate.inputs, "motions: AMASS-style .npz")->required();
  command->add_option("--out", a.imitate.out, "folder of the run; the same command continues what is there")
      ->required();
  command
      ->add_option("--samples", a.imitate.training.samples, "training budget per motion, in character steps")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--seed", a.imitate.training.seed, "root of every random number")
      ->capture_default_str();
  command->add_option("--threads", a.imitate.threads, "worker threads; no influence on the results")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      ->add_option("--limit-seconds", a.imitate.limit_seconds,
                   "safety stop per motion: ends its training early, makes the result depend on the machine, "
                   "and is recorded as such")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--set", a.settings,
                   "NAME=NUMBER: change a setting by the name it has in the manifest, for experiments; "
                   "repeatable")
      ->take_all();
  command->callback([&a] { a.run = [&a] { return run_imitate(a.imitate, a.settings); }; });
}

void declare_evaluate(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("evaluate", "Score motions against their truth, pairing files by name");
  command->add_option("--truth", a.truth, "folder of true motions")->required();
  command->add_option("--motions", a.motions, "folder of motions to score")->required();
  command->add_option("--json", a.json, "also write every value, its count and its definition here");
  command->callback([&a] { a.run = [&a] { return run_evaluate(a.truth, a.motions, a.json); }; });
}

void declare_file_commands(CLI::App& app, Arguments& a) {
  auto* info = app.add_subcommand("info", "What a motion file holds and what preparation does to it");
  info->add_option("FILE", a.file, "motion: AMASS-style .npz")->required();
  info->callback([&a] { a.run = [&a] { return run_info(a.file); }; });

  auto* convert = app.add_subcommand("convert", "Write a motion in this program's own layout");
  convert->add_option("IN", a.in, "motion: AMASS-style .npz")->required();
  convert->add_option("OUT", a.out, "where to write it: .npz")->required();
  convert->callback([&a] { a.run = [&a] { return run_convert(a.in, a.out); }; });
}

void declare_synth(CLI::App& app, Arguments& a) {
  auto* command =
      app.add_subcommand("synth", "Write synthetic motions: truth/ and noisy/, a file per motion");
  SynthSetOptions& set = a.synth.set;
  auto* out = command->add_option("--out", a.synth.out, "folder to write to");
  command->add_option("--clips", set.clips, "number of motions, the kinds in turn; default: one of each kind")
      ->check(CLI::PositiveNumber);
  command->add_option("--kinds", set.kinds, "kinds to make, separated by commas; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember(synthetic_kinds()));
  command->add_option("--noise", set.noise, "what estimates it for noisy/: gvhmr, vibe, or none (exact)")
      ->check(CLI::IsMember({"gvhmr", "vibe", "none"}))
      ->capture_default_str();
  command->add_option("--camera", set.camera, "how well its camera is known: calibrated, perturbed or wild")
      ->check(CLI::IsMember({"calibrated", "perturbed", "wild"}))
      ->capture_default_str();
  static const std::map<std::string, KeypointSet> kSets = {{"joints22", KeypointSet::kJoints22},
                                                           {"coco17", KeypointSet::kCoco17}};
  command->add_option("--keypoints", set.keypoints, "which points are detected: joints22 (default) or coco17")
      ->transform(CLI::CheckedTransformer(kSets));
  command
      ->add_option("--seed", set.seed, "seed of the first motion of every kind; 101 and up: training split")
      ->capture_default_str();
  command
      ->add_option("--data-set", a.synth.data_set,
                   "write the project's own small set, test/ and train/, to this folder instead")
      ->excludes(out);
  command->callback([&a] { a.run = [&a] { return run_synth(a.synth); }; });
}

int run(int argc, char** argv) {
  CLI::App app("Physically plausible human motion from noisy motion.");
  app.name("mimicx");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("mimicx ") + MIMICX_VERSION + ", built for " + MIMICX_TARGET);
  app.footer(
      "Exit status: 0 all good, 1 some inputs failed (the rest is done), 2 wrong usage, 130 interrupted.");
  Arguments arguments;
  declare_imitate(app, arguments);
  declare_evaluate(app, arguments);
  declare_file_commands(app, arguments);
  declare_synth(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kAllGood : kWrongUsage;  // --help and --version end here as well
  }
  return arguments.run();
}

}  // namespace
}  // namespace mimicx

int main(int argc, char** argv) {
  try {
    return mimicx::run(argc, argv);
  } catch (const mimicx::UsageError& error) {
    std::cerr << "mimicx: " << error.what() << '\n';
    return mimicx::kWrongUsage;
  } catch (const std::exception& error) {
    std::cerr << "mimicx: " << error.what() << '\n';
    return mimicx::kSomeFailed;
  }
}
