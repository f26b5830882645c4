#include "fit/fit_settings.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mimicx::fit {
namespace {

TEST(FitSettings, EveryOneCanBeChangedByItsNameAndChangesNoOther) {
  const NamedValues defaults = fit_settings({});
  for (const auto& [name, value] : defaults) {
    const double other = name == "fit_find_levels" ? 1.0 - value : value + 1.0;
    FitConfig config;
    apply_setting(config, name, other);
    const NamedValues changed = fit_settings(config);
    for (std::size_t k = 0; k < defaults.size(); ++k)
      EXPECT_EQ(changed[k].second, defaults[k].first == name ? other : defaults[k].second) << name;
  }
}

TEST(FitSettings, NoMemberIsForgotten) {
  // Two integers and a flag with what fills them up to eight bytes each time; the rest are doubles.
  const std::size_t doubles = (sizeof(FitConfig) - 2 * sizeof(double)) / sizeof(double);
  EXPECT_EQ(fit_settings({}).size(), doubles + 2);  // fit_iterations and fit_find_levels; not the threads
}

TEST(FitSettings, WhatNoFitCanHaveIsRefusedByName) {
  EXPECT_NO_THROW(check(FitConfig{}));
  for (const char* name : {"fit_iterations", "fit_keypoint_sigma", "fit_prior_frames", "fit_slip_sigma"}) {
    FitConfig config;
    apply_setting(config, name, 0.0);
    EXPECT_THROW(check(config), std::invalid_argument) << name;
  }
  FitConfig config;
  EXPECT_THROW(apply_setting(config, "iterations", 1.0), std::invalid_argument);
  EXPECT_THROW(apply_setting(config, "fit_iterations", 1.5), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::fit
