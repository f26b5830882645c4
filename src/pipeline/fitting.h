/// The numbers of the keypoint fit by name, as `mimicx config` lists them and `mimicx fit --set` takes them.
/// What each means stands beside its member in motion/fit/config.h; the name is that of the member with
/// "fit_" in front.
#pragma once

#include <string>

#include "core/named_values.h"
#include "motion/fit/config.h"

namespace mimicx::pipeline {

/// All of them but `threads`, which has no influence on the result.
NamedValues fit_settings(const motion::fit::FitConfig& config);

/// @throws std::invalid_argument for a name that is none of them, and as `assign` (setting.h)
void apply_setting(motion::fit::FitConfig& config, const std::string& name, double value);

/// @throws std::invalid_argument naming the first number out of its range
void check(const motion::fit::FitConfig& config);

}  // namespace mimicx::pipeline
