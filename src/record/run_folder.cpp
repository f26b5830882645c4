#include "record/run_folder.h"

#include <algorithm>
#include <system_error>

#include "core/error.h"
#include "core/number_text.h"
#include "record/outputs.h"

namespace mimicx::record {

std::vector<std::string> archive_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none))
    if (entry.path().extension() == ".npz")
      names.push_back(entry.path().lexically_relative(folder).replace_extension().generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

void RunFolder::create() const {
  for (const char* part : {"motions", "references"}) make_folder(root / part);
}

bool RunFolder::is_part_name(const std::string& name) {
  for (int k = 1; k <= kMostParts; ++k)
    if (name.ends_with(part_name("", k)) && name.size() > part_name("", k).size()) return true;
  return false;
}

bool holds_run(const std::filesystem::path& folder) {
  return is_own_file(folder / "manifest.json", "{\n \"run\"") ||
         is_own_file(folder / "shards" / "run.json", "{\n \"run\"");
}

std::string unique_name(const std::string& wanted, const std::set<std::string>& taken) {
  std::string name = wanted;
  for (int n = 2; taken.contains(name); ++n) name = wanted + "-" + std::to_string(n);
  return name;
}

void reserve_motion_name(const std::string& name, std::set<std::string>& taken) {
  taken.insert(name);
  for (int k = 1; k <= kMostParts; ++k) taken.insert(RunFolder::part_name(name, k));
}

std::string unique_motion_name(const std::string& wanted, std::set<std::string>& taken) {
  const auto is_taken = [&taken](const std::string& name) {
    bool found = taken.contains(name);
    for (int k = 1; k <= kMostParts; ++k) found = found || taken.contains(RunFolder::part_name(name, k));
    return found;
  };
  std::string name = wanted;
  for (int n = 2; is_taken(name); ++n) name = wanted + "-" + std::to_string(n);
  reserve_motion_name(name, taken);
  return name;
}

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::string checksum(std::string_view bytes) {
  return formatted("%016llx", static_cast<unsigned long long>(fnv1a(bytes)));
}

std::string file_checksum(const std::filesystem::path& path) { return checksum(read_file(path)); }

std::string checksum_or_none(const std::filesystem::path& path) {
  try {
    return file_checksum(path);
  } catch (const DataError&) {
    return {};
  }
}

}  // namespace mimicx::record
