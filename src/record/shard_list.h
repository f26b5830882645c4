/// `shards/run.json`: what the shards of a run agree on: their number, the settings, and all inputs with
/// their names.
///
/// The shard that starts first writes it: the file is hard-linked into place, which only one process can do,
/// also on a shared file system. Every other shard compares its own list. The budget is not compared, because
/// it may grow from command to command; `mimicx merge` checks that all shards had the same.
#pragma once

#include <string>
#include <vector>

#include "record/manifest.h"
#include "record/shard.h"

namespace mimicx::record {

struct ListedInput {
  std::string name;   ///< of the sequence, in the folder
  std::string input;  ///< as given
  bool operator==(const ListedInput&) const = default;
};

struct ShardList {
  Manifest settings;  ///< without sequences
  int count = 1;      ///< of shards
  std::vector<ListedInput> inputs;
};

/// The path of the list.
std::filesystem::path shard_list_path(const std::filesystem::path& root);

/// @throws DataError if it is missing
ShardList read_shard_list(const std::filesystem::path& root);
/// The same from its text. @param path  for messages
ShardList parse_shard_list(const std::string& text, const std::filesystem::path& path);
std::string format_shard_list(const ShardList& list);

/// @throws std::invalid_argument naming the difference between the folder's existing list and `mine`
void compare(const ShardList& mine, const std::filesystem::path& root);

/// Makes `mine` the list of the folder: writes it, or compares it with the existing one.
/// @param part  the shard's folder; no other process writes to its records
/// @throws std::invalid_argument as `compare`, DataError if it cannot be written
void agree_on(const ShardList& mine, const RunFolder& part);

/// The inputs of every shard, in the list's order.
std::vector<std::vector<ListedInput>> shares_of(const ShardList& list);

}  // namespace mimicx::record
