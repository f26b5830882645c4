/// What a run leaves.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/file.h"

namespace mimicx::run {

/// Bytes of every file of a run but its times, by relative path.
inline std::map<std::string, std::string> results_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder))
    if (file.is_regular_file() && file.path().filename() != "timing.json")
      files[std::filesystem::relative(file.path(), folder).string()] = read_file(file.path());
  return files;
}

}  // namespace mimicx::run
