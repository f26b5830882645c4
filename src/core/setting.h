/// Settings: the fields of a configuration as named numbers, as in manifests and `--set`.
///
/// A configuration has one function that visits its fields: it calls add(name, field) or
/// add(name, field, least, most) for each. Listing, changing and checking settings use that function.
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "core/named_values.h"

namespace mimicx {

/// The number of a field: an integer, a floating-point number, a bool or an enumerator.
template <class T>
double setting_number(T field) {
  return static_cast<double>(field);
}

/// @throws std::invalid_argument for a fraction in an integer field, and beyond ± 1e9
template <class T>
void assign_setting(T& field, double value) {
  if (!(std::abs(value) <= 1e9)) throw std::invalid_argument("at most 1e9 expected");
  const T whole = static_cast<T>(value);
  if (setting_number(whole) != value)
    throw std::invalid_argument("a fraction where a whole number is expected");
  field = whole;
}

/// @throws std::invalid_argument naming the setting, unless the value is in that range
inline void require_range(const std::string& name, double value, double least, double most) {
  if (value >= least && value <= most) return;
  char text[120];
  std::snprintf(text, sizeof text, "%s: expected %g to %g, found %g", name.c_str(), least, most, value);
  throw std::invalid_argument(text);
}

/// All numbers by name. @param visit  visit(add)
template <class Visit>
NamedValues numbers_in(const Visit& visit) {
  NamedValues values;
  visit([&](const std::string& name, const auto& field, auto...) {
    values.emplace_back(name, setting_number(field));
  });
  return values;
}

/// Changes the number of that name. @return whether there is one
/// @throws std::invalid_argument as `assign_setting`
template <class Visit>
bool change_one(const Visit& visit, const std::string& name, double value) {
  bool found = false;
  visit([&](const std::string& known, auto& field, auto...) {
    if (known != name) return;
    assign_setting(field, value);
    found = true;
  });
  return found;
}

/// @throws std::invalid_argument naming the first number outside its range
template <class Visit>
void require_ranges(const Visit& visit) {
  visit([](const std::string& name, const auto& field, double least, double most) {
    require_range(name, setting_number(field), least, most);
  });
}

}  // namespace mimicx
