/// Reads motion files of all supported formats. The content decides the format; units, axes and skeletons are
/// converted to our own. `Clip::decisions` lists everything that the reader decided.
///
/// Formats: AMASS-like npz (clip.h), Motion-X npy (motionx.h), joint positions npy (joint_positions.h), BVH
/// (bvh.h), DeepMimic JSON (deepmimic.h), OpenSim's markers .trc (opensim/marker_joints.h).
/// Traps and thresholds: docs/formats.md.
///
/// Files of our own layout (body_model "mimicx"), and those that `write_motion` marks as ours, are trusted to
/// be z up and in metres. The user's settings (`ReadConfig`) override the detection for every file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motion/clip.h"

namespace mimicx::import {

/// m: a motion that begins farther from the origin than half of it is moved there, by a multiple of it.
inline constexpr double kMove = 100.0;

/// Settings of the user that override what the file says or the reader detects.
struct ReadConfig {
  std::optional<char> up;  ///< axis that points up in the file: x, y, z; capital letters: the negative axes
  std::optional<double> scale;     ///< metres per unit of length of the file
  std::optional<double> fps;       ///< the frame rate the motion was recorded at
  bool scene_from_motion = false;  ///< preparation finds it (run/preparation.h), where the file has none
  std::optional<Scene> scene;      ///< the ground, in metres, z up, its floor at z = 0; else that of the file
  std::optional<double> floor;     ///< height of the floor in the file, after axes and scale, m
  std::optional<double> mass;      ///< of the person, kg
  std::optional<double> height;    ///< stature of the person, m
  bool standard_body = false;      ///< ignore the file's body shape
  bool forces_keep_body = false;   ///< mass, height and standard_body are not for motions with forces
  std::filesystem::path smplx;     ///< licensed SMPL-X model: joints of the body where betas are SMPL-X's
  std::filesystem::path joint_map;  ///< more joint names for foreign skeletons
  std::string root;  ///< of a BVH with several skeletons: name or number of the root; empty: the person's
  std::optional<int> person;  ///< of an npz with several people, from 1
  bool verbose = false;       ///< print all decisions instead of a summary

  /// All settings that differ from the default, in one line. Equal lines mean that files are read alike, if
  /// the files that they name are the same.
  std::string text() const;
};

/// The format of a file, by its first bytes.
enum class MotionFormat { kNpz, kNpy, kBvh, kDeepMimic, kMarkers, kUnknown };
MotionFormat recognise(const std::string& bytes);

/// @throws DataError for a file that cannot be read, std::invalid_argument for an invalid setting
motion::Clip read_motion(const std::filesystem::path& path, const ReadConfig& config = {});

/// The same from bytes in memory. @param path  for messages; its stem is the motion's name
motion::Clip motion_from(const std::string& bytes, const std::filesystem::path& path,
                         const ReadConfig& config = {});

/// What the user is told of how a file was read: the reader's decisions (their summary if there is one) and
/// warnings, a line each after the file's name.
std::vector<std::string> told_decisions(const std::string& file, const motion::Clip& clip);

/// The same for tables of many files: without the decisions where the format is the only one.
std::vector<std::string> notable_decisions(const std::string& file, const motion::Clip& clip);

/// Whether a file holds joint positions only; such files cannot be written.
bool holds_positions(const std::filesystem::path& path);

/// Whether a folder's entry is taken for a motion: by its suffix, and for .txt by its content.
bool is_motion_file(const std::filesystem::path& path);

/// Suffix of a file in lower case, with its dot.
std::string lower_suffix(const std::filesystem::path& path);
/// Whether `write_motion` can write files of a suffix.
bool is_written(const std::string& suffix);
/// The suffixes that it can write, for messages.
std::string written_suffixes();

/// The first bytes of the files that `write_motion` writes with this suffix; empty for archives.
std::string_view written_opening(const std::filesystem::path& path);

/// Writes a motion; the suffix chooses the format: .npz (our own layout, docs/formats.md), .npy (Motion-X) or
/// .bvh. @throws std::invalid_argument for another suffix
void write_motion(const std::filesystem::path& path, const motion::Clip& clip);

}  // namespace mimicx::import
