/// The report of a run, made from the files in its folder, so that an interruption does not change it.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "record/manifest.h"
#include "record/run_folder.h"
#include "report/clip_report.h"

namespace mimicx::report {

/// The most clips whose motions are embedded in the page. With more clips, all have files beside it.
inline constexpr std::ptrdiff_t kMostEmbedded = 50;

/// Makes the text of `Report::map`, a map of the motions of a run among others. Row k of the report is entry
/// k of the manifest. Returns an empty text if there is no map, and may add the reason to `facts`.
using MapDrawing = std::function<std::string(const record::RunFolder&, const record::Manifest&,
                                             std::vector<std::pair<std::string, std::string>>& facts)>;

struct ReportOptions {
  std::map<std::string, TruthReader> truth = {};  ///< by the clips' names
  MapDrawing map = {};                            ///< empty: none
  bool times = false;  ///< also show wall-clock times, which differ from run to run
  bool keep = false;   ///< keep clip files that were made from the same results
};

/// Writes DIR/report.html, and DIR/report/NAME.js of more clips than `kMostEmbedded` (clip_script_file.h).
/// Sequences without output have only a row with the reason.
void write_report(const record::RunFolder& folder, const record::Manifest& manifest,
                  const ReportOptions& options = {});

}  // namespace mimicx::report
