/// The door through which every command opens what it writes.
///
/// No command overwrites an input, whatever it is told. No command overwrites a file that a call of the same
/// command did not make, unless it is told to. Files of ours are known by what they hold, not by a list that
/// could be lost: an .npz is byte for byte what this program makes of its members (core/npz/npz.h; NumPy's
/// own archives differ), every other kind begins with its own opening.
///
/// What it does not do: no writing (core/file.h), no lock against a second process.
#pragma once

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mimicx::record {

/// What was asked for would overwrite something: wrong usage.
struct OutputRefused : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// How the JSON documents for users begin (json.h, `document`).
inline constexpr std::string_view kJsonOpening = "{\n \"made_by\": \"mimicx\"";

/// Whether a file is one that this program wrote.
/// @param opening  how such a file begins; empty: it is an archive
/// @param at       the byte at which the opening stands, where lengths come before it
bool is_own_file(const std::filesystem::path& path, std::string_view opening, std::size_t at = 0);

class Outputs {
 public:
  /// @param inputs  every file that the command reads @param force  overwrite what others made
  Outputs(const std::vector<std::string>& inputs, bool force);

  /// Claims a file to write. Empty paths stand for none and are claimed without a word.
  /// @throws OutputRefused where it is an input, claimed already, no regular file, or, unless forced, one
  /// that is not ours
  void claim(const std::filesystem::path& path, std::string_view opening = {}, std::size_t at = 0);
  /// The same of a file in a folder that is known to be ours: what is there may be replaced.
  void claim_own(const std::filesystem::path& path);

 private:
  void claim_new(const std::filesystem::path& path);

  std::set<std::filesystem::path> inputs_, claimed_;  ///< canonical; absolute and normal
  bool force_;
};

}  // namespace mimicx::record
