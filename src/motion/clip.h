/// A motion as read from a file: SMPL rotations and translations, the body they belong to, and detected 2D
/// keypoints. A reference is made of it later (reference.h).
///
/// The world is z up, in metres; joints stand in the order of `Body`, which is that of the first 22 joints of
/// every SMPL-family model. Files are read and written by clip_file.h and import/motion_file.h.
///
/// What it does not do: no resampling (resample.h), no repair (prepare/prepare.h), no change of axes
/// (import/world_transform.h).
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "character/character.h"
#include "character/scene.h"
#include "core/npz/npz.h"

namespace mimicx::motion {

/// 2D detections and their pinhole camera.
struct Keypoints {
  std::vector<std::string> names;       ///< [K]
  PerFrame<std::vector<Vector3d>> uvc;  ///< [frames][K] u, v in pixels and confidence in [0, 1]
  Matrix3d intrinsics = Matrix3d::Identity();
  /// One, or one per frame: world → camera (x right, y down, z forward).
  PerFrame<Eigen::Matrix4d> extrinsics;
};
/// The camera of frame t.
inline const Eigen::Matrix4d& camera_at(const PerFrame<Eigen::Matrix4d>& extrinsics, int t) {
  return extrinsics[std::min(t, extrinsics.count() - 1)];
}
/// The place of a camera in the world, m.
Vector3d eye_of(const Eigen::Matrix4d& extrinsics);

struct Clip {
  std::string name;  ///< file name without folder and suffix
  double fps = 30.0;
  PerFrame<PerBody<Vector3d>> rotations;  ///< [frames][22] axis-angle: root in world, joints local
  PerFrame<Vector3d> trans;               ///< [frames] SMPL's trans: pelvis = trans + J0(body_model)
  std::array<double, kBetas> betas{};     ///< as in the file
  std::string body_model = "mimicx";
  std::string gender = "neutral";
  std::optional<Keypoints> keypoints;
  std::vector<std::pair<std::string, NpyArray>> passthrough;  ///< members the program does not use
  std::vector<std::string> warnings;   ///< one line each, e.g. foreign betas that are ignored
  std::vector<std::string> decisions;  ///< what the reader decided, one line each
  std::vector<std::string> summary;    ///< the decisions in three lines where there are many; else empty
  /// Joints of the file's own body, J(β) of a licensed model, where they are known. They replace the joints
  /// of the standard body and the mean J0.
  std::optional<RestJoints> rest_joints;
  Scene scene;                        ///< the ground, in the world of the motion
  Vector3d place = Vector3d::Zero();  ///< m, by which reading moved everything to the origin
  bool on_floor = false;    ///< the user gave the floor as z = 0: preparation adds no constant height
  bool as_recorded = true;  ///< the user's settings of reading changed nothing to which its forces belong

  int frames() const { return rotations.count(); }
  /// Adds a decision that a summary does not leave out.
  void decide(const std::string& decision) {
    decisions.push_back(decision);
    if (!summary.empty()) summary.push_back(decision);
  }
  /// The shape the program may use: `betas` where the body model is ours, else the standard body.
  std::array<double, kBetas> usable_betas() const;
  /// Whether the program simulates this body: its own, or one whose joints are known.
  bool has_simulated_body() const { return body_model == "mimicx" || rest_joints; }
  /// Whether it comes from a simulation: it has the floor's forces on such a body.
  bool is_simulated() const;
};

/// The body of a clip: from its rest joints where they are known, else from its usable betas.
Character character_of(const Clip& clip);
/// Position of that body's pelvis at rest, m: pelvis = trans + rest_pelvis(clip).
Vector3d rest_pelvis(const Clip& clip);

/// Gives a clip the body of another one: body model, betas, gender, rest joints. Rotations and the pelvis'
/// positions in the world stay the same.
void put_on_body_of(const Clip& other, Clip& clip);

/// @throws DataError naming clip and frame where the clip has fewer than `frames` frames, translations of
/// another length, or numbers that are not finite
void require_usable(const Clip& clip, int frames);

/// Joint rotations as quaternions, [frames][22].
PerFrame<PerBody<Quaterniond>> joint_rotations(const Clip& clip);

/// World poses of the clip on its body, with every joint spherical: knees and elbows are not yet hinges.
PerFrame<BodyPoses> poses_of(const Clip& clip);

/// Simulated or prepared motion → clip of body model "mimicx".
/// @param p_root  [frames] pelvis joint in world, m
/// @param q       [frames][22] joint rotations relative to the parent; entry 0: root in world
Clip to_clip(const std::string& name, double fps, const Character& character,
             const PerFrame<Vector3d>& p_root, const PerFrame<PerBody<Quaterniond>>& q);

/// The warning that betas are ignored because their body model is not available.
std::string foreign_betas_warning(const std::string& body_model);

}  // namespace mimicx::motion
