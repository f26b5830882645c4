#include <cmath>

#include "motion/noise.h"
#include "motion/synth.h"

namespace mimicx {
namespace {

constexpr std::uint64_t kSetSeed = 1;

/// The sum turns −0 into 0: the sign of a zero is a last-bit difference too.
double on_grid(double value, double steps) { return std::round(value * steps) / steps + 0.0; }

void round_to_grid(Clip& clip) {
  constexpr double kSteps = 1 << 20, kPixelSteps = 1 << 10;
  const auto round = [](Vector3d& v) { v = v.unaryExpr([](double x) { return on_grid(x, kSteps); }); };
  for (auto& frame : clip.rotations)
    for (Vector3d& rotation : frame) round(rotation);
  for (Vector3d& trans : clip.trans) round(trans);
  for (double& beta : clip.betas) beta = on_grid(beta, kSteps);
  if (!clip.keypoints) return;
  for (auto& frame : clip.keypoints->uvc)
    for (Vector3d& point : frame)
      point = {on_grid(point.x(), kPixelSteps), on_grid(point.y(), kPixelSteps), on_grid(point.z(), kSteps)};
  clip.keypoints->intrinsics =
      clip.keypoints->intrinsics.unaryExpr([](double x) { return on_grid(x, kPixelSteps); });
  for (Eigen::Matrix4d& extrinsics : clip.keypoints->extrinsics)
    extrinsics = extrinsics.unaryExpr([](double x) { return on_grid(x, kSteps); }).eval();
}

}  // namespace

void write_synthetic_set(const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory / "truth");
  std::filesystem::create_directories(directory / "noisy");
  std::uint64_t noise_seed = 1;  // every clip has errors and a camera of its own
  for (const std::string& kind : synthetic_kinds()) {
    SynthOptions options;
    options.kind = kind;
    options.seed = kSetSeed;
    Clip truth = synthesize(options);
    truth.name = kind;
    round_to_grid(truth);
    NoiseOptions noise;
    noise.seed = noise_seed++;
    Clip noisy = add_noise(truth, noise);
    round_to_grid(noisy);
    write_clip(directory / "truth" / (kind + ".npz"), truth);
    write_clip(directory / "noisy" / (kind + ".npz"), noisy);
  }
}

}  // namespace mimicx
