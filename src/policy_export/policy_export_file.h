/// The files of `mimicx export-policy`: which kind an ending means, and what is written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "policy_export/exported_policy.h"

namespace mimicx::policy_export {

/// How a file of that ending begins, for record::Outputs; empty of an archive.
/// @throws std::invalid_argument for an ending that is none of .h, .onnx, .npz
std::string_view opening_of(const std::filesystem::path& path);

/// The bytes of a file, by its ending. @throws std::invalid_argument as above
std::string bytes_of(const ExportedPolicy& exported, const std::filesystem::path& path);

}  // namespace mimicx::policy_export
