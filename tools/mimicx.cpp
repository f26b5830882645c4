/// `mimicx`: one binary, a subcommand per task. This file is the whole command line.

#include <CLI/CLI.hpp>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <optional>

#include "commands.h"
#include "core/parallel.h"
#include "motion/import/motion_file.h"

namespace mimicx {
namespace {

/// What the command line holds; the members of the subcommand that was not called stay as they are.
struct Arguments {
  ImitateConfig imitate;
  AdaptConfig adapt;
  PlanMotionsConfig plan;
  PretrainConfig pretrain;
  std::string preset = "small";
  std::optional<std::int64_t> pretrain_samples;
  std::string options;
  SynthArguments synth;
  std::vector<std::string> settings;
  std::string truth, json;
  std::vector<std::string> motions;
  std::string file, in, out;
  std::vector<std::string> inputs;
  std::vector<double> betas;
  bool poses_alone = false;
  ClusterSettings cluster;
  FitConfig fit;
  ReadConfig read;
  std::string rate = "input";
  std::function<int()> run;
};

void add_settings(CLI::App& command, Arguments& a) {
  command
      .add_option("--set", a.settings,
                  "NAME=NUMBER: change a setting by the name it has in the manifest, for experiments; "
                  "repeatable")
      ->take_all();
}

void add_threads(CLI::App& command, int& threads) {
  threads = available_threads();
  command.add_option("--threads", threads, "worker threads; no influence on the results")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

/// What the user knows better than the files.
void add_read_options(CLI::App& command, ReadConfig& read) {
  static const std::map<std::string, char> kAxes = {{"x", 'x'},  {"y", 'y'},  {"z", 'z'},
                                                    {"-x", 'X'}, {"-y", 'Y'}, {"-z", 'Z'}};
  command
      .add_option_function<std::string>(
          "--up", [&read](const std::string& axis) { read.up = kAxes.at(axis); },
          "the axis that points up in the files; default: looked for")
      ->check(CLI::IsMember(kAxes));
  command.add_option("--scale", read.scale, "metres per unit of length in the files; default: looked for")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--fps", read.fps, "frame rate the motions were recorded at; default: what the files say")
      ->check(CLI::Range(0.1, 2000.0));
  command.add_option("--floor", read.floor,
                     "height of the floor in the files, m, z up; default: where the motion stands");
  command
      .add_option_function<std::string>(
          "--body", [&read](const std::string& body) { read.standard_body = body == "standard"; },
          "file (default): the body shape of the file, where it is known; standard: the standard body")
      ->check(CLI::IsMember({"file", "standard"}));
  command.add_option("--smplx", read.smplx, "your SMPLX_NEUTRAL.npz: gives SMPL-X betas their joints")
      ->check(CLI::ExistingFile);
  command
      .add_option("--joint-map", read.joint_map,
                  "more joint names for BVH skeletons: a text file, docs/formats.md")
      ->check(CLI::ExistingFile);
}

/// What plan, imitate and adapt have in common.
void add_run_options(CLI::App& command, Arguments& a, RunConfig& run) {
  command.add_option("FILE", run.inputs, "motions and folders of them")->required();
  command.add_option(
      "--out", run.out,
      "folder of the run; the same command continues what is there; default: NAME.mimicx beside "
      "every input, and its clean motion beside it as NAME.clean.EXT");
  add_read_options(command, run.read);
  command
      .add_option_function<std::string>(
          "--rate", [&run](const std::string& rate) { run.input_rate = rate == "input"; },
          "frame rate of the clean copies in the inputs' own formats: 30 (default) or input")
      ->check(CLI::IsMember({"30", "input"}));
  command.add_flag("--substeps", run.substeps,
                   "also write substeps/NAME.npz: every physics step of the result, for an exact audit");
  add_threads(command, run.threads);
  command
      .add_option(
          "--limit-seconds", run.limit_seconds,
          "safety stop per motion: ends its plan or training early, makes the result depend on the machine, "
          "and is recorded as such")
      ->check(CLI::PositiveNumber);
  add_settings(command, a);
}

/// What imitate and adapt have in common. @param samples  name of the option for the budget
void add_training_options(CLI::App& command, TrainingConfig& training, const std::string& samples) {
  command.add_option(samples, training.samples, "training budget per motion, in character steps")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--seed", training.seed, "root of every random number")->capture_default_str();
}

void add_fit_flag(CLI::App& command, RunConfig& run) {
  command.add_flag("--fit,!--no-fit", run.fit,
                   "move motions onto their keypoints first, where they have any (default); --no-fit: do not "
                   "look at keypoints at all");
}

void declare_plan(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand(
      "plan", "Clean motions by optimal control: keypoint fit, then a plan that the simulator carries out");
  add_run_options(*command, a, a.plan.run);
  add_fit_flag(*command, a.plan.run);
  command->callback([&a] { a.run = [&a] { return run_plan(a.plan, a.settings); }; });
}

void declare_imitate(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("imitate", "Train a simulated character to follow each motion");
  add_run_options(*command, a, a.imitate.run);
  add_training_options(*command, a.imitate.training, "--samples");
  command->add_flag("--fit", a.imitate.run.fit,
                    "move motions onto their keypoints first, where they have any");
  command->callback([&a] { a.run = [&a] { return run_imitate(a.imitate, a.settings); }; });
}

void declare_adapt(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand(
      "adapt", "Clean motions: keypoint fit, then a plan, or policies that are trained for each");
  static const std::map<std::string, AdaptMethod> kMethods = {
      {"auto", AdaptMethod::kAuto}, {"plan", AdaptMethod::kPlan}, {"paper", AdaptMethod::kPaper}};
  command
      ->add_option(
          "--method", a.adapt.method,
          "plan: optimal control alone, seconds per motion; paper: trained options chosen and "
          "fine-tuned, minutes per motion; auto (default): the plan, and only where it fails the paper's "
          "method, whose training then takes minutes; the better of the two is kept")
      ->transform(CLI::Transformer(kMethods))
      ->option_text("TEXT:{auto,plan,paper}");
  add_run_options(*command, a, a.adapt.run);
  add_training_options(*command, a.adapt.training, "--budget-samples");
  add_fit_flag(*command, a.adapt.run);
  command->add_option(
      "--options", a.options,
      "trained options: a file, or a folder with options.npz; default: those in data/options");
  command
      ->add_option("--switch-penalty", a.adapt.arrangement.switch_penalty,
                   "w_p of Eq. 4, in rewards; not positive")
      ->check(CLI::Range(-1e9, 0.0))
      ->capture_default_str();
  command->callback([&a] { a.run = [&a] { return run_adapt(a.adapt, a.options, a.settings); }; });
}

void add_pretrain_options(CLI::App& command, Arguments& a, const std::string& samples) {
  command
      .add_option(samples, a.pretrain_samples, "training budget of all options together, in character steps")
      ->check(CLI::NonNegativeNumber);
  auto* radius = command
                     .add_option("--radius", a.pretrain.clusters.radius,
                                 "no two motions of a cluster are farther apart than this")
                     ->check(CLI::NonNegativeNumber)
                     ->capture_default_str();
  command.add_option("--clusters", a.pretrain.clusters.clusters, "how many clusters, and options, instead")
      ->check(CLI::PositiveNumber)
      ->excludes(radius);
}

void declare_pretrain(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("pretrain", "Train an option policy for every cluster of motions");
  command->add_option("DIR", a.pretrain.inputs, "motions and folders of them")->required();
  command
      ->add_option("--out", a.pretrain.out, "folder of the options; the same command continues what is there")
      ->required();
  add_pretrain_options(*command, a, "--samples");
  add_read_options(*command, a.pretrain.read);
  command->add_option("--preset", a.preset, "sizes of the networks: small (128-128) or paper (1024-1024-512)")
      ->check(CLI::IsMember({"small", "paper"}))
      ->capture_default_str();
  command->add_option("--seed", a.pretrain.training.seed, "root of every random number")
      ->capture_default_str();
  add_threads(*command, a.pretrain.threads);
  command->add_flag("--encoder,!--no-encoder", a.pretrain.use_encoder,
                    "policies see their reference through a denoising encoder (default)");
  command->add_flag("--fit,!--no-fit", a.pretrain.fit,
                    "move motions onto their keypoints first, where they have any (default)");
  add_settings(*command, a);
  command->callback(
      [&a] { a.run = [&a] { return run_pretrain(a.pretrain, a.preset, a.pretrain_samples, a.settings); }; });
}

void declare_run(CLI::App& app, Arguments& a) {
  auto* command =
      app.add_subcommand("run", "All stages on a folder: pretrain options on it, then adapt all of it");
  command->add_option("DIR", a.in, "folder of motions")->required();
  command->add_option("--out", a.out, "folder of the run: options/ and clean/")->required();
  add_pretrain_options(*command, a, "--pretrain-samples");
  add_read_options(*command, a.pretrain.read);
  command
      ->add_option("--budget-samples", a.adapt.training.samples,
                   "fine-tuning budget per motion, in character steps")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--seed", a.pretrain.training.seed, "root of every random number")
      ->capture_default_str();
  add_threads(*command, a.pretrain.threads);
  command->callback([&a] {
    a.run = [&a] {
      a.adapt.training.seed = a.pretrain.training.seed;
      a.adapt.run.threads = a.pretrain.threads;
      a.adapt.run.read = a.pretrain.read;
      return run_all(a.in, a.out, a.pretrain, a.adapt, a.pretrain_samples);
    };
  });
}

void declare_evaluate(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("evaluate", "Score motions against their truth, pairing files by name");
  command->add_option("--truth", a.truth, "folder of true motions")->required();
  command
      ->add_option(
          "--motions", a.motions,
          "folder of motions to score; several folders are compared by their means over the motions that all "
          "of them hold")
      ->required();
  command->add_option("--json", a.json, "also write every value, its count and its definition here");
  command->callback([&a] { a.run = [&a] { return run_evaluate(a.truth, a.motions, a.json); }; });
}

void declare_cluster(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("cluster", "Sort motions into clusters of similar ones");
  command->add_option("FILE", a.inputs, "motions and folders of them")->required();
  command->add_option("--out", a.out, "where to write the clusters: .json")->required();
  add_read_options(*command, a.read);
  auto* radius = command
                     ->add_option("--radius", a.cluster.radius,
                                  "no two motions of a cluster are farther apart than this")
                     ->check(CLI::NonNegativeNumber)
                     ->capture_default_str();
  command->add_option("--clusters", a.cluster.clusters, "how many clusters to make instead")
      ->check(CLI::PositiveNumber)
      ->excludes(radius);
  command->add_option("--seed", a.cluster.seed, "root of every random number")->capture_default_str();
  command->callback([&a] { a.run = [&a] { return run_cluster(a.inputs, a.out, a.cluster, a.read); }; });
}

void declare_fit(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("fit", "Move motions onto their 2D keypoints, where they have any");
  command->add_option("FILE", a.inputs, "motions and folders of them")->required();
  command->add_option("--out", a.out, "folder for the fitted motions")->required();
  add_read_options(*command, a.read);
  const auto add_sigma = [&](const std::string& name, double& sigma, const std::string& what) {
    command->add_option(name, sigma, "standard error of " + what + "; 0: it is exact")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
  };
  add_sigma("--focal-sigma", a.fit.focal_sigma, "the focal length in the file, relative");
  add_sigma("--tilt-sigma", a.fit.tilt_sigma, "the camera's tilt in the file, degrees");
  add_sigma("--beta-sigma", a.fit.beta_sigma, "each entry of the shape in the file");
  command->callback([&a] { a.run = [&a] { return run_fit(a.inputs, a.out, a.fit, a.read); }; });
}

void declare_file_commands(CLI::App& app, Arguments& a) {
  auto* info =
      app.add_subcommand("info", "What a motion file holds, what reading decides, what preparation does");
  info->add_option("FILE", a.file, "motion")->required();
  add_read_options(*info, a.read);
  info->callback([&a] { a.run = [&a] { return run_info(a.file, a.read); }; });

  auto* convert = app.add_subcommand("convert", "Write a motion in another format, chosen by the suffix");
  convert->add_option("IN", a.in, "motion")->required();
  convert->add_option("OUT", a.out, "where to write it: " + written_suffixes() + "; .qpos.npz: for MuJoCo")
      ->required();
  add_read_options(*convert, a.read);
  convert->add_option("--rate", a.rate, "frame rate of OUT: input or 30")
      ->check(CLI::IsMember({"input", "30"}))
      ->capture_default_str();
  convert->callback(
      [&a] { a.run = [&a] { return run_convert(a.in, a.out, a.read, a.rate == "30" ? 30.0 : 0.0); }; });
}

void declare_audit(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("audit", "Do the forces in a file explain the motion in it?");
  command->add_option("FILE", a.inputs, "motions and physics steps (.npz), and folders of them")->required();
  command->add_flag("--poses", a.poses_alone,
                    "look at the poses alone, under the best ground reaction that is physically possible");
  command->add_option("--json", a.json, "also write every row and every value here");
  command->callback([&a] { a.run = [&a] { return run_audit(a.inputs, a.poses_alone, a.json); }; });
}

void declare_export_mjcf(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("export-mjcf", "Write the character of a shape as a MuJoCo model");
  command->add_option("OUT", a.out, "where to write it: .xml")->required();
  auto* betas = command
                    ->add_option("--betas", a.betas,
                                 "shape: up to 10 numbers of -5 to 5, separated by commas; default: all 0")
                    ->delimiter(',')
                    ->check(CLI::Range(-5.0, 5.0));
  command->add_option("--motion", a.file, "take the body of this motion: that of its qpos by `convert`")
      ->excludes(betas);
  add_read_options(*command, a.read);
  command->callback([&a] { a.run = [&a] { return run_export_mjcf(a.betas, a.file, a.read, a.out); }; });
}

void declare_synth(CLI::App& app, Arguments& a) {
  auto* command =
      app.add_subcommand("synth", "Write synthetic motions: truth/ and noisy/, a file per motion");
  SynthSetConfig& set = a.synth.set;
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
  command->add_flag(
      "--report", a.synth.report,
      "print the forces and torques that each motion of the set demands; --out may be left out");
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
  arguments.adapt.training = fine_tuning_defaults();
  arguments.adapt.run.fit = arguments.plan.run.fit = true;
  declare_run(app, arguments);
  declare_plan(app, arguments);
  declare_pretrain(app, arguments);
  declare_adapt(app, arguments);
  declare_imitate(app, arguments);
  declare_evaluate(app, arguments);
  declare_cluster(app, arguments);
  declare_fit(app, arguments);
  declare_file_commands(app, arguments);
  declare_audit(app, arguments);
  declare_export_mjcf(app, arguments);
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
