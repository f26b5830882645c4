/// `shards/run.json`: what the parts of a run agree on: into how many, of which settings, and all inputs with
/// their names.
///
/// Whichever part starts first writes it, once: the file is linked into place, which only one can do, on a
/// shared file system, too. Every other part compares. The budget apart, which may grow from command to
/// command: `mimicx merge` sees whether all parts had the same.
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

/// Where it stands.
std::filesystem::path shard_list_path(const std::filesystem::path& root);

/// @throws DataError where there is none
ShardList read_shard_list(const std::filesystem::path& root);
/// The same from its text. @param path  for messages
ShardList parse_shard_list(const std::string& text, const std::filesystem::path& path);
std::string format_shard_list(const ShardList& list);

/// @throws std::invalid_argument saying in what the folder's list, which is there, differs from `mine`
void compare(const ShardList& mine, const std::filesystem::path& root);

/// The list of the folder is `mine`: written now, or there already.
/// @param part  the folder as the part has it; nobody else writes to its records
/// @throws std::invalid_argument as `compare`, DataError where it cannot be written
void agree_on(const ShardList& mine, const RunFolder& part);

/// The inputs of every shard, in the list's order.
std::vector<std::vector<ListedInput>> shares_of(const ShardList& list);

}  // namespace mimicx::record
