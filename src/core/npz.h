/// NumPy arrays and archives: read what NumPy writes, write what NumPy opens.
///
/// An npz file is a zip of npy members, stored or deflated. Written archives are stored, carry a fixed
/// time stamp and keep the order of their members, so that equal content means equal bytes; they are
/// written to a temporary name and renamed. Deflated members need zlib (absent in the core-only build).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mimicx {

/// One array, C order, little endian. Text is kept as UTF-8 strings, one per element.
struct NpyArray {
  enum class Type { kFloat32, kFloat64, kInt32, kInt64, kUInt8, kBool, kText };
  Type type = Type::kFloat64;
  std::vector<std::size_t> shape;      ///< empty: a 0-d array
  std::vector<std::uint8_t> bytes;     ///< raw elements (all types but text)
  std::vector<std::string> text;       ///< elements of a text array

  std::size_t size() const;            ///< number of elements
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

/// Members in file order.
class Npz {
 public:
  bool has(const std::string& key) const;
  /// @throws DataError naming the archive and the key when it is absent.
  const NpyArray& at(const std::string& key) const;
  /// Adds, or replaces in place.
  void set(const std::string& key, NpyArray array);
  const std::vector<std::pair<std::string, NpyArray>>& members() const { return members_; }
  std::string path;  ///< where it came from, for messages

 private:
  std::vector<std::pair<std::string, NpyArray>> members_;
};

/// @throws DataError for anything that is not a readable archive; never allocates more than
///         `max_bytes` for one member, whatever its header says.
Npz read_npz(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 31);
void write_npz(const std::filesystem::path& path, const Npz& archive);

/// Writes text or bytes to a temporary name beside `path` and renames it.
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

/// Parses one npy member. @param path, place  for messages.
NpyArray parse_npy(const std::uint8_t* data, std::size_t size, const std::string& path, const std::string& place);
/// npy version 1.0, C order.
std::string format_npy(const NpyArray& array);

/// A floating-point member as a row-major matrix (rows, product of the rest).
Eigen::MatrixXd to_matrix(const NpyArray& array);
NpyArray from_matrix(const Eigen::MatrixXd& matrix);

}  // namespace mimicx
