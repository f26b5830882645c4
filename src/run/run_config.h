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
#include "run/preparation.h"

namespace mimicx::run {

/// The map of the motions in a run's report. Methods with options provide it (pipeline/cluster_map.h).
struct MotionMap {
  /// Copies the map's data into the folder, before any work.
  std::function<void(const record::RunFolder&, std::ostream& messages)> keep = {};
  report::MapDrawing draw = {};
};

/// The settings that every run has, for any method.
struct RunConfig {
  std::vector<std::string> inputs;  ///< as given, and recorded so
  /// Names of inputs in the folder ("CMU/01/walk"); other inputs have their file names.
  std::map<std::string, std::string> names = {};
  std::filesystem::path out;
  import::ReadConfig read;
  bool input_rate = false;  ///< clean copies at the input's frame rate instead of 30 fps
  bool beside = false;      ///< clean copies beside their inputs, as NAME.clean.EXT, instead of in the folder
  bool force = false;       ///< overwrite files of other programs
  std::vector<std::string> protect;  ///< inputs of the same command that belong to other runs
  /// Also write every physics step of the result; also of finished motions. Those of an earlier command stay.
  bool substeps = false;
  bool gains = false;  ///< the same of the feedback gains of plans
  CorrectionConfig correction;
  /// The shard of the inputs that is done here; empty: all inputs. A shard's records, and the list that all
  /// shards agree on, are in OUT/shards; all else is where the whole run has it (record/shard.h).
  std::optional<record::Shard> shard = {};
  bool quiet = false;  ///< print only failures
  int threads = 1;
  MotionMap map = {};  ///< empty: the report has none
  int jobs = 1;        ///< motions in parallel, each with its share of the threads; 0: as many as threads
  double limit_seconds = 0.0;  ///< safety stop per sequence; 0: none
};

}  // namespace mimicx::run
