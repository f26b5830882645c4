/// Settings that manifests of earlier versions list and that are constants today.
#pragma once

#include <string>

namespace mimicx::record {

/// Whether `name` is such a setting and has the value of today's constant: a run that lists it so and one
/// that does not list it may stand side by side.
bool is_former_default(const std::string& name, double value);

}  // namespace mimicx::record
