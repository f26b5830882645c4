/// The numbers of the keypoint fit by name, as `mimicx config` lists them and `mimicx fit --set` takes them.
/// What each means stands beside its member in fit/fit_config.h; the name is that of the member with
/// "fit_" in front.
#pragma once

#include <string>

#include "core/named_values.h"
#include "fit/fit_config.h"

namespace mimicx::fit {

/// All of them but `threads`, which has no influence on the result.
NamedValues fit_settings(const FitConfig& config);

/// @throws std::invalid_argument for a name that is none of them, and as `assign` (setting.h)
void apply_setting(FitConfig& config, const std::string& name, double value);

/// @throws std::invalid_argument naming the first number out of its range
void check(const FitConfig& config);

}  // namespace mimicx::fit
