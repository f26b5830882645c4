/// `journal.jsonl`: what a run did since its manifest was written, a line per motion.
///
/// The manifest of 10,000 motions is 60 MB; writing all of it after every motion would cost more than the
/// motions. While a run goes on it appends; at its end the manifest has everything, and the journal is gone.
/// A process that was killed leaves it, and the same command takes it up: a last line that was cut off is not
/// believed.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "record/manifest.h"
#include "record/timing.h"

namespace mimicx::record {

class Journal {
 public:
  /// Of a file that the first `append` begins anew.
  explicit Journal(const std::filesystem::path& path) : path_(path) {}

  /// @throws DataError where it cannot be written
  void append(const SequenceEntry& entry, const Timing& timing);
  /// The manifest has it all: removes the file.
  void clear();

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

/// Puts the entries and times of a journal into those that were written before it. No file, no entries.
void replay_journal(const std::filesystem::path& path, Manifest& manifest, std::vector<Timing>& timings);
/// The same from its text. @param path  for messages @throws DataError for a whole line that is no entry
void replay_lines(const std::string& text, const std::filesystem::path& path, Manifest& manifest,
                  std::vector<Timing>& timings);

}  // namespace mimicx::record
