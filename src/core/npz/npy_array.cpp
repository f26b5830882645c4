#include "core/npz/npy_array.h"

#include <cstring>
#include <stdexcept>
#include <utility>

#include "core/error.h"

namespace mimicx {
namespace {

using Type = NpyArray::Type;

template <class T>
NpyArray from_values(Type type, std::vector<std::size_t> shape, const T* values) {
  NpyArray array;
  array.type = type;
  array.shape = std::move(shape);
  array.bytes.resize(array.size() * sizeof(T));
  if (!array.bytes.empty()) std::memcpy(array.bytes.data(), values, array.bytes.size());
  return array;
}

template <class T>
std::vector<double> widened(const NpyArray& array) {
  std::vector<double> out(array.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    T value;
    std::memcpy(&value, array.bytes.data() + i * sizeof(T), sizeof(T));
    out[i] = static_cast<double>(value);
  }
  return out;
}

}  // namespace

std::size_t NpyArray::size() const {
  std::size_t n = 1;
  for (const std::size_t d : shape) n *= d;
  return n;
}

std::vector<double> NpyArray::to_double() const {
  switch (type) {
    case Type::kFloat32:
      return widened<float>(*this);
    case Type::kFloat64:
      return widened<double>(*this);
    case Type::kInt32:
      return widened<std::int32_t>(*this);
    case Type::kInt64:
      return widened<std::int64_t>(*this);
    case Type::kUInt8:
    case Type::kBool:
      return widened<std::uint8_t>(*this);
    case Type::kText:
      break;
  }
  raise(std::invalid_argument("NpyArray::to_double: the array holds text"));
}

NpyArray NpyArray::from_double(std::vector<std::size_t> shape, const double* values) {
  return from_values(Type::kFloat64, std::move(shape), values);
}
NpyArray NpyArray::from_float(std::vector<std::size_t> shape, const float* values) {
  return from_values(Type::kFloat32, std::move(shape), values);
}
NpyArray NpyArray::from_int64(std::vector<std::size_t> shape, const std::int64_t* values) {
  return from_values(Type::kInt64, std::move(shape), values);
}
NpyArray NpyArray::from_int32(std::vector<std::size_t> shape, const std::int32_t* values) {
  return from_values(Type::kInt32, std::move(shape), values);
}
NpyArray NpyArray::from_text(std::vector<std::string> values) {
  NpyArray array;
  array.type = Type::kText;
  array.shape = {values.size()};
  array.text = std::move(values);
  return array;
}
NpyArray NpyArray::scalar(double value) { return from_double({}, &value); }
NpyArray NpyArray::scalar_int(std::int64_t value) { return from_int64({}, &value); }
NpyArray NpyArray::scalar_text(std::string value) {
  NpyArray array = from_text({std::move(value)});
  array.shape.clear();
  return array;
}

Eigen::MatrixXd to_matrix(const NpyArray& array) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::vector<double> values = array.to_double();
  std::size_t columns = 1;
  for (std::size_t d = 1; d < array.shape.size(); ++d) columns *= array.shape[d];
  const std::size_t rows = array.shape.empty() ? 1 : array.shape[0];
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(rows),
                                    static_cast<Eigen::Index>(columns));
}

NpyArray from_matrix(const Eigen::MatrixXd& matrix) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> row_major = matrix;
  return NpyArray::from_double(
      {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())}, row_major.data());
}

}  // namespace mimicx
