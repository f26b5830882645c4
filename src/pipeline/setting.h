/// One setting: a field of a configuration as the number that manifests and `--set` know.
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace mimicx::pipeline {

/// The number of a field: an integer, a floating-point number, a bool or an enumerator.
template <class T>
double number_of(T field) {
  return static_cast<double>(field);
}

/// @throws std::invalid_argument for a fraction where a whole number is expected, and beyond ± 1e9
template <class T>
void assign(T& field, double value) {
  if (!(std::abs(value) <= 1e9)) throw std::invalid_argument("at most 1e9 expected");
  const T whole = static_cast<T>(value);
  if (number_of(whole) != value) throw std::invalid_argument("a fraction where a whole number is expected");
  field = whole;
}

/// @throws std::invalid_argument naming the setting, where it is no number of that range
inline void require_range(const std::string& name, double value, double least, double most) {
  if (value >= least && value <= most) return;
  char text[120];
  std::snprintf(text, sizeof text, "%s: expected %g to %g, found %g", name.c_str(), least, most, value);
  throw std::invalid_argument(text);
}

}  // namespace mimicx::pipeline
