/// A member of an archive as numbers, and its place for messages.
#pragma once

#include <string>
#include <vector>

#include "core/npz/npz_archive.h"

namespace mimicx::motion {

/// "shape (2, 3)"
std::string text_of_shape(const std::vector<std::size_t>& shape);

/// A member as doubles. Its checks throw DataError, naming file and member.
struct Member {
  const Npz& npz;
  std::string key;
  const NpyArray& array;
  std::vector<double> values;

  /// @throws DataError for text and where there is no such member
  Member(const Npz& archive, const std::string& name);
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;
  std::string shape() const { return text_of_shape(array.shape); }
  void expect_shape(const std::vector<std::size_t>& expected) const;
  /// Number of rows; a row may have further dimensions.
  std::size_t rows() const { return array.shape.empty() ? 0 : array.shape[0]; }
  /// Numbers in a row.
  std::size_t columns() const;
  /// The first `used` of the columns are finite.
  void expect_finite_columns(std::size_t used) const;
  void expect_finite() const;
  [[noreturn]] void fail_not_finite(std::size_t row) const;
};

}  // namespace mimicx::motion
