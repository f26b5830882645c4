/// A NumPy archive in memory, and its conversion to bytes.
///
/// Archives are written without compression, with a fixed time stamp and their members in order, so that
/// equal content gives equal bytes.
///
/// Format: PKWARE APPNOTE 6.3 (zip); the members are those of npy.h.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/npz/npy_array.h"

namespace mimicx {

/// Members in file order. Members of an unsupported type (AMASS files have some) are listed separately, and
/// do not make the others unreadable.
class Npz {
 public:
  bool has(const std::string& key) const;
  /// @throws DataError naming archive and key if it is absent, UnsupportedArray if its type is not supported
  const NpyArray& at(const std::string& key) const;
  /// Adds, or replaces in place.
  void set(const std::string& key, NpyArray array);
  const std::vector<std::pair<std::string, NpyArray>>& members() const { return members_; }
  void set_unsupported(const std::string& key, UnsupportedArray why);
  const std::vector<std::pair<std::string, UnsupportedArray>>& unsupported() const { return unsupported_; }
  std::string path;  ///< of the file, for messages

 private:
  std::vector<std::pair<std::string, NpyArray>> members_;
  std::vector<std::pair<std::string, UnsupportedArray>> unsupported_;
};

/// The number in a member of one element.
/// @throws DataError if the member is absent, text, or not exactly one element
double number_at(const Npz& archive, const std::string& key);
/// The same for an integer. @throws DataError also for a fraction and beyond ± 2^53
std::int64_t whole_number_at(const Npz& archive, const std::string& key);
/// The `count` numbers of a member of any shape. @throws DataError also for another count, or text
std::vector<double> numbers_at(const Npz& archive, const std::string& key, std::size_t count);
/// The text in a member of one element. @throws DataError if it is absent or not exactly one text
const std::string& text_at(const Npz& archive, const std::string& key);

/// The bytes of the archive.
std::string format_npz(const Npz& archive);

}  // namespace mimicx
