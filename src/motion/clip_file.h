/// Clips in AMASS npz files, which is also the layout of our own motion files (docs/formats.md, "Motions").
///
/// Where a file does not name its body model, the number of columns of `poses` does: 72 → smpl, 156 → smplh,
/// 165 → smplx; 66 columns, or `root_orient` and `pose_body` alone, are the body part of SMPL-X.
///
/// What it does not do: no other format and no change of axes or units (import/motion_file.h).
#pragma once

#include <filesystem>

#include "motion/clip.h"

namespace mimicx::motion {

/// Reads an AMASS-style npz: `root_orient` + `pose_body`, or the first 66 columns of `poses` (66, 72, 156 or
/// 165 columns); `trans`; `betas`; `mocap_framerate` or `mocap_frame_rate`. Columns of `poses` past the 66th
/// are kept as the member `poses_rest`; betas past the tenth as
/// `betas_rest`. Undetected keypoints (not finite) get confidence 0. Keypoints without names are the body's
/// joints where they are 22 and those of COCO where they are 17; a decision says so.
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

}  // namespace mimicx::motion
