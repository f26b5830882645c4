/// How manifests, metrics and reports are written: members in the order they were put in.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace mimicx::pipeline::record {

using Json = nlohmann::ordered_json;

/// JSON has no NaN and no infinity: null.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace mimicx::pipeline::record
