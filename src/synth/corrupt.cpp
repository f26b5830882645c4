#include "synth/corrupt.h"

#include "core/file.h"
#include "import/plausibility.h"
#include "motion/clip_file.h"
#include "motion/resample.h"

namespace mimicx::synth {
namespace {

constexpr double kFps = 30.0;
constexpr int kFewestFrames = 2;

}  // namespace

motion::Clip benchmark_truth(const motion::Clip& input) {
  motion::require_usable(input, kFewestFrames);
  if (!input.scene.flat())
    throw DataError(input.name, "scene", "a flat floor, for which the errors of estimators are made",
                    std::to_string(input.scene.plates.count()) + " plates");
  const motion::Clip clip = motion::resampled(input, kFps);
  motion::require_usable(clip, kFewestFrames);
  const Character body = make_character(motion::character_of(clip).betas);
  const Vector3d pelvis = motion::rest_pelvis(clip);
  PerFrame<Vector3d> p_root;
  for (const Vector3d& trans : clip.trans) p_root.push_back(trans + pelvis);
  motion::Clip truth = motion::to_clip(input.name, kFps, body, p_root, motion::joint_rotations(clip));
  truth.gender = clip.gender;
  if (clip.body_model != truth.body_model && !clip.on_floor) {
    const double floor = import::detect_floor(truth);
    for (Vector3d& trans : truth.trans) trans.z() -= floor;
  }
  return truth;
}

motion::Clip corrupt_file(const std::filesystem::path& file, const std::string& name,
                          const std::filesystem::path& directory, const CorruptConfig& config) {
  motion::Clip input = import::read_motion(file, config.read);
  motion::Clip truth = benchmark_truth(input);
  truth.name = name;
  const motion::Clip noisy = estimate(truth, config.estimate, clip_seed(config.seed, name));
  const auto write = [&](const char* part, const motion::Clip& clip) {
    const std::filesystem::path path = directory / part / (name + ".npz");
    make_folder(path.parent_path());
    motion::write_clip(path, clip);
  };
  write("truth", truth);
  write("noisy", noisy);
  return input;
}

}  // namespace mimicx::synth
