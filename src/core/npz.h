/// NumPy arrays and archives: read what NumPy writes, write what NumPy opens.
///
/// An npz file is a zip of npy members, stored or deflated. Written archives are stored, carry a fixed
/// time stamp and keep the order of their members, so that equal content means equal bytes; they are
/// written to a temporary name and renamed. Deflated members need zlib (absent in the core-only build).
///
/// Formats: PKWARE APPNOTE 6.3 (zip), NumPy Enhancement Proposal 1 (npy). What it does not do: object
/// arrays (they are pickles: running foreign code), complex and structured types, encrypted or split
/// archives, archives of 4 GiB and more.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace mimicx {

/// A sound npy array of a kind that is not read: objects, complex numbers, records.
class UnsupportedArray : public DataError {
  using DataError::DataError;
};

/// One array, C order, little endian. Text is kept as UTF-8 strings, one per element. Narrower types are
/// widened when read: f2 → float32; i1, i2, u2 → int32; u4, u8 → int64.
struct NpyArray {
  enum class Type { kFloat32, kFloat64, kInt32, kInt64, kUInt8, kBool, kText };
  Type type = Type::kFloat64;
  std::vector<std::size_t> shape;   ///< empty: a 0-d array
  std::vector<std::uint8_t> bytes;  ///< raw elements (all types but text)
  std::vector<std::string> text;    ///< elements of a text array

  std::size_t size() const;  ///< number of elements
  /// Elements converted to double. @throws std::invalid_argument for text.
  std::vector<double> to_double() const;

  static NpyArray from_double(std::vector<std::size_t> shape, const double* values);
  static NpyArray from_float(std::vector<std::size_t> shape, const float* values);
  static NpyArray from_int64(std::vector<std::size_t> shape, const std::int64_t* values);
  static NpyArray from_int32(std::vector<std::size_t> shape, const std::int32_t* values);
  static NpyArray from_text(std::vector<std::string> values);  ///< 1-d
  static NpyArray scalar(double value);                        ///< 0-d float64
  static NpyArray scalar_int(std::int64_t value);              ///< 0-d int64
  static NpyArray scalar_text(std::string value);              ///< 0-d text
};

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

/// Unpacked bytes of an archive, or of one array: 2 GiB are 20 hours of SMPL-X poses at 30 fps.
inline constexpr std::size_t kMaxMemberBytes = std::size_t{1} << 31;

/// Members whose name does not end in ".npy" are not arrays and are left out.
/// @param keys  which members to read; none: all
/// @throws DataError for anything that is not a readable archive; never allocates more than
///         `max_bytes` for its members, whatever their headers say.
Npz read_npz(const std::filesystem::path& path, std::size_t max_bytes = kMaxMemberBytes,
             const std::vector<std::string>& keys = {});
/// The same from bytes in memory. @param path  for messages
Npz parse_npz(const std::string& bytes, const std::string& path, std::size_t max_bytes = kMaxMemberBytes,
              const std::vector<std::string>& keys = {});
void write_npz(const std::filesystem::path& path, const Npz& archive);
/// The bytes `write_npz` writes.
std::string format_npz(const Npz& archive);

/// Writes text or bytes to a temporary name beside `path` and renames it.
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

/// Parses one npy member. @param path, place  for messages.
/// @throws DataError when it is damaged, UnsupportedArray when it is of a kind that is not read.
NpyArray parse_npy(const std::uint8_t* data, std::size_t size, const std::string& path,
                   const std::string& place, std::size_t max_bytes = kMaxMemberBytes);
/// npy version 1.0, C order.
std::string format_npy(const NpyArray& array);

/// A numeric member as a matrix (first dimension, product of the rest); a 0-d array is 1 × 1.
Eigen::MatrixXd to_matrix(const NpyArray& array);
NpyArray from_matrix(const Eigen::MatrixXd& matrix);

}  // namespace mimicx
