#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "audit/feasibility.h"
#include "character/body_words.h"
#include "commands.h"
#include "core/file.h"
#include "files/scene_file.h"
#include "record/folder_lock.h"
#include "record/json.h"
#include "record/outputs.h"
#include "record/progress.h"
#include "shared_arguments.h"
#include "standard_streams.h"
#include "synth/data_set.h"

namespace mimicx::tools {
namespace {

struct SynthArguments {
  std::filesystem::path out;  ///< folder of a set; empty: no set is written
  std::filesystem::path
      data_set;  ///< folder for the project's own test and training split; empty: not written
  std::filesystem::path json;
  synth::SynthSetConfig set;
  bool force = false;
  bool report = false;  ///< print the forces and torques that each motion demands
};

/// @throws UsageError for an impossible set
std::vector<synth::SynthConfig> checked_clips(const synth::SynthSetConfig& set) {
  try {
    return synth::clips_of_set(set);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("synth: ") + error.what());
  }
}

/// Where the scene of a motion is written.
std::filesystem::path scene_path(const std::filesystem::path& folder, const std::string& name) {
  return folder / "scenes" / (name + ".json");
}

void write_set(const SynthArguments& a, std::size_t total) {
  double next = record::steady_seconds() + record::kProgressSeconds;
  synth::write_synth_set(a.out, a.set, [&](std::size_t index, const motion::Clip& truth) {
    if (!truth.scene.flat()) {
      make_folder(a.out / "scenes");
      files::write_scene(scene_path(a.out, truth.name), truth.scene);
    }
    if (record::steady_seconds() < next) return;
    std::cerr << index + 1 << " of " << total << " motions\n";
    next += record::kProgressSeconds;
  });
  table_stream(a.json) << a.out.string() << ": " << total
                       << " motions, each as truth and as a noisy estimate\n";
}

/// Residuals in parts of the weight W, torques in parts of their limits.
record::Json print_report(std::FILE* out, const std::vector<synth::SynthConfig>& clips) {
  record::Json rows = record::Json::array();
  std::fprintf(out, "%-20s %7s %18s %20s %26s %12s\n", "motion", "seconds", "root force, % W",
               "root moment, mm W", "worst torque, % of limit", "frames over");
  std::fprintf(out, "%-20s %7s %9s %8s %11s %8s\n", "", "", "mean", "max", "mean", "max");
  for (const synth::SynthConfig& options : clips) {
    const motion::Clip clip = synth::synthesize(options);
    const audit::Feasibility f = audit::feasibility(clip);
    const std::string worst = body_in_words(f.worst_joint);
    std::fprintf(out, "%-20s %7.1f %9.2f %8.2f %11.2f %8.1f %19.0f %-14s %4d\n", clip.name.c_str(),
                 (clip.frames() - 1) / clip.fps, 100.0 * f.mean_force, 100.0 * f.max_force,
                 1e3 * f.mean_moment, 1e3 * f.max_moment, 100.0 * f.worst_torque, worst.c_str(),
                 f.frames_over_limit);
    rows.push_back({{"motion", clip.name},
                    {"seconds", record::number((clip.frames() - 1) / clip.fps)},
                    {"mean_root_force", record::number(f.mean_force)},
                    {"max_root_force", record::number(f.max_force)},
                    {"mean_root_moment_m", record::number(f.mean_moment)},
                    {"max_root_moment_m", record::number(f.max_moment)},
                    {"worst_torque", record::number(f.worst_torque)},
                    {"worst_joint", worst},
                    {"frames_over_limit", f.frames_over_limit}});
  }
  return rows;
}

void claim_set(const SynthArguments& a) {
  record::Outputs outputs({}, a.force);
  if (!is_standard_output(a.json)) outputs.claim(a.json, record::kJsonOpening);
  const auto claim = [&](const std::filesystem::path& directory, const synth::SynthSetConfig& set) {
    const std::vector<std::string> ground = synth::ground_kinds();
    for (const synth::SynthConfig& clip : synth::clips_of_set(set)) {
      for (const char* part : {"truth", "noisy"})
        outputs.claim(directory / part / (synth::name_of(clip) + ".npz"));
      if (std::find(ground.begin(), ground.end(), clip.kind) != ground.end())
        outputs.claim(scene_path(directory, synth::name_of(clip)), record::kJsonOpening);
    }
  };
  if (!a.out.empty()) claim(a.out, a.set);
  if (a.data_set.empty()) return;
  for (const auto& [split, set] : synth::synthetic_splits()) claim(a.data_set / split, set);
}

/// The valid names of kinds.
std::vector<std::string> selections() {
  std::vector<std::string> names = synth::synthetic_kinds();
  for (const std::string& name : synth::floor_kinds()) names.push_back(name);
  for (const std::string& name : synth::ground_kinds()) names.push_back(name);
  names.insert(names.end(), {"all", "floor", "scenes"});
  return names;
}

int synth(SynthArguments a) {
  if (a.set.kinds == std::vector<std::string>{"all"}) a.set.kinds = synth::synthetic_kinds();
  if (a.set.kinds == std::vector<std::string>{"floor"}) a.set.kinds = synth::floor_kinds();
  if (a.set.kinds == std::vector<std::string>{"scenes"}) a.set.kinds = synth::ground_kinds();
  if (a.out.empty() && a.data_set.empty() && !a.report)
    throw UsageError("synth: expected --out DIR or --data-set DIR");
  const std::vector<synth::SynthConfig> clips = checked_clips(a.set);
  claim_set(a);
  std::optional<record::FolderLock> lock;
  if (const auto& folder = a.out.empty() ? a.data_set : a.out; !folder.empty()) lock.emplace(folder);
  if (!a.out.empty()) write_set(a, clips.size());
  if (!a.data_set.empty()) {
    synth::write_synthetic_data(a.data_set);
    table_stream(a.json) << a.data_set.string() << ": test and train, " << synth::basic_kinds().size()
                         << " motions each, as truth and as a noisy estimate\n";
  }
  if (!a.report && a.json.empty()) return kAllGood;
  record::Json names = record::Json::array();
  for (const synth::SynthConfig& clip : clips) names.push_back(synth::name_of(clip));
  record::Json result = {{"motions", a.data_set.empty() ? names : record::Json::array()}};
  if (a.report) result["demands"] = print_report(table_file(a.json), clips);
  if (!a.json.empty()) write_json(a.json, record::document(result));
  return kAllGood;
}

}  // namespace

void declare_synth(CommandLine& line) {
  const auto a = std::make_shared<SynthArguments>();
  Command command =
      line.add("synth", "Write synthetic motions: truth/ and noisy/, a file per motion",
               "mimicx synth --out set                                  # one of each kind\n"
               "mimicx synth --out set --kinds walk,jump --clips 20     # two kinds, ten of each");
  synth::SynthSetConfig& set = a->set;
  const Option out = command.folder("--out", a->out, "folder to write to");
  const Option clips =
      command.number("--clips", set.clips, kFromOne,
                     "number of motions, cycling through the kinds; default: one of each kind");
  const Option kinds = command.some_of(
      "--kinds", set.kinds, selections(),
      "kinds to make, separated by commas; all: every exact kind; floor: sketches that go "
      "down to the floor, to be planned; scenes: stairs, kerbs, boxes and seats, each scene in "
      "scenes/NAME.json; default: the fourteen kinds of data/synthetic");
  const Option noise =
      command.one_of("--noise", set.noise, {"gvhmr", "vibe", "independent", "none", "mixed"},
                     "errors of noisy/; none: exact motion; mixed: each clip with one of these, half of them "
                     "without keypoints");
  const Option camera = command.one_of("--camera", set.camera, {"calibrated", "perturbed", "wild"},
                                       "how well its camera is known");
  const Option keypoints = command.choice("--keypoints", set.keypoints,
                                          {{"joints22", motion::KeypointSet::kJoints22},
                                           {"coco17", motion::KeypointSet::kCoco17},
                                           {"coco133", motion::KeypointSet::kCoco133}},
                                          "which points are detected");
  const Option seed = command.number("--seed", set.seed, kFromZero,
                                     "seed of the first motion of every kind; 101 and above: training split");
  const Option report = command.flag(
      "--report", a->report,
      "print the forces and torques that each motion of the set demands; --out is then optional");
  Option data_set = command.path("--data-set", a->data_set,
                                 "write the project's own small set, test/ and train/, to this folder "
                                 "instead; it is always the same");
  for (const Option& other : {out, clips, kinds, noise, camera, keypoints, seed, report})
    data_set.excludes(other);
  add_force(command, a->force);
  add_json(command, a->json);
  command.action([a] { return synth(*a); });
}

}  // namespace mimicx::tools
