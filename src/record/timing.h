/// `timing.json`: how long every motion took. Wall-clock times differ from run to run, so they are kept out
/// of the files that are deterministic.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "record/sequence_entry.h"

namespace mimicx::record {

/// Wall-clock record of one sequence, summed over interruptions.
struct Timing {
  std::string name;
  double seconds = 0.0;           ///< of all work on it
  double planning_seconds = 0.0;  ///< of planning
  double training_seconds = 0.0;  ///< of training
  int threads = 0;
};

Json to_json(const Timing& timing);
/// @throws JsonError
Timing timing_of(const Json& json);

std::string format_timing(const std::vector<Timing>& timings, const std::vector<SequenceEntry>& sequences);
/// Empty when the file is missing or unreadable: times are a convenience.
std::vector<Timing> read_timing(const std::filesystem::path& path);
std::vector<Timing> parse_timing(const std::string& text);

}  // namespace mimicx::record
