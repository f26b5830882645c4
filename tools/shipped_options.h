/// The trained options that come with the program.
#pragma once

#include <filesystem>
#include <optional>

namespace mimicx::tools {

/// data/options of the source tree that holds this program, or of the folder it was started in.
std::optional<std::filesystem::path> shipped_options();

/// The file of their clusters; empty where there is none.
std::filesystem::path shipped_clusters();

}  // namespace mimicx::tools
