/// Motions as people have them on disk: the format is recognised from the content, foreign conventions end
/// here, and everything that was decided on the way stands in `Clip::decisions`.
///
/// Formats: AMASS-like npz (clip.h), Motion-X npy (motionx.h), joint positions npy (joint_positions.h), BVH
/// (bvh.h), DeepMimic JSON (deepmimic.h).
/// Traps and thresholds: docs/formats.md.
///
/// Files of our own layout (body_model "mimicx") are believed: z up, metres. What the user says
/// (`ReadConfig`) is believed of every file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "motion/clip.h"

namespace mimicx::import {

/// What the user knows better than the file.
struct ReadConfig {
  std::optional<char> up;  ///< axis that points up in the file: x, y, z; capital letters: the negative axes
  std::optional<double> scale;  ///< metres per unit of length of the file
  std::optional<double> fps;    ///< the frame rate the motion was recorded at
  std::optional<double> floor;  ///< height of the floor in the file, after axes and scale, m
  bool standard_body = false;   ///< ignore the file's body shape
  std::filesystem::path smplx;  ///< licensed SMPL-X model: gives the body its joints where betas are SMPL-X's
  std::filesystem::path joint_map;  ///< more joint names for foreign skeletons
  bool verbose = false;             ///< no summary of the decisions: all of them are told

  /// Everything that was set, in one line; empty: nothing. Settings that read alike have equal lines.
  std::string text() const;
};

/// What a file is, by its first bytes.
enum class MotionFormat { kNpz, kNpy, kBvh, kDeepMimic, kUnknown };
MotionFormat recognise(const std::string& bytes);

/// @throws DataError for a file that cannot be read, std::invalid_argument for a setting that makes no sense
motion::Clip read_motion(const std::filesystem::path& path, const ReadConfig& config = {});

/// The same from bytes in memory. @param path  for messages; its stem is the motion's name
motion::Clip motion_from(const std::string& bytes, const std::filesystem::path& path,
                         const ReadConfig& config = {});

/// Whether the content of a file is joint positions alone: there is no writing it back.
bool holds_positions(const std::filesystem::path& path);

/// Whether a folder's entry is taken for a motion: by its suffix; a .txt by its content.
bool is_motion_file(const std::filesystem::path& path);

/// Suffix of a file in lower case, with its dot: people write .BVH and .bvh.
std::string lower_suffix(const std::filesystem::path& path);
/// Whether `write_motion` knows a suffix; those it knows, for messages.
bool is_written(const std::string& suffix);
std::string written_suffixes();

/// How the files of a suffix begin that `write_motion` makes; empty for archives, which are known otherwise.
std::string_view written_opening(const std::filesystem::path& path);

/// Writes a motion in the format that the suffix names: .npz (our own layout, docs/formats.md), .npy
/// (Motion-X) or .bvh. @throws std::invalid_argument for another suffix
void write_motion(const std::filesystem::path& path, const motion::Clip& clip);

}  // namespace mimicx::import
