/// `mimicx merge`: joins the shards of a run that several machines did.
///
/// The shards have written every motion to its place in the whole run, and their own records
/// (record/shard.h). Manifest, times and report are made from these records. Except for the times they are
/// the same bytes as those of a run on one machine, for any number of shards. Nothing is written while a
/// motion is missing.
///
/// After a merge the folder may go on as a whole run and make motions again, whose inputs have changed.
/// Merged again, it keeps the whole run's records of them, which describe the files that are there.
///
/// What it does not do: it reads only the motions that the report shows, and those whose records in folder
/// and shard differ. Damaged files are found by repeating the command of the run.
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

/// What the shards of a run have done so far.
struct GatheredShards {
  record::ShardList list;
  record::Manifest manifest;  ///< all finished inputs, in the order of the inputs
  std::vector<record::Timing> timings;
  std::vector<MissingInput> missing;  ///< neither done nor recorded as failed, or its motion file is missing
};

/// Locks all shards; while the locks live, no shard can work. @param out  the folder of the run
/// @throws DataError if it holds no shards, OutputRefused naming a shard that is running
RunLocks lock_shards(const std::filesystem::path& out);

/// Reads all records, also those of a folder that was merged before. The folder must be locked.
/// @throws DataError for invalid records, std::invalid_argument for shards of different settings
GatheredShards gather_shards(const std::filesystem::path& out);

/// Writes manifest, times and report. Nothing may be missing, and the folder must be locked.
/// @throws std::invalid_argument if the folder holds another run, or, unless `force`, if a file of another
/// program would be overwritten
/// @param map  of the report; may be empty
void write_merged(const std::filesystem::path& out, GatheredShards gathered, bool force,
                  const report::MapDrawing& map);

/// The shards with missing motions, in the format of Slurm's --array: "3,5-7". Empty if nothing is missing.
std::string missing_array(const GatheredShards& gathered);

/// The counts and everything that is missing, as JSON.
std::string merge_json(const GatheredShards& gathered);

}  // namespace mimicx::run
