#include "run/file_integrity.h"

namespace mimicx::run {

record::FileChecksums checksums_of(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  record::FileChecksums files;
  for (const std::filesystem::path& file : folder.files_of(entry.name)) {
    if (file == folder.checkpoint(entry.name) || file == folder.substeps(entry.name) ||
        file == folder.gains(entry.name))
      continue;
    if (const std::string checksum = record::checksum_or_none(file); !checksum.empty())
      files.emplace_back(file.lexically_relative(folder.root).generic_string(), checksum);
  }
  return files;
}

std::vector<std::string> damaged_files(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  std::vector<std::string> damaged;
  for (const auto& [name, checksum] : entry.files)
    if (record::checksum_or_none(folder.root / name) != checksum) damaged.push_back(name);
  return damaged;
}

}  // namespace mimicx::run
