/// Numbers by name, in insertion order: settings, metrics, reports of single steps.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace mimicx {

using NamedValues = std::vector<std::pair<std::string, double>>;

/// The first value of that name; NaN, which fails every comparison with a limit, if there is none.
inline double value_of(const NamedValues& values, const std::string& name) {
  for (const auto& [key, value] : values)
    if (key == name) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

inline void append(NamedValues& values, const NamedValues& more) {
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace mimicx
