/// The trained options that come with the program.
#pragma once

#include <filesystem>
#include <vector>

namespace mimicx::tools {

/// The folders of the sets, in the order in which they are tried; empty where there are none.
std::vector<std::filesystem::path> shipped_sets();

/// The place of a set: a file or folder as given where that exists, else a shipped one of this name.
std::filesystem::path options_named(const std::filesystem::path& given);

/// The files of the sets' clusters; empty where one has none.
std::vector<std::filesystem::path> shipped_clusters();

}  // namespace mimicx::tools
