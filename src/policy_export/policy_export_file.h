/// The files of `mimicx export-policy`: the suffix chooses the format.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "policy_export/exported_policy.h"

namespace mimicx::policy_export {

/// First bytes of a file with that suffix, for record::Outputs; empty for an archive.
/// @throws std::invalid_argument for a suffix other than .h, .onnx or .npz
std::string_view opening_of(const std::filesystem::path& path);

/// The bytes of the file. @throws std::invalid_argument as `opening_of`, and for several policies in a file
/// other than .h
std::string bytes_of(const std::vector<ExportedPolicy>& exported, const std::filesystem::path& path);

}  // namespace mimicx::policy_export
