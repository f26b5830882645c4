#include "synth/corrupt.h"

#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "commands.h"
#include "core/error.h"
#include "files/inputs.h"
#include "record/folder_lock.h"
#include "record/json.h"
#include "record/outputs.h"
#include "record/utf8_names.h"
#include "run/preparation.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct CorruptArguments {
  std::vector<std::string> inputs, noise;
  std::filesystem::path out, json;
  std::string camera = "perturbed", keypoints = "22";
  synth::CorruptConfig config;
  bool force = false;
};

/// @throws UsageError for an impossible noise
synth::CorruptConfig checked_config(const CorruptArguments& a) {
  static const std::map<std::string, std::optional<motion::KeypointSet>> kSets = {
      {"22", motion::KeypointSet::kJoints22},
      {"coco17", motion::KeypointSet::kCoco17},
      {"coco133", motion::KeypointSet::kCoco133},
      {"none", {}}};
  synth::CorruptConfig config = a.config;
  config.estimate.camera = synth::camera_error(a.camera);
  config.estimate.keypoints = kSets.at(a.keypoints);
  try {
    config.estimate.noise = synth::noise_model(a.noise);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("corrupt: ") + error.what());
  }
  return config;
}

int corrupt(const CorruptArguments& a) {
  const synth::CorruptConfig config = checked_config(a);
  const std::vector<files::MotionInput> inputs = files::find_motions(a.inputs, a.out, &std::cerr);
  const std::vector<std::string> names = files::unique_names(inputs);
  record::Outputs outputs(files::paths_of(inputs), a.force);
  std::vector<std::filesystem::path> results;
  for (const std::string& name : names)
    for (const char* part : {"truth", "noisy"}) {
      results.push_back(a.out / part / (name + ".npz"));
      outputs.claim(results.back());
    }
  if (!is_standard_output(a.json)) outputs.claim(a.json, record::kJsonOpening);
  files::require_results_apart(a.inputs, a.out, results);
  const record::FolderLock lock(a.out);
  std::size_t written = 0;
  record::Json motions = record::Json::array();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::string& file = inputs[i].path;
    try {
      run::tell_decisions(file, synth::corrupt_file(file, names[i], a.out, config), std::cerr);
      ++written;
      motions.push_back(record::to_utf8(names[i]));
    } catch (const std::exception& error) {
      std::cerr << file << ": left out: " << reason_of(error) << '\n';
    }
  }
  table_stream(a.json) << a.out.string() << ": " << written
                       << " motions, each as truth and as a noisy estimate\n";
  if (!a.json.empty())
    write_json(a.json, record::document({{"folder", record::to_utf8(a.out.string())}, {"motions", motions}}));
  return written == names.size() ? kAllGood : kSomeFailed;
}

}  // namespace

void declare_corrupt(CommandLine& line) {
  const auto a = std::make_shared<CorruptArguments>();
  Command command = line.add(
      "corrupt", "Make a benchmark of clean motions: truth/ and noisy/, a file per motion",
      "mimicx corrupt mocap/ --out bench   # then: mimicx adapt bench/noisy --out out/bench\n"
      "mimicx corrupt walk.bvh --out bench --noise gvhmr,drift=0 --camera moving --seed 3",
      "A motion's errors depend on the seed and its name alone, not on the other files: give a training "
      "set and a test set with the same names different seeds.");
  command.files("FILE", a->inputs, "clean motions and folders of them");
  command.folder("--out", a->out, "folder to write to").required();
  command.list("--noise", a->noise, "PRESET,NAME=VALUE...",
               "preset of the noise model: independent (default), gvhmr, vibe, or none for exact motion; "
               "then single amplitudes after commas: independent,stature=0,swap_rate=0 "
               "(docs/method.md, \"Noise model\")");
  command.one_of("--camera", a->camera, {"calibrated", "perturbed", "wild", "moving"},
                 "how well the camera is known; moving: hand-held, its track has drift");
  command.one_of("--keypoints", a->keypoints, {"22", "coco17", "coco133", "none"},
                 "which points are detected; none: no camera either");
  add_json(command, a->json);
  add_seed(command, a->config.seed);
  add_read_arguments(command, a->config.read);
  add_force(command, a->force);
  command.action([a] { return corrupt(*a); });
}

}  // namespace mimicx::tools
