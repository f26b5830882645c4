#include "pipeline/record/run_folder.h"

#include <cstdint>
#include <cstdio>
#include <system_error>

#include "core/error.h"
#include "pipeline/record/outputs.h"

namespace mimicx::pipeline::record {

void RunFolder::create() const {
  for (const char* part : {"motions", "references"}) make_folder(root / part);
}

bool holds_run(const std::filesystem::path& folder) {
  return is_own_file(folder / "manifest.json", "{\n \"run\"");
}

std::string unique_name(const std::string& wanted, const std::set<std::string>& taken) {
  std::string name = wanted;
  for (int n = 2; taken.contains(name); ++n) name = wanted + "-" + std::to_string(n);
  return name;
}

std::string file_checksum(const std::filesystem::path& path) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (char c : read_file(path)) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace mimicx::pipeline::record
