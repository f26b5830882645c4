/// Clips in AMASS npz files, which is also the layout of our own motion files (docs/formats.md, "Motions").
///
/// A file without a body model's name gets the one that fits the number of columns of `poses`: 72 → smpl,
/// 156 → smplh, 165 → smplx. 66 columns, or `root_orient` and `pose_body` alone, are the body part of SMPL-X.
///
/// What it does not do: no other format and no change of axes or units (import/motion_file.h).
#pragma once

#include <filesystem>
#include <optional>

#include "motion/clip.h"

namespace mimicx::motion {

struct ClipConfig {
  std::optional<double> fps;  ///< stands in for a frame rate that the file lacks, or that is none
  std::optional<int> person;  ///< of a file with several people, from 1; none: the only one
};

/// Reads an AMASS-style npz: `root_orient` + `pose_body`, or the first 66 columns of `poses` (66, 72, 156 or
/// 165 columns, flat or 3 by 3); `trans`; `betas`; `mocap_framerate` or `mocap_frame_rate`; or these under
/// the other names of docs/formats.md, and with a dimension for people in front. Columns of `poses` past the
/// 66th are kept as the member `poses_rest`, betas past the tenth as `betas_rest`; they need not be finite.
/// Keypoints that are not finite get confidence 0. Keypoints without names are taken for the body's joints if
/// they are 22, for COCO's points if they are 17, for COCO-WholeBody's if they are 133; a decision says so.
/// @throws DataError naming file and member.
Clip read_clip(const std::filesystem::path& path, const ClipConfig& config = {});
/// The same from an archive in memory.
Clip clip_from(const Npz& npz, const std::string& name, const ClipConfig& config = {});

/// Member `joints`, (frames, 22, 3): the joints of the clip's body in the world, m.
NpyArray joint_positions_member(const Clip& clip);

/// The scene of an archive, member `scene_plates` (plates, 8): centre x, y, yaw, half extents x, y, height,
/// stiffness, damping of each. Without the member the ground is flat, and a flat ground adds no member.
/// @throws DataError naming file, member and plate
Scene scene_of(const Npz& npz);
void add_scene(const Scene& scene, Npz& npz);
inline constexpr const char* kSceneMember = "scene_plates";

/// The joints of a body that are known, member `rest_joints` (22, 3), m; without the member none.
/// @throws DataError naming file and member
std::optional<RestJoints> rest_joints_of(const Npz& npz);
void add_rest_joints(const std::optional<RestJoints>& joints, Npz& npz);

/// The member by which an archive says that it is z up and in metres, and its text. Reading believes it.
inline constexpr const char* kWorldMember = "mimicx_world";
inline constexpr const char* kOurWorld = "z up, m";
/// Whether the archive that a clip was read from says so.
bool is_in_our_world(const Clip& clip);
/// That member, for a clip of another body than ours, whose world readers would detect anew; else none.
std::vector<std::pair<std::string, NpyArray>> world_members(const Clip& clip);

/// The members of our own motion file: the standard ones, keypoints and camera,
/// passed-through members, and `extra`, which replaces members of the same name. `poses_rest` and
/// `betas_rest` are appended to `poses` and `betas` again. A clip with named arrays of SMPL-X also gets
/// `root_orient` and `pose_body`.
Npz to_npz(const Clip& clip, const std::vector<std::pair<std::string, NpyArray>>& extra = {});
/// Writes them.
void write_clip(const std::filesystem::path& path, const Clip& clip,
                const std::vector<std::pair<std::string, NpyArray>>& extra = {});

}  // namespace mimicx::motion
