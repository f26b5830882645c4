/// `manifest.json`: the settings of a run, and its result for every input.
///
/// One object: {"run": settings, "commit": of the program that wrote it, "sequences": [...]}. Numbers are
/// written so that they read back as the same bits; a missing value (NaN) is null. Nothing in it depends on
/// the machine's speed, the number of threads or the folder's location; times are in timing.json (timing.h).
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
  std::string target;   ///< arithmetic it was built for (core/bits.h)
  std::uint64_t seed = 0;
  std::int64_t samples = 0;  ///< budget per sequence
  std::string method;        ///< how the motions are simulated: imitate, plan, options, printed or auto
  NamedValues settings;      ///< every other parameter that the results depend on
  std::string options;       ///< checksums of the sets of options, joined by +; empty: from scratch
  std::string reading;       ///< how the user asked to read the files (ReadConfig::text)
  std::vector<SequenceEntry> sequences;

  /// The settings in which a run differs from another, each as "seed is 2 there, 1 here". Empty: their
  /// results may be in one folder.
  /// @param but_samples  ignore the budget
  std::vector<std::string> differences(const Manifest& there, bool but_samples = false) const;
  /// The entry of an input, or nullptr.
  const SequenceEntry* find(const std::string& input) const;
  /// Replaces the entry of the same input, or appends.
  void put(const SequenceEntry& entry);
  /// Moves the entries of these inputs to the end, in the order of the inputs.
  void order(const std::vector<std::string>& inputs);
};

/// The first few differences of `Manifest::differences`, in a line.
std::string in_words(const std::vector<std::string>& differences);

/// Everything but the sequences, to JSON and back. @throws JsonError
Json run_json(const Manifest& manifest);
Manifest run_of(const Json& run);

std::string format_manifest(const Manifest& manifest);
/// @throws DataError when the file is not a manifest.
Manifest read_manifest(const std::filesystem::path& path);
/// The same from its text. @param path  for messages
Manifest parse_manifest(const std::string& text, const std::filesystem::path& path);

}  // namespace mimicx::record
