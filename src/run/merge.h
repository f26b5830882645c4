/// `mimicx merge`: one run of the parts that several machines did.
///
/// The parts have left every motion where the whole run has it, and records of their own (record/shard.h).
/// Manifest, times and report are made of these: the same bytes as those of the run on one machine, the times
/// apart, whatever the number of parts. Nothing is written while anything is missing.
///
/// What it does not do: it reads no motion but those that the report shows, so a file that was damaged since
/// is found by the command of the run, not here.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "record/manifest.h"
#include "record/shard_list.h"
#include "record/timing.h"
#include "run/run_state.h"

namespace mimicx::run {

struct MissingInput {
  int shard = 0;
  record::ListedInput input;
};

/// What the parts of a run have done so far.
struct GatheredShards {
  record::ShardList list;
  record::Manifest manifest;  ///< everything that is done, in the order of the inputs
  std::vector<record::Timing> timings;
  std::vector<MissingInput> missing;  ///< neither done nor recorded as failed, or its motion is gone
};

/// Keeps all parts from working while it lives. @param out  the folder of the run
/// @throws DataError where it holds no shards, OutputRefused naming the part that is at work
RunLocks lock_shards(const std::filesystem::path& out);

/// Reads all records. The folder is locked.
/// @throws DataError for records that are none, std::invalid_argument for parts of different settings
GatheredShards gather_shards(const std::filesystem::path& out);

/// Writes manifest, times and report. Nothing is missing, and the folder is locked.
/// @throws std::invalid_argument where the folder holds another run, or something would be overwritten that
/// no run made, unless `force`
/// @param map  of the report; may be empty
void write_merged(const std::filesystem::path& out, GatheredShards gathered, bool force,
                  const report::MapDrawing& map);

/// The shards that have something missing, as Slurm's --array takes them: "3,5-7". Empty where nothing is.
std::string missing_array(const GatheredShards& gathered);

/// For programs: the numbers, and all that is missing.
std::string merge_json(const GatheredShards& gathered);

}  // namespace mimicx::run
