/// The report of a run. It is made from the files in the folder, so an interruption does not change it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "record/manifest.h"
#include "record/run_folder.h"

namespace mimicx::report {

/// Clips whose motions one file holds. Of more, all have theirs in files beside it.
inline constexpr std::ptrdiff_t kMostEmbedded = 50;

/// Draws where the motions of a run are among others: the text of `Report::map`. Row k of the report is entry
/// k of the manifest. Empty where there is no map; `facts` are those of the run, where the reason may be
/// said.
using MapDrawing = std::function<std::string(const record::RunFolder&, const record::Manifest&,
                                             std::vector<std::pair<std::string, std::string>>& facts)>;

struct ReportOptions {
  std::map<std::string, std::filesystem::path> truth = {};  ///< files of the truth, by the clips' names
  MapDrawing map = {};                                      ///< empty: none
  bool times = false;  ///< also say how long it took: wall-clock times, which no two runs have in common
  bool keep = false;   ///< leave the files beside the page that were made of the results as they are now
};

/// Writes DIR/report.html, and DIR/report/NAME.js of more clips than `kMostEmbedded` (clip_script_file.h).
/// Sequences without output appear with their reason alone.
void write_report(const record::RunFolder& folder, const record::Manifest& manifest,
                  const ReportOptions& options = {});

}  // namespace mimicx::report
