/// The trained options that come with the program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mimicx::tools {

/// data/options of the source tree that holds this program, or of the folder it was started in.
std::optional<std::filesystem::path> shipped_options();

/// The folders of their sets, in the order in which they are tried; empty where there are none.
std::vector<std::filesystem::path> shipped_sets();

/// The place of a set: a file or folder as given where that exists, else a shipped one of this name.
std::filesystem::path options_named(const std::filesystem::path& given);

/// The files of the sets' clusters; empty where one has none.
std::vector<std::filesystem::path> shipped_clusters();

}  // namespace mimicx::tools
