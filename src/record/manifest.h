/// `manifest.json`: what a run did with every input, and with which settings.
///
/// One object: {"run": settings, "sequences": [...]}. Numbers are written so that they read back as the same
/// bits; a value that does not exist (NaN) is null. Nothing in it depends on the machine's speed, the number
/// of threads or where the folder stands: times are in timing.json (timing.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/named_values.h"
#include "record/json.h"
#include "record/sequence_entry.h"

namespace mimicx::record {

struct Manifest {
  std::string version;  ///< of the program
  std::string target;   ///< arithmetic it was built for (core/build.h)
  std::uint64_t seed = 0;
  std::int64_t samples = 0;  ///< budget per sequence
  std::string method;        ///< what simulates the motions: imitate, plan, paper or auto
  NamedValues settings;      ///< every other parameter that the results depend on
  std::string options;       ///< checksums of the sets of options, joined by +; empty: from scratch
  std::string reading;       ///< what the user said of the files (ReadConfig::text)
  std::vector<SequenceEntry> sequences;

  /// In what a run differs from another, so that their results may not stand side by side: "seed is 1 here, 2
  /// there" each; empty where they may.
  /// @param but_samples  the budget apart
  std::vector<std::string> differences(const Manifest& there, bool but_samples = false) const;
  /// The entry of an input, or nullptr.
  const SequenceEntry* find(const std::string& input) const;
  /// Replaces the entry of the same input, or appends.
  void put(const SequenceEntry& entry);
  /// Puts the entries of these inputs behind all others, in the order of the inputs.
  void order(const std::vector<std::string>& inputs);
};

/// The first few of what `Manifest::differences` found, in a line.
std::string in_words(const std::vector<std::string>& differences);

/// Of all but the sequences; and back. @throws JsonError
Json run_json(const Manifest& manifest);
Manifest run_of(const Json& run);

std::string format_manifest(const Manifest& manifest);
/// @throws DataError when the file is not a manifest.
Manifest read_manifest(const std::filesystem::path& path);
/// The same from its text. @param path  for messages
Manifest parse_manifest(const std::string& text, const std::filesystem::path& path);

}  // namespace mimicx::record
