#include "pipeline/record/run_folder.h"

#include <cstdint>
#include <cstdio>
#include <system_error>

#include "core/error.h"

namespace mimicx::pipeline::record {

void RunFolder::create() const {
  for (const char* part : {"motions", "references"}) {
    std::error_code error;
    std::filesystem::create_directories(root / part, error);
    if (error) throw DataError((root / part).string(), "", "a folder that can be made", error.message());
  }
}

std::string unique_name(const std::filesystem::path& input, const std::set<std::string>& taken) {
  const std::string stem = input.stem().string();
  std::string name = stem;
  for (int n = 2; taken.contains(name); ++n) name = stem + "-" + std::to_string(n);
  return name;
}

std::vector<std::string> unique_names(const std::vector<std::string>& inputs) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& input : inputs) {
    names.push_back(unique_name(input, taken));
    taken.insert(names.back());
  }
  return names;
}

std::string file_checksum(const std::filesystem::path& path) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (char c : read_file(path)) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace mimicx::pipeline::record
