/// The motions that files and folders on the command line name.
///
/// A folder means all motion files in it and in its subfolders, sorted by path. These are skipped, and a
/// message lists them: other files, clean copies (NAME.clean.EXT), folders of earlier runs, the output folder
/// of the command, AMASS's files of body shapes (shape.npz, …_stagei.npz), and links to what is read already.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace mimicx::files {

struct MotionInput {
  std::string path;  ///< to read
  /// Name of its outputs: its path relative to the given folder, without suffix ("CMU/01/01_01_poses"); of a
  /// file that was given itself, its file name without suffix.
  std::string name;
};

/// A file that is given twice, in whatever spelling, is listed once. A folder without motion files, or an
/// unreadable one, is listed itself: reading it then reports the error.
/// @param out       folder that the command writes to; empty: none
/// @param messages  gets a line per folder that lists the skipped files, and one per link to a file that is
///                  listed; null: no message
/// @throws DataError if the only input is a folder without motion files
std::vector<MotionInput> find_motions(const std::vector<std::string>& inputs,
                                      const std::filesystem::path& out = {},
                                      std::ostream* messages = nullptr);

/// A command that is repeated reads its folders of inputs again: none of its results may lie in one of them.
/// A folder of inputs may have the output folder in it, which is skipped there.
/// @param inputs   files and folders as they were given @param out  folder that the command writes to
/// @param results  the files below it that the command will write
/// @throws record::OutputRefused naming the folder of inputs
void require_results_apart(const std::vector<std::string>& inputs, const std::filesystem::path& out,
                           const std::vector<std::filesystem::path>& results);

std::vector<std::string> paths_of(const std::vector<MotionInput>& inputs);

/// Their names made unique: the second one of the same name gets a number ("walk", "walk-2").
std::vector<std::string> unique_names(const std::vector<MotionInput>& inputs);

}  // namespace mimicx::files
