#include "motion/npz_member.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace mimicx::motion {

std::string text_of_shape(const std::vector<std::size_t>& shape) {
  std::string text;
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i ? ", " : "") + std::to_string(shape[i]);
  return "shape (" + text + ")";
}

Member::Member(const Npz& archive, const std::string& name)
    : npz(archive), key(name), array(archive.at(name)) {
  if (array.type == NpyArray::Type::kText) fail("numbers", "text");
  values = array.to_double();
}

void Member::fail(const std::string& expected, const std::string& found) const {
  throw DataError(npz.path, key, expected, found);
}

void Member::expect_shape(const std::vector<std::size_t>& expected) const {
  if (array.shape != expected) fail(text_of_shape(expected), shape());
}

std::size_t Member::columns() const {
  std::size_t product = 1;
  for (std::size_t i = 1; i < array.shape.size(); ++i) product *= array.shape[i];
  return array.shape.size() < 2 ? 0 : product;
}

void Member::expect_finite_columns(std::size_t used) const {
  for (std::size_t r = 0; r < rows(); ++r)
    for (std::size_t c = 0; c < used; ++c)
      if (!std::isfinite(values[r * columns() + c])) fail_not_finite(r);
}

void Member::expect_finite() const {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) fail_not_finite(i / (values.size() / std::max<std::size_t>(rows(), 1)));
}

void Member::fail_not_finite(std::size_t row) const {
  fail("finite numbers", "one that is not, in row " + std::to_string(row));
}

}  // namespace mimicx::motion
