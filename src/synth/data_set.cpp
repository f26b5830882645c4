#include "synth/data_set.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/file.h"
#include "core/random.h"
#include "motion/clip_file.h"

namespace mimicx::synth {
namespace {

constexpr std::uint64_t kSetNoiseStream = 0x53594E04, kMixStream = 0x53594E05;

/// Adding 0 turns −0 into 0, because the sign of a zero is a last-bit difference as well.
double on_grid(double value, double steps) { return std::round(value * steps) / steps + 0.0; }

void round_to_grid(motion::Clip& clip) {
  constexpr double kSteps = 1 << 20, kPixelSteps = 1 << 10;
  const auto round = [](Vector3d& v) { v = v.unaryExpr([](double x) { return on_grid(x, kSteps); }); };
  for (auto& frame : clip.rotations)
    for (Vector3d& rotation : frame) round(rotation);
  for (Vector3d& trans : clip.trans) round(trans);
  for (double& beta : clip.betas) beta = on_grid(beta, kSteps);
  for (Plate& plate : clip.scene.plates) {
    for (double* value : {&plate.centre.x(), &plate.centre.y(), &plate.yaw, &plate.half_extents.x(),
                          &plate.half_extents.y(), &plate.height})
      *value = on_grid(*value, kSteps);
  }
  if (!clip.keypoints) return;
  for (auto& frame : clip.keypoints->uvc)
    for (Vector3d& point : frame)
      point = {on_grid(point.x(), kPixelSteps), on_grid(point.y(), kPixelSteps), on_grid(point.z(), kSteps)};
  clip.keypoints->intrinsics =
      clip.keypoints->intrinsics.unaryExpr([](double x) { return on_grid(x, kPixelSteps); });
  for (Eigen::Matrix4d& extrinsics : clip.keypoints->extrinsics)
    extrinsics = extrinsics.unaryExpr([](double x) { return on_grid(x, kSteps); }).eval();
}

/// Every clip has errors and a camera of its own, whichever set it is in.
std::uint64_t noise_seed(const SynthConfig& clip) {
  Random random(clip.seed, {kSetNoiseStream, index_of_kind(clip.kind)});
  const std::uint64_t high = random.bits(), low = random.bits();
  return high << 32 | low;
}

/// The noise of a clip of a "mixed" set.
EstimateConfig mixed(const SynthSetConfig& set, std::uint64_t seed) {
  Random random(seed, {kMixStream});
  const double drawn = random.uniform();
  EstimateConfig estimate{noise_preset(drawn < 0.3   ? "gvhmr"
                                       : drawn < 0.6 ? "vibe"
                                       : drawn < 0.9 ? "independent"
                                                     : "none"),
                          camera_error(set.camera), set.keypoints};
  if (random.uniform() < 0.5) estimate.keypoints.reset();
  return estimate;
}

}  // namespace

std::vector<SynthConfig> clips_of_set(const SynthSetConfig& config) {
  const std::vector<std::string> kinds = config.kinds.empty() ? basic_kinds() : config.kinds;
  for (auto kind = kinds.begin(); kind != kinds.end(); ++kind) {
    index_of_kind(*kind);  // throws for an unknown kind
    if (std::find(kinds.begin(), kind, *kind) != kind)
      throw std::invalid_argument("kind of motion '" + *kind + "' is named twice");
  }
  if (config.clips < 0) throw std::invalid_argument("the number of clips must not be negative");
  std::vector<SynthConfig> clips(config.clips == 0 ? kinds.size() : static_cast<std::size_t>(config.clips));
  for (std::size_t i = 0; i < clips.size(); ++i) {
    clips[i].kind = kinds[i % kinds.size()];
    clips[i].seed = config.seed + i / kinds.size();
    clips[i].betas_from_seed = true;
  }
  return clips;
}

SynthPair make_synth_pair(const SynthConfig& clip, const SynthSetConfig& config) {
  const std::uint64_t seed = noise_seed(clip);
  const EstimateConfig noise =
      config.noise == "mixed"
          ? mixed(config, seed)
          : EstimateConfig{noise_preset(config.noise), camera_error(config.camera), config.keypoints};
  SynthPair pair;
  pair.truth = synthesize(clip);
  round_to_grid(pair.truth);
  pair.noisy = estimate(pair.truth, noise, seed);
  pair.noisy.scene = {};  // of the truth
  round_to_grid(pair.noisy);
  return pair;
}

void write_synth_set(const std::filesystem::path& directory, const SynthSetConfig& config,
                     const std::function<void(std::size_t index, const motion::Clip& truth)>& written) {
  const std::vector<SynthConfig> clips = clips_of_set(config);
  make_folder(directory / "truth");
  make_folder(directory / "noisy");
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const SynthPair pair = make_synth_pair(clips[i], config);
    const std::string file = pair.truth.name + ".npz";
    motion::write_clip(directory / "truth" / file, pair.truth);
    motion::write_clip(directory / "noisy" / file, pair.noisy);
    if (written) written(i, pair.truth);
  }
}

std::vector<std::pair<std::string, SynthSetConfig>> synthetic_splits() {
  SynthSetConfig test, train;
  test.seed = kTestSeed;
  train.seed = kTrainingSeed;
  return {{"test", test}, {"train", train}};
}

void write_synthetic_data(const std::filesystem::path& directory) {
  for (const auto& [split, config] : synthetic_splits()) write_synth_set(directory / split, config);
}

}  // namespace mimicx::synth
