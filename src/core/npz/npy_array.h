/// An array of numbers or texts, the content of an npy file.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"

namespace mimicx {

/// A valid npy array of unsupported elements: objects, complex numbers, records, whole numbers of 2^63 and
/// more.
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

/// A numeric member as a matrix (first dimension, product of the rest); a 0-d array is 1 × 1.
Eigen::MatrixXd to_matrix(const NpyArray& array);
NpyArray from_matrix(const Eigen::MatrixXd& matrix);

}  // namespace mimicx
