/// Clips for the tests of the whole keypoint fit: a truth, and what estimators and detectors make of it.
#pragma once

#include "core/units.h"
#include "fit/keypoint_fit.h"
#include "motion/keypoint_names.h"
#include "motion/made_motions.h"
#include "motion/metrics.h"
#include "motion/synthetic_clip.h"
#include "synth/noise/estimator_noise.h"

namespace mimicx::fit::test {

using namespace mimicx::test;

/// Three seconds of a synthetic motion.
inline motion::Clip truth_of(const std::string& kind) { return synthetic_clip(kind, 5, 90); }

/// Detections that are where they should be: those of the fit's points, zeros for others.
inline motion::Keypoints exact_keypoints(const motion::Clip& truth,
                                         motion::KeypointSet set = motion::KeypointSet::kJoints22) {
  const PerFrame<BodyPoses> poses = motion::poses_of(truth);
  const synth::Camera camera = synth::place_camera(poses, 1);
  const Character character = motion::character_of(truth);
  motion::Keypoints k;
  k.names = motion::keypoint_names(set);
  k.intrinsics = camera.intrinsics;
  k.extrinsics = {camera.extrinsics};
  for (const BodyPoses& pose : poses) {
    k.uvc.emplace_back();
    for (const std::string& name : k.names) {
      const auto place = motion::place_of_keypoint(name);
      if (!place) {
        k.uvc.back().push_back(Vector3d::Zero());
        continue;
      }
      const Vector3d p_B = motion::place_on(character, *place);
      const Vector3d seen = synth::project(camera, pose.p_WB[place->body] + pose.q_WB[place->body] * p_B);
      k.uvc.back().push_back({seen.x(), seen.y(), 1.0});
    }
  }
  return k;
}

/// The truth with a smooth error of a few degrees in every joint and of 0.2 m in place, and exact detections.
inline motion::Clip disturbed(const motion::Clip& truth, std::uint64_t seed,
                              motion::KeypointSet set = motion::KeypointSet::kJoints22) {
  Random random(seed, {3});
  motion::Clip clip = truth;
  clip.keypoints = exact_keypoints(truth, set);
  for (std::size_t j = 0; j < kBodies; ++j) {
    const Vector3d still = 0.05 * test::random_vector(random), slow = 0.02 * test::random_vector(random);
    for (std::size_t t = 0; t < clip.rotations.size(); ++t) {
      const Vector3d error = still + slow * std::sin(0.05 * static_cast<double>(t));
      clip.rotations[t][j] = log_map(exp_map(clip.rotations[t][j]) * exp_map(error));
    }
  }
  for (Vector3d& p : clip.trans) p += Vector3d(0.15, -0.1, 0.08);
  return clip;
}

inline FitConfig exact_camera() {
  FitConfig config;
  config.focal_sigma = config.tilt_sigma = config.beta_sigma = 0.0;
  config.flat_offset_sigma = config.limb_offset_sigma = config.lead_sigma = 0.0;
  return config;
}

inline motion::Metrics against(const motion::Clip& truth, const motion::Clip& motion) {
  const auto samples = [](const motion::Clip& c) {
    return motion::sample_motion(make_character(c.usable_betas()), motion::poses_of(c), c.fps);
  };
  const motion::MotionSamples t = samples(truth);
  return motion::evaluate_motion(samples(motion), &t);
}

inline motion::Clip noisy_of(const motion::Clip& truth, const char* preset, motion::KeypointSet set,
                             std::uint64_t seed) {
  synth::NoiseConfig config;
  config.preset = synth::noise_preset(preset);
  config.keypoints = set;
  config.seed = seed;
  return synth::add_noise(truth, config);
}

}  // namespace mimicx::fit::test
