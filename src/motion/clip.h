/// A motion as it stands in a file: SMPL-style rotations and translations, before any reference is made.
///
/// Layout: AMASS npz. The world is z up, metres; joint order is that of `Body`; the first 22 joints of every
/// SMPL-family model are the same. Where a file does not name its body model, the number of columns of
/// `poses` does: 72 → smpl, 156 → smplh, 165 → smplx; 66 columns, or `root_orient` and `pose_body` alone, are
/// the body part of SMPL-X.
///
/// What it does not do: no resampling, no repair, no change of axes (reference.h prepares a motion).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "character/character.h"
#include "core/npz.h"

namespace mimicx {

/// 2D detections and the pinhole camera that saw them.
struct Keypoints {
  std::vector<std::string> names;          ///< [K]
  std::vector<std::vector<Vector3d>> uvc;  ///< [frames][K] u, v in pixels and confidence in [0, 1]
  Matrix3d intrinsics = Matrix3d::Identity();
  std::vector<Eigen::Matrix4d>
      extrinsics;  ///< one, or one per frame: world → camera (x right, y down, z forward)
};

struct Clip {
  std::string name;  ///< file name without folder and suffix
  double fps = 30.0;
  std::vector<PerBody<Vector3d>> rotations;  ///< [frames][22] axis-angle: root in world, joints local
  std::vector<Vector3d> trans;               ///< [frames] SMPL's trans: pelvis = trans + J0(body_model)
  std::array<double, kBetas> betas{};        ///< as in the file
  std::string body_model = "mimicx";
  std::string gender = "neutral";
  std::optional<Keypoints> keypoints;
  std::vector<std::pair<std::string, NpyArray>> passthrough;  ///< members the program does not use
  std::vector<std::string> warnings;   ///< one line each, e.g. a foreign beta that was set aside
  std::vector<std::string> decisions;  ///< what reading decided, one line each
  /// Joints of the file's own body where they are known: J(β) of a licensed model. They replace the standard
  /// body and the mean J0.
  std::optional<RestJoints> rest_joints;
  bool on_floor = false;  ///< the floor is z = 0 because the user says so: nothing moves the whole motion

  int frames() const { return static_cast<int>(rotations.size()); }
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
std::vector<PerBody<Quaterniond>> joint_rotations(const Clip& clip);

/// World poses of the clip as it stands, every joint spherical, on its body.
std::vector<BodyPoses> poses_of(const Clip& clip);

/// The clip at another frame rate, from its first frame on, rotations by slerp; unchanged where the rate is
/// the same. Members with one row per frame that passed through are left out, with a warning.
Clip resampled(const Clip& clip, double fps);

/// What to say of a shape that was set aside because its body model is not at hand.
std::string foreign_betas_warning(const std::string& body_model);

/// Reads an AMASS-style npz: `root_orient` + `pose_body`, or the first 66 columns of `poses` (66, 72, 156 or
/// 165 columns); `trans`; `betas`; `mocap_framerate` or `mocap_frame_rate`. Columns of `poses` past the 66th
/// are kept as the member `poses_rest`, unless the file holds them as named arrays; betas past the tenth as
/// `betas_rest`. Undetected keypoints (not finite) get confidence 0.
/// @throws DataError naming file and member.
Clip read_clip(const std::filesystem::path& path);
/// The same from an archive in memory.
Clip clip_from(const Npz& npz, const std::string& name);

/// The members of our own motion file: the standard ones, keypoints and camera, what passed through, and
/// `extra`, which replaces a member of the same name. `poses_rest` and `betas_rest` go back to where they
/// came from; beside named arrays of SMPL-X the motion also stands in `root_orient` and `pose_body`.
Npz to_npz(const Clip& clip, const std::vector<std::pair<std::string, NpyArray>>& extra = {});
/// Writes them.
void write_clip(const std::filesystem::path& path, const Clip& clip,
                const std::vector<std::pair<std::string, NpyArray>>& extra = {});

}  // namespace mimicx
