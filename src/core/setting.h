/// Settings: the fields of a configuration as named numbers, as in manifests and `--set`.
///
/// A configuration has one function beside it that names its settings, each with its field, the least and the
/// most that it may be, and its meaning in a few words with the unit:
///
///     void visit_settings(PpoConfig& ppo, const auto& visit) {
///       visit("gamma", ppo.gamma, 0, 1, "discount per step");
///     }
///
/// It may hand `visit` on to the visitors of its parts. The functions below do the rest.
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

/// For the settings of a part: the same visit, with `prefix` before every name.
auto with_prefix(const char* prefix, const auto& visit) {
  return [prefix, &visit](const std::string& name, auto& field, double least, double most,
                          const char* meaning) { visit(prefix + name, field, least, most, meaning); };
}

/// All settings by name, in the order of the visit.
template <class Config>
NamedValues settings_of(Config config) {  // a copy: visitors take fields that may be changed
  NamedValues values;
  visit_settings(config, [&](const std::string& name, const auto& field, double, double, const char*) {
    values.emplace_back(name, setting_number(field));
  });
  return values;
}

/// {name, meaning} of all settings, in the order of the visit.
template <class Config>
std::vector<std::pair<std::string, std::string>> meanings_of(Config config) {
  std::vector<std::pair<std::string, std::string>> meanings;
  visit_settings(config, [&](const std::string& name, const auto&, double, double, const char* meaning) {
    meanings.emplace_back(name, meaning);
  });
  return meanings;
}

/// Changes one setting; its range is not looked at (`require_ranges`).
/// @throws std::invalid_argument for an unknown name, and as `assign_setting`
template <class Config>
void apply_setting(Config& config, const std::string& name, double value) {
  bool found = false;
  visit_settings(config, [&](const std::string& known, auto& field, double, double, const char*) {
    if (known != name) return;
    assign_setting(field, value);
    found = true;
  });
  if (!found) throw std::invalid_argument("unknown setting '" + name + "': `mimicx config` lists them all");
}

/// @throws std::invalid_argument naming the first setting that is out of its range
template <class Config>
void require_ranges(Config config) {
  visit_settings(config, [](const std::string& name, const auto& field, double least, double most,
                            const char*) { require_range(name, setting_number(field), least, most); });
}

}  // namespace mimicx
