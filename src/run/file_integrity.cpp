#include "run/file_integrity.h"

#include "core/error.h"

namespace mimicx::run {
namespace {

/// Empty where the file cannot be read.
std::string checksum_or_none(const std::filesystem::path& file) {
  try {
    return record::file_checksum(file);
  } catch (const DataError&) {
    return {};
  }
}

}  // namespace

record::FileChecksums checksums_of(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  record::FileChecksums files;
  for (const std::filesystem::path& file : folder.files_of(entry.name)) {
    if (file == folder.checkpoint(entry.name) || file == folder.substeps(entry.name) ||
        file == folder.gains(entry.name))
      continue;
    if (const std::string checksum = checksum_or_none(file); !checksum.empty())
      files.emplace_back(file.lexically_relative(folder.root).generic_string(), checksum);
  }
  return files;
}

std::vector<std::string> damaged_files(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  std::vector<std::string> damaged;
  for (const auto& [name, checksum] : entry.files)
    if (checksum_or_none(folder.root / name) != checksum) damaged.push_back(name);
  return damaged;
}

}  // namespace mimicx::run
