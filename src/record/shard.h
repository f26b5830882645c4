/// A part of a run: one of `count` shares of its inputs, for one machine among several.
///
/// Every machine is given the same inputs and picks its own share, without a word between them: the names of
/// all sequences are put in the order of their hashes and dealt out like cards. So no two shares differ by
/// more than one sequence, and names that follow a pattern (every eighth a jump) do not all go to one
/// machine. What the machines must agree on stands in the folder of the run (shard_list.h).
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

/// The shard of "3/64": the fourth of 64.
/// @throws std::invalid_argument saying what was expected
Shard parse_shard(const std::string& text);

/// The shard that a task of a Slurm array does, where the array has a task for every shard: its numbers begin
/// at 0 or 1 and none is left out. Empty outside an array.
/// @param variable  value of an environment variable, or null (std::getenv)
/// @throws std::invalid_argument for a task of any other array: a part of an array that is submitted again
/// must not pass for a smaller one
std::optional<Shard> shard_of_array(const std::function<const char*(const char*)>& variable);

/// "003-of-064"
std::string shard_name(const Shard& shard);

/// Folder of a run, with the records of one of its parts.
RunFolder shard_folder(const std::filesystem::path& root, const Shard& shard);

/// The shard of every sequence: that of place k in the order of (hash, name) is k mod count. The hash is
/// FNV-1a of the name's bytes, its bits mixed (docs/cluster.md, "Who does what").
/// @param names  of all sequences of the run, each once; their order plays no part
std::vector<int> assigned_shards(const std::vector<std::string>& names, int count);

}  // namespace mimicx::record
