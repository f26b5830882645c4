#include "pipeline/corrupt.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "pipeline/preparation.h"
#include "pipeline/record/outputs.h"
#include "pipeline/record/run_folder.h"

namespace mimicx::tools {
namespace {

constexpr const char* kPurpose = "Make a benchmark of clean motions: truth/ and noisy/, a file per motion";
constexpr const char* kHelp =
    "Make a benchmark of clean motions: truth/ and noisy/, a file per motion\n\n"
    "  mimicx corrupt mocap/ --out bench\n"
    "  mimicx evaluate --truth bench/truth --motions bench/noisy\n\n"
    "  mimicx corrupt walk.bvh --noise gvhmr,drift=0 --camera moving --keypoints coco17 --seed 3 --out "
    "bench\n\n"
    "A motion's errors follow from the seed and its name alone, never from the other files.";

struct Arguments {
  std::vector<std::string> inputs, noise;
  std::filesystem::path out;
  std::string camera = "perturbed", keypoints = "22";
  pipeline::CorruptConfig config;
  bool force = false;
};

/// @throws UsageError for a noise that cannot be
pipeline::CorruptConfig checked_config(const Arguments& a) {
  static const std::map<std::string, std::optional<motion::KeypointSet>> kSets = {
      {"22", motion::KeypointSet::kJoints22},
      {"coco17", motion::KeypointSet::kCoco17},
      {"coco133", motion::KeypointSet::kCoco133},
      {"none", {}}};
  pipeline::CorruptConfig config = a.config;
  config.estimate.camera = motion::synth::camera_error(a.camera);
  config.estimate.keypoints = kSets.at(a.keypoints);
  try {
    config.estimate.noise = motion::synth::noise_model(a.noise);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("corrupt: ") + error.what());
  }
  return config;
}

int corrupt(const Arguments& a) {
  const pipeline::CorruptConfig config = checked_config(a);
  const std::vector<std::string> files = pipeline::expand_inputs(a.inputs, &std::cerr);
  const std::vector<std::string> names = pipeline::record::unique_names(files);
  pipeline::record::Outputs outputs(files, a.force);
  for (const std::string& name : names)
    for (const char* part : {"truth", "noisy"}) outputs.claim(a.out / part / (name + ".npz"));
  std::size_t written = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string& file = files[i];
    try {
      pipeline::tell_decisions(file, pipeline::corrupt_file(file, names[i], a.out, config), std::cerr);
      ++written;
    } catch (const std::exception& error) {
      std::cerr << file << ": left out: " << error.what() << '\n';
    }
  }
  std::cout << a.out.string() << ": " << written << " motions, each as truth and as a noisy estimate\n";
  return written == names.size() ? kAllGood : kSomeFailed;
}

}  // namespace

void declare_corrupt(CLI::App& app, Action& action) {
  const auto a = std::make_shared<Arguments>();
  auto* command = app.add_subcommand("corrupt", kPurpose);
  set_own_help(*command, kHelp);
  command->add_option("FILE", a->inputs, "clean motions and folders of them")->required();
  command->add_option("--out", a->out, "folder to write to")->check(refuse_empty_path)->required();
  command
      ->add_option(
          "--noise", a->noise,
          "what estimates them: independent (default; shares nothing with the keypoint fit), gvhmr or "
          "vibe; single amplitudes behind commas: independent,stature=0,swap_rate=0 "
          "(docs/method.md, \"Noise model\")")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("MODEL,NAME=VALUE...");
  command
      ->add_option("--camera", a->camera,
                   "how well the camera is known; moving: carried, and told with drift")
      ->check(CLI::IsMember({"calibrated", "perturbed", "wild", "moving"}))
      ->capture_default_str();
  command->add_option("--keypoints", a->keypoints, "which points are detected; none: nor is a camera told")
      ->check(CLI::IsMember({"22", "coco17", "coco133", "none"}))
      ->capture_default_str();
  add_seed(*command, a->config.seed);
  add_read_arguments(*command, a->config.read);
  add_force(*command, a->force);
  command->callback([a, &action] { action = [a] { return corrupt(*a); }; });
}

}  // namespace mimicx::tools
