/// Checks every file that a command wants to write, so that no other file is lost.
///
/// No command overwrites an input, not even with --force. Without --force no command overwrites a file that
/// this program did not write. Our files are recognised by their contents, not by a list: an .npz must have
/// exactly the bytes that this program writes for its members (core/npz/npz.h; NumPy's archives differ),
/// every other kind begins with its own opening.
///
/// What it does not do: it writes nothing (core/file.h) and locks nothing (folder_lock.h).
#pragma once

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mimicx::record {

/// A requested output would overwrite something: wrong usage.
struct OutputRefused : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// How the JSON documents for users begin (json.h, `document`).
inline constexpr std::string_view kJsonOpening = "{\n \"made_by\": \"mimicx\"";

/// Whether this program wrote the file.
/// @param opening  first bytes of such a file; empty: it is an .npz
/// @param at       byte offset of the opening, where lengths come before it
bool is_own_file(const std::filesystem::path& path, std::string_view opening, std::size_t at = 0);

class Outputs {
 public:
  /// @param inputs  every file that the command reads @param force  also overwrite files of other programs
  Outputs(const std::vector<std::string>& inputs, bool force);

  /// Claims a file to write. Empty paths are ignored.
  /// @throws OutputRefused if it is an input, claimed already, no regular file, or, unless forced, not our
  /// file
  void claim(const std::filesystem::path& path, std::string_view opening = {}, std::size_t at = 0);
  /// The same for a file in a run's folder: an existing file may be replaced, whatever it holds.
  void claim_own(const std::filesystem::path& path);

 private:
  void claim_new(const std::filesystem::path& path);

  std::set<std::filesystem::path> inputs_, claimed_;  ///< canonical; absolute and normal
  bool force_;
};

}  // namespace mimicx::record
