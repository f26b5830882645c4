/// What holds for the settings of every configuration.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "core/setting.h"

namespace mimicx {

/// The message with which `work` throws std::invalid_argument; empty where it does not.
template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// Every setting has a name of its own, a meaning, and a range that its default is in; both ends of the range
/// can be set, change that setting and no other, and what is beyond them is refused.
template <class Config>
void check_settings(const Config& original) {
  const NamedValues defaults = settings_of(original);
  EXPECT_NO_THROW(require_ranges(original));
  std::set<std::string> names;
  std::size_t at = 0;
  Config visited = original;
  visit_settings(visited,
                 [&](const std::string& name, auto&, double least, double most, const char* meaning) {
                   EXPECT_TRUE(names.insert(name).second) << name << " is there twice";
                   EXPECT_STRNE(meaning, "") << name;
                   EXPECT_LT(least, most) << name;
                   for (const double end : {least, most}) {
                     Config config = original;
                     apply_setting(config, name, end);
                     EXPECT_NO_THROW(require_ranges(config)) << name << ' ' << end;
                     NamedValues expected = defaults;
                     expected.at(at).second = end;
                     EXPECT_EQ(settings_of(config), expected) << name;
                   }
                   for (const double beyond : {least - 1.0, most + 1.0}) {
                     Config config = original;
                     const std::string refusal = refusal_of([&] {
                       apply_setting(config, name, beyond);
                       require_ranges(config);
                     });
                     // A flag cannot hold it, and no field a number beyond 1e9: these are refused before the
                     // range is read.
                     EXPECT_FALSE(refusal.empty()) << name << ' ' << beyond;
                   }
                   ++at;
                 });
  EXPECT_EQ(names.size(), defaults.size());
  Config config = original;
  EXPECT_NE(refusal_of([&] { apply_setting(config, "no_such_setting", 1.0); }).find("'no_such_setting'"),
            std::string::npos);
}

}  // namespace mimicx
