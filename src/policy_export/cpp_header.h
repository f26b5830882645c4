/// A policy as a self-contained C++17 header: its data, runtime.h, and the functions for users.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "policy_export/exported_policy.h"

namespace mimicx::policy_export {

/// First bytes of such a header.
inline constexpr std::string_view kHeaderOpening = "// A policy by mimicx export-policy";

/// The text of the header. Its namespace is `namespace_of` the motion's name.
std::string to_header(const ExportedPolicy& exported);
/// Several policies: the namespace `policies` has the runtime, whose State and Targets they share, and in it
/// each policy's own namespace. @throws std::invalid_argument for two of one namespace
std::string to_header(const std::vector<ExportedPolicy>& exported);

/// "policy_" and the name of a motion, in which '_' replaces all characters that C++ names cannot have.
std::string namespace_of(const std::string& name);

}  // namespace mimicx::policy_export
