/// The trained options that come with the program.
#pragma once

#include <filesystem>
#include <vector>

namespace mimicx::tools {

/// The folders of the sets, in the order in which they are tried; empty if there are none.
std::vector<std::filesystem::path> shipped_sets();

/// The path of a set: the given file or folder if it exists, else the shipped set of this name.
std::filesystem::path options_named(const std::filesystem::path& given);

/// The files of the sets' clusters; empty if one is missing.
std::vector<std::filesystem::path> shipped_clusters();

}  // namespace mimicx::tools
