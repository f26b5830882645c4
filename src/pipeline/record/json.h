/// How manifests, metrics and reports are written: members in the order they were put in.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace mimicx::pipeline::record {

using Json = nlohmann::ordered_json;

/// JSON has no NaN and no infinity: null.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// A document for users: {"made_by": "mimicx", members…}, which is how outputs.h knows it again. Bytes that
/// are no UTF-8 are replaced.
inline std::string document(const Json& members) {
  Json whole = {{"made_by", "mimicx"}};
  for (const auto& [name, value] : members.items()) whole[name] = value;
  return whole.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mimicx::pipeline::record
