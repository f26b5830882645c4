/// What a run knows while it goes on, and how that comes out of its folder and into it again.
///
/// The folder is that of a whole run, or of one of its parts: then the records are the part's own, and the
/// inputs and their names are picked from those of the whole (record/shard_list.h).
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

/// What the parts of a run must agree on; empty where the run is whole.
/// @throws std::invalid_argument when an input is given twice
std::optional<record::ShardList> shard_list_of(const RunConfig& config, const Method& method);

/// Before anything is written: a folder of a whole run takes no parts, one of parts no whole run before they
/// are merged, and parts are those of one run.
/// @throws std::invalid_argument saying what the folder holds
void check_folder(const RunConfig& config, const std::optional<record::ShardList>& list);

/// While it lives, no other process writes to the same records. Parts work beside each other; a whole run,
/// and the merging of parts, is alone.
class RunLocks {
 public:
  /// @throws OutputRefused where another process is at work
  explicit RunLocks(const record::RunFolder& folder);

 private:
  std::vector<std::unique_ptr<record::FolderLock>> locks_;
};

/// The run as its folder knows it, or a new one.
/// @throws std::invalid_argument where the folder holds a run of other settings
RunState open_run(const RunConfig& config, const Method& method, const record::RunContext& context,
                  const record::RunFolder& folder, const std::optional<record::ShardList>& list);

/// Everything that is known, in manifest and times instead of the journal, in the inputs' order, whichever
/// was done first.
void write_records(RunState& run);

/// The times of a sequence, new ones where there are none.
record::Timing& timing_of(RunState& run, const std::string& name);

}  // namespace mimicx::run
