/// A policy as a C++17 header that needs nothing else: data, runtime.h, and what a user calls.
#pragma once

#include <string>
#include <string_view>

#include "policy_export/exported_policy.h"

namespace mimicx::policy_export {

/// How such a header begins.
inline constexpr std::string_view kHeaderOpening = "// A policy by mimicx export-policy";

/// The header. Its namespace is policy_ and the name, with _ for what no C++ name can have.
std::string to_header(const ExportedPolicy& exported);

/// policy_ and the name of a motion as a name of C++.
std::string namespace_of(const std::string& name);

}  // namespace mimicx::policy_export
