#include "core/named_values.h"

#include <limits>

namespace mimicx {

double value_of(const NamedValues& values, const std::string& name) {
  for (const auto& [key, value] : values)
    if (key == name) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

void append(NamedValues& values, const NamedValues& more) {
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace mimicx
