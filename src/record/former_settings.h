/// Settings that manifests of earlier versions list and that are constants today, and former names.
#pragma once

#include <string>

#include "record/json.h"

namespace mimicx::record {

/// Whether `name` is such a setting and has the value of today's constant: a run that lists it so and one
/// that does not list it may stand side by side.
bool is_former_default(const std::string& name, double value);

/// A member of a manifest's settings, null if it is missing. Those of earlier versions lack `as_is` and
/// `keypoints`: nothing was left as it is, and the reward saw keypoints where the fit did.
Json former_member(const Json& settings, const std::string& name);

/// Today's name of a method in a manifest: earlier versions called `options` `paper`.
std::string current_method(const std::string& name);

}  // namespace mimicx::record
