/// A motion before any reference is made of it: SMPL-style rotations and translations, the body they belong
/// to, and the 2D keypoints somebody detected.
///
/// The world is z up, in metres; joints stand in the order of `Body`, which is that of the first 22 joints of
/// every SMPL-family model. Files are read and written by clip_file.h and import/motion_file.h.
///
/// What it does not do: no resampling (resample.h), no repair (prepare/prepare.h), no change of axes
/// (import/world_transform.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "character/character.h"
#include "core/npz/npz.h"

namespace mimicx::motion {

/// 2D detections and the pinhole camera that saw them.
struct Keypoints {
  std::vector<std::string> names;       ///< [K]
  PerFrame<std::vector<Vector3d>> uvc;  ///< [frames][K] u, v in pixels and confidence in [0, 1]
  Matrix3d intrinsics = Matrix3d::Identity();
  /// One, or one per frame: world → camera (x right, y down, z forward).
  PerFrame<Eigen::Matrix4d> extrinsics;
};

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
  std::vector<std::string> warnings;   ///< one line each, e.g. a foreign beta that was set aside
  std::vector<std::string> decisions;  ///< what reading decided, one line each
  std::vector<std::string> summary;    ///< of many decisions, in three lines for people; else empty
  /// Joints of the file's own body where they are known: J(β) of a licensed model. They replace the standard
  /// body and the mean J0.
  std::optional<RestJoints> rest_joints;
  bool on_floor = false;  ///< the user says that the floor is z = 0: the motion is not shifted as a whole

  int frames() const { return rotations.count(); }
  /// The shape the program may use: `betas` where the body model is ours, else the standard body.
  std::array<double, kBetas> usable_betas() const;
};

/// The body a clip is played on: its own joints where they are known, else that of its usable betas.
Character character_of(const Clip& clip);
/// Where that body has its pelvis at rest: pelvis = trans + rest_pelvis(clip).
Vector3d rest_pelvis(const Clip& clip);

/// Gives a clip the body of another one: body model, betas, gender, rest joints. Rotations and the place of
/// the pelvis in the world stay.
void put_on_body_of(const Clip& other, Clip& clip);

/// @throws DataError naming clip and frame unless it has at least `frames` of them, a place for each, and
/// finite numbers alone.
void require_usable(const Clip& clip, int frames);

/// Joint rotations as quaternions, [frames][22].
PerFrame<PerBody<Quaterniond>> joint_rotations(const Clip& clip);

/// World poses of the clip as it stands, every joint spherical, on its body.
PerFrame<BodyPoses> poses_of(const Clip& clip);

/// Simulated or prepared motion → clip of body model "mimicx".
/// @param p_root  [frames] pelvis joint in world, m
/// @param q       [frames][22] joint rotations relative to the parent; entry 0: root in world
Clip to_clip(const std::string& name, double fps, const Character& character,
             const PerFrame<Vector3d>& p_root, const PerFrame<PerBody<Quaterniond>>& q);

/// What to say of a shape that was set aside because its body model is not at hand.
std::string foreign_betas_warning(const std::string& body_model);

}  // namespace mimicx::motion
