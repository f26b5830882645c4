/// The motions that files and folders on the command line name.
///
/// A folder stands for all motion files in it and in the folders inside it, sorted by path. Left out, and
/// said so: what is no motion, clean copies (NAME.clean.EXT) and folders that an earlier run filled, the
/// folder that the command writes to, and what AMASS has beside its motions (shape.npz, …_stagei.npz).
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace mimicx::files {

struct MotionInput {
  std::string path;  ///< to read
  /// What its outputs are called: its place in the folder that was named, without suffix
  /// ("CMU/01/01_01_poses"); of a file that was named itself, its file name without suffix.
  std::string name;
};

/// A file that is named twice, in whatever spelling, is there once. A folder without motion files, or one
/// that may not be read, stays in the list: reading it then says why.
/// @param out       folder that the command writes to; empty: none
/// @param messages  gets a line per folder that names what of it is left out; null: nobody is told
/// @throws DataError where the only input is a folder without motion files
std::vector<MotionInput> find_motions(const std::vector<std::string>& inputs,
                                      const std::filesystem::path& out = {},
                                      std::ostream* messages = nullptr);

std::vector<std::string> paths_of(const std::vector<MotionInput>& inputs);

/// Their names, numbered from the second of the same name on ("walk", "walk-2").
std::vector<std::string> unique_names(const std::vector<MotionInput>& inputs);

}  // namespace mimicx::files
