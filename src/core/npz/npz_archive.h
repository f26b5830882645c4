/// A NumPy archive in memory, and its bytes: what needs no files.
///
/// Written archives are stored, carry a fixed time stamp and keep the order of their members, so that equal
/// content means equal bytes.
///
/// Format: PKWARE APPNOTE 6.3 (zip); the members are those of npy.h.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/npz/npy_array.h"

namespace mimicx {

/// Members in file order. Members of an unsupported kind (AMASS files carry such) do not make the others
/// unreadable: they are listed apart, and asking for one says why it is not there.
class Npz {
 public:
  bool has(const std::string& key) const;
  /// @throws DataError naming the archive and the key when it is absent, UnsupportedArray when it is there
  ///         but of a kind that is not read.
  const NpyArray& at(const std::string& key) const;
  /// Adds, or replaces in place.
  void set(const std::string& key, NpyArray array);
  const std::vector<std::pair<std::string, NpyArray>>& members() const { return members_; }
  void set_unsupported(const std::string& key, UnsupportedArray why) { unsupported_.emplace_back(key, why); }
  const std::vector<std::pair<std::string, UnsupportedArray>>& unsupported() const { return unsupported_; }
  std::string path;  ///< where it came from, for messages

 private:
  std::vector<std::pair<std::string, NpyArray>> members_;
  std::vector<std::pair<std::string, UnsupportedArray>> unsupported_;
};

/// The only number of a member.
/// @throws DataError when the member is absent, text, or not exactly one element
double number_at(const Npz& archive, const std::string& key);
/// The same for a whole number. @throws DataError where it has a fraction, too, or is beyond 2^53
std::int64_t whole_number_at(const Npz& archive, const std::string& key);
/// So many numbers, of a member of any shape. @throws DataError also for another number of them, or text
std::vector<double> numbers_at(const Npz& archive, const std::string& key, std::size_t count);
/// The only text of a member. @throws DataError when the member is absent or not exactly one text
const std::string& text_at(const Npz& archive, const std::string& key);

/// The bytes of the archive.
std::string format_npz(const Npz& archive);

}  // namespace mimicx
