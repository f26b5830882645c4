/// The first noise model: turns a clean clip into a "video-recovered" one with the errors of a video
/// estimator, 2D keypoints and a camera.
///
/// Source: a noise model fitted so that the metrics of the noisy clips land near the rows "VIBE" and
/// "GVHMR" of the paper's Table 1 (docs/method.md, "Noise model"). Notation there and here: N is one
/// standard normal per clip, S_τ a unit-variance Gaussian process with autocorrelation exp(−Δ²/4τ²),
/// J_s unit-variance white noise filtered by a Gaussian of s frames.
///
/// Camera and errors follow from the seed. Each term has its own random stream, so that turning one off does
/// not change the others. What it does not do: no images, no occlusion by geometry (independent_noise.h); the
/// truth is never written into the noisy clip.
#pragma once

#include <string_view>

#include "synth/noise/keypoint_noise.h"

namespace mimicx::synth {

/// Amplitudes of the error terms. Angles in degrees, lengths in metres, times in seconds.
struct NoisePreset {
  // Joint rotations, right-multiplied, per axis: w_j · (static·N + slow·S_slow_tau + jitter·J_jitter_frames).
  double joint_static, joint_slow, slow_tau, joint_jitter, jitter_frames;
  // Root orientation, world axes, left-multiplied; the heading also takes a random walk (°/√s).
  double root_static, root_slow, root_jitter, heading_walk;
  // Bursts on one limb joint: per second, length in frames, size in degrees.
  double burst_rate, burst_frames_min, burst_frames_max, burst_min, burst_max;
  // Root position along the camera's depth axis; the lateral axis takes `lateral` times a copy.
  double depth_static, depth_slow, depth_tau, depth_jitter, depth_jitter_frames, lateral;
  double drift, drift_tau;  // velocity of the drift: drift · S_drift_tau, m/s
  double speed_error,
      heading_error;  // path scaled by 1 + speed_error·N and turned by heading_error·N degrees
  // Height: snap · (support height error, smoothed over snap_frames) is subtracted, then offsets are added.
  double snap, snap_frames;
  double height_offset, height_static, height_slow, height_jitter;
};

/// "vibe-like" or "gvhmr-like". @throws std::invalid_argument for another name.
NoisePreset noise_preset(std::string_view name);

struct NoiseConfig {
  NoisePreset preset = noise_preset("gvhmr-like");
  CameraError camera = camera_error("perturbed");
  motion::KeypointSet keypoints = motion::KeypointSet::kJoints22;
  std::uint64_t seed = 0;
};

/// The simulated estimate of a clean clip of body model "mimicx": rotations, trans and β with errors,
/// keypoints of the clean motion with detection errors, and a camera with errors.
/// @throws std::invalid_argument for fewer than 2 frames or another body model.
motion::Clip add_noise(const motion::Clip& truth, const NoiseConfig& config);

/// Bursts of a clip, in order of their start.
std::vector<Burst> draw_bursts(const NoisePreset& preset, std::uint64_t seed, int frames, double fps);

}  // namespace mimicx::synth
