/// `journal.jsonl`: the motions that a run finished since it wrote its manifest, one per line.
///
/// The manifest of 10,000 motions is 60 MB; writing it after every motion would take longer than the motions.
/// A run therefore appends to the journal; at its end it writes the manifest and removes the journal. After a
/// process was killed, the same command reads the journal. An incomplete last line is ignored.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "record/manifest.h"
#include "record/timing.h"

namespace mimicx::record {

class Journal {
 public:
  /// The first `append` truncates the file.
  explicit Journal(const std::filesystem::path& path) : path_(path) {}

  /// @throws DataError if it cannot be written
  void append(const SequenceEntry& entry, const Timing& timing);
  /// Removes the file: the manifest has everything.
  void clear();

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

/// Merges the entries and times of a journal into the older ones. A missing file has no entries.
void replay_journal(const std::filesystem::path& path, Manifest& manifest, std::vector<Timing>& timings);
/// The same from its text. @param path  for messages @throws DataError for a complete line that is no entry
void replay_lines(const std::string& text, const std::filesystem::path& path, Manifest& manifest,
                  std::vector<Timing>& timings);

}  // namespace mimicx::record
