#include "synth/noise/estimator_noise.h"

#include <algorithm>
#include <stdexcept>

#include "core/units.h"
#include "synth/noise/foot_skate.h"
#include "synth/noise/keypoint_noise.h"
#include "synth/noise/motion_errors.h"
#include "synth/noise/random_processes.h"

namespace mimicx::synth {
namespace {

constexpr double kStaturePerBeta = 0.03;  ///< growth of the body by one of its first β (character.cpp)

/// Height of the pelvis over the soles of a body that stands straight, m.
double standing_height(const Character& character) {
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  q[kPelvis] = rotation_between(Vector3d::UnitY(), Vector3d::UnitZ());
  return -lowest_contact(character, forward_kinematics(character, Vector3d::Zero(), q));
}

/// Adds pan and roll errors to a camera, in addition to the tilt error of `erroneous_camera`.
CameraPath turned_camera(const CameraPath& camera, double degrees, std::uint64_t seed) {
  Random random(seed, {kToldTurnStream});
  const double pan = degrees * random.normal(), roll = degrees * random.normal();
  CameraPath told = camera;
  for (Eigen::Matrix4d& extrinsics : told.extrinsics) {
    const Matrix3d turn = exp_map(kDegree * Vector3d(0.0, pan, roll)).toRotationMatrix();
    extrinsics.topRows<3>() = (turn * extrinsics.topRows<3>()).eval();
  }
  return told;
}

}  // namespace

std::array<double, kBetas> mistaken_betas(const std::array<double, kBetas>& betas, const NoisePreset& preset,
                                          std::uint64_t seed) {
  Random stature(seed, {kStatureStream}), proportions(seed, {kProportionStream});
  std::array<double, kBetas> told = betas;
  told[0] += preset.stature / kStaturePerBeta * stature.normal();
  for (std::size_t k = 1; k < told.size(); ++k) told[k] += preset.proportions * proportions.normal();
  for (double& beta : told) beta = std::clamp(beta, -kMaxBeta, kMaxBeta);
  return told;
}

motion::Clip add_noise(const motion::Clip& truth, const NoiseConfig& config) {
  if (truth.frames() < 2) throw std::invalid_argument("add_noise: at least 2 frames are needed");
  if (truth.body_model != "mimicx") throw std::invalid_argument("add_noise: the body model must be 'mimicx'");
  const NoisePreset& preset = config.preset;
  const Vector3d rest = mimicx::rest_pelvis(truth.body_model);
  const PerFrame<BodyPoses> poses = motion::poses_of(truth);
  const CameraPath camera = config.camera.moving ? carry_camera(poses, config.seed, truth.fps)
                                                 : CameraPath(place_camera(poses, config.seed));
  EstimatedMotion motion;
  motion.q = motion::joint_rotations(truth);
  for (const Vector3d& trans : truth.trans) motion.p_root.push_back(trans + rest);

  const Character body = make_character(truth.betas);
  const SeenMotion seen{body, motion.p_root, motion.q, truth.fps};
  motion::Keypoints keypoints = detect_keypoints(seen, camera, config.keypoints, preset, config.seed);
  const CameraPath told = turned_camera(erroneous_camera(camera, config.camera, config.seed, truth.fps),
                                        preset.camera_turn * config.camera.tilt, config.seed);
  keypoints.intrinsics = told.intrinsics;
  keypoints.extrinsics = told.extrinsics;

  const Character mistaken = make_character(mistaken_betas(truth.betas, preset, config.seed));
  disturb_rotations(preset, config.seed, truth.fps, motion);
  disturb_travel(preset, config.seed, truth.fps, motion);
  disturb_place(preset, config.seed, truth.fps, camera, motion);
  const double taller = standing_height(mistaken) - standing_height(body);  // its feet stay on the floor
  for (Vector3d& p_root : motion.p_root) p_root.z() += taller;
  skate(mistaken, poses, preset.skate, config.seed, truth.fps, motion);
  put_on_floor(preset, mistaken, body, poses, motion);

  motion::Clip noisy = motion::to_clip(truth.name, truth.fps, mistaken, motion.p_root, motion.q);
  noisy.gender = truth.gender;
  noisy.keypoints = std::move(keypoints);
  return noisy;
}

}  // namespace mimicx::synth
