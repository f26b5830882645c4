/// The state of a running run, and its storage in the folder.
///
/// The folder is that of a whole run or of one of its shards. A shard has its own records, and picks its
/// inputs and their names from those of the whole (record/shard_list.h).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/folder_lock.h"
#include "record/journal.h"
#include "record/manifest.h"
#include "record/shard_list.h"
#include "record/timing.h"
#include "run/method.h"
#include "run/run_config.h"

namespace mimicx::run {

struct RunState {
  const RunConfig& config;
  const Method& method;
  const record::RunContext& context;
  record::RunFolder folder;
  record::Manifest manifest;
  std::vector<record::Timing> timings;
  std::vector<std::string> inputs = {};           ///< as the manifest spells them
  std::map<std::string, std::string> names = {};  ///< of the inputs, in the folder
  std::size_t in_all = 0;                         ///< inputs of the whole run
  record::Journal journal{folder.journal()};
};

/// What the shards of a run must agree on; empty for a whole run.
/// @throws std::invalid_argument when an input is given twice
std::optional<record::ShardList> shard_list_of(const RunConfig& config, const Method& method);

/// Checks the folder before anything is written: a whole run cannot become shards, shards must be merged
/// before a whole run, and all shards must be those of one run.
/// @throws std::invalid_argument naming what the folder holds
void check_folder(const RunConfig& config, const std::optional<record::ShardList>& list);

/// While it lives, no other process writes to the same records. Shards may run at the same time; a whole run,
/// and merging, exclude all others.
class RunLocks {
 public:
  /// @throws OutputRefused if another process is running
  explicit RunLocks(const record::RunFolder& folder);

 private:
  std::vector<std::unique_ptr<record::FolderLock>> locks_;
};

/// The run stored in the folder, or a new one.
/// @throws std::invalid_argument if the folder holds a run of other settings
RunState open_run(const RunConfig& config, const Method& method, const record::RunContext& context,
                  const record::RunFolder& folder, const std::optional<record::ShardList>& list);

/// Writes manifest and times in the order of the inputs, and clears the journal.
void write_records(RunState& run);

/// The times of a sequence; adds them if there are none.
record::Timing& timing_of(RunState& run, const std::string& name);

}  // namespace mimicx::run
