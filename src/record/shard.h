/// A shard of a run: one of `count` shares of its inputs, for one of several machines.
///
/// Every machine gets the same inputs and picks its own share without communication: all names are sorted by
/// their hashes and assigned to the shards in turn. So the sizes of two shares differ by at most one, and
/// names that follow a pattern (every eighth a jump) are spread over the machines. The folder of the run
/// records what the machines must agree on (shard_list.h).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "record/run_folder.h"

namespace mimicx::record {

struct Shard {
  int index = 0;  ///< from 0 to count - 1
  int count = 1;
};

/// Parses "3/64", the fourth of 64.
/// @throws std::invalid_argument saying what was expected
Shard parse_shard(const std::string& text);

/// The shard of this task of a Slurm array, if the array is complete: its indices begin at 0 or 1 and none is
/// missing. Empty outside an array.
/// @param variable  value of an environment variable, or null (std::getenv)
/// @throws std::invalid_argument for a task of an incomplete array: tasks that are submitted again must not
/// be taken for a smaller array
std::optional<Shard> shard_of_array(const std::function<const char*(const char*)>& variable);

/// "003-of-064"
std::string shard_name(const Shard& shard);

/// Folder of a run, with the records of one of its shards.
RunFolder shard_folder(const std::filesystem::path& root, const Shard& shard);

/// The shard of every sequence: that of place k in the order of (hash, name) is k mod count. The hash is
/// FNV-1a of the name's bytes, its bits mixed (docs/cluster.md, "Who does what").
/// @param names  of all sequences of the run, each once, in any order
std::vector<int> assigned_shards(const std::vector<std::string>& names, int count);

}  // namespace mimicx::record
