/// The trained options that come with the program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mimicx::tools {

/// data/options of the source tree that holds this program, or of the folder it was started in.
std::optional<std::filesystem::path> shipped_options();

/// Their sets by name, in the order in which they are tried; empty where there are none.
std::vector<std::string> shipped_sets();

/// The place of a set: a file or folder as given, or the name of a shipped one.
std::filesystem::path options_named(const std::filesystem::path& given);

/// The file of their clusters; empty where there is none.
std::filesystem::path shipped_clusters();

}  // namespace mimicx::tools
