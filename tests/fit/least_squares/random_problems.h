/// Small fit problems at random states, and derivatives of anything by central differences.
#pragma once

#include <algorithm>
#include <cmath>

#include "fit/least_squares/fit_kinematics.h"
#include "motion/made_motions.h"
#include "motion/surface_points.h"
#include "synth/noise/keypoint_noise.h"

namespace mimicx::test {

/// A few frames of random motion with detections by a camera in front of it.
inline fit::FitProblem random_problem(std::uint64_t seed, int frames, const fit::FitConfig& config,
                                      motion::KeypointSet set = motion::KeypointSet::kJoints22) {
  motion::Clip clip = random_clip(seed, frames, 0.15);
  synth::Camera camera;
  camera.intrinsics << 900, 2, 640, 0, 950, 360, 0, 0, 1;
  camera.extrinsics.block<3, 3>(0, 0) << 1, 0, 0, 0, 0.1, -std::sqrt(0.99), 0, std::sqrt(0.99), 0.1;
  camera.extrinsics.block<3, 1>(0, 3) = Vector3d(0.1, 1.2, 4.5);
  const Character character = motion::character_of(clip);
  const PerFrame<PerBody<Quaterniond>> q = motion::joint_rotations(clip);
  PerFrame<Vector3d> p_root;
  for (const BodyPoses& poses : motion::poses_of(clip)) p_root.push_back(poses.p_WB[kPelvis]);
  clip.keypoints = synth::detect_keypoints({character, p_root, q, clip.fps}, camera, set,
                                           synth::noise_preset("none"), seed);
  return fit::make_problem(clip, config);
}

inline fit::FitState random_state(const fit::FitProblem& problem, std::uint64_t seed, double size) {
  Random random(seed, {7});
  fit::FitState state = fit::initial_state(problem);
  for (fit::FrameVector& c : state.c)
    for (double& x : c) x = size * random.normal();
  for (double& x : state.g) x = 0.02 * random.normal();
  return state;
}

struct Moved {
  PerFrame<fit::FrameKinematics> motion;
  PerFrame<fit::FootPositions> feet;
};

inline Moved move(const fit::FitProblem& problem, const fit::FitState& state) {
  const Character character = character_of(problem, state);
  Moved m;
  for (int t = 0; t < problem.frames(); ++t) {
    m.motion.push_back(fit::kinematics(problem, state, character, t));
    fit::FootPositions& feet = m.feet.emplace_back();
    const std::vector<Vector3d> surface =
        motion::surface_positions(motion::surface_points(character), m.motion.back().poses);
    std::copy_n(surface.begin(), kFootPoints, feet.begin());
  }
  return m;
}

/// Every unknown of a state in one row: frames first, then the clip's.
inline double& unknown(fit::FitState& state, Eigen::Index i) {
  const auto frames = static_cast<Eigen::Index>(state.c.size());
  if (i >= frames * fit::kFrameUnknowns) return state.g[i - frames * fit::kFrameUnknowns];
  return state.c[i / fit::kFrameUnknowns][i % fit::kFrameUnknowns];
}

/// Derivative of a vector function of the state by central differences.
template <class Function>
Eigen::MatrixXd finite_differences(const fit::FitState& at, Function function) {
  const auto size = static_cast<Eigen::Index>(at.c.size()) * fit::kFrameUnknowns + at.g.size();
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd J;
  for (Eigen::Index i = 0; i < size; ++i) {
    fit::FitState up = at, down = at;
    unknown(up, i) += kStep;
    unknown(down, i) -= kStep;
    const Eigen::VectorXd column = (function(up) - function(down)) / (2.0 * kStep);
    if (i == 0) J.resize(column.size(), size);
    J.col(i) = column;
  }
  return J;
}

}  // namespace mimicx::test
