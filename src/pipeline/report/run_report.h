/// The report of a run. It is made from the files in the folder, so an interruption does not change it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "pipeline/record/manifest.h"
#include "pipeline/record/run_folder.h"

namespace mimicx::pipeline::report {

/// Clips whose motions one file holds. Of more, all have theirs in files beside it.
inline constexpr std::ptrdiff_t kMostEmbedded = 50;

struct ReportOptions {
  std::map<std::string, std::filesystem::path> truth = {};  ///< files of the truth, by the clips' names
  /// Of the options, for the map; empty: DIR/clusters.json, where that is.
  std::vector<std::filesystem::path> clusters = {};
  bool times = false;  ///< also say how long it took: wall-clock times, which no two runs have in common
  bool keep = false;   ///< leave the files beside the page that were made of the results as they are now
};

/// Writes DIR/report.html, and DIR/report/NAME.js of more clips than `kMostEmbedded` (clip_beside.h).
/// Sequences without output appear with their reason alone.
void write_report(const record::RunFolder& folder, const record::Manifest& manifest,
                  const ReportOptions& options = {});

}  // namespace mimicx::pipeline::report
