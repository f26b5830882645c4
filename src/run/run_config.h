/// The settings of a run over motions (sequence_run.h) that do not belong to its method (method.h).
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "import/motion_file.h"
#include "record/run_folder.h"
#include "record/shard.h"
#include "report/run_report.h"

namespace mimicx::run {

/// The map of the motions in a run's report, made by whoever knows the options (pipeline/cluster_map.h).
struct MotionMap {
  /// Keeps what the map is drawn from in the folder, before any work.
  std::function<void(const record::RunFolder&, std::ostream& messages)> keep = {};
  report::MapDrawing draw = {};
};

/// The settings that every run has, whatever its method.
struct RunConfig {
  std::vector<std::string> inputs;  ///< as given; recorded as such
  /// What inputs shall be called in the folder ("CMU/01/walk"); others go by their file names.
  std::map<std::string, std::string> names = {};
  std::filesystem::path out;
  import::ReadConfig read;
  bool input_rate = false;  ///< clean copies at the input's frame rate instead of 30 fps
  bool beside = false;      ///< clean copies beside their inputs, as NAME.clean.EXT, instead of in the folder
  bool force = false;       ///< overwrite files that no run made
  std::vector<std::string> protect;  ///< inputs of the same command that belong to other runs
  bool substeps = false;  ///< also write every physics step of the result; finished motions get theirs too
  bool gains = false;     ///< also write the feedback gains of plans; finished ones get theirs, too
  bool fit = false;    ///< move inputs onto their keypoints first, where they have any; without it Eq. 3 is 1
  bool as_is = false;  ///< correct nothing (Correction::kNone), whatever `fit` says
  /// The part of the inputs that is done here; with it, what the parts agree on and its own records stand in
  /// OUT/shards, all else where the whole run has it (record/shard.h). Empty: all of them.
  std::optional<record::Shard> shard = {};
  bool quiet = false;  ///< tell only what went wrong
  int threads = 1;
  MotionMap map = {};  ///< empty: the report has none
  int jobs = 1;        ///< motions done side by side, each by its share of the threads; 0: as many as threads
  double limit_seconds = 0.0;  ///< safety stop per sequence; 0: none
};

}  // namespace mimicx::run
