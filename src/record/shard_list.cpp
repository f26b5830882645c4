#include "record/shard_list.h"

#include <stdexcept>
#include <system_error>

#include "core/file.h"
#include "record/utf8_names.h"

namespace mimicx::record {
namespace {

/// "motion 3 is a.npz there, b.npz here"
std::string first_difference(const std::vector<ListedInput>& there, const std::vector<ListedInput>& here) {
  std::size_t k = 0;
  while (k < there.size() && k < here.size() && there[k] == here[k]) ++k;
  const auto at = [k](const std::vector<ListedInput>& list) {
    return k < list.size() ? list[k].input : std::string("none");
  };
  return "motion " + std::to_string(k + 1) + " of " + std::to_string(there.size()) + " is " + at(there) +
         " there, " + at(here) + " here";
}

}  // namespace

std::filesystem::path shard_list_path(const std::filesystem::path& root) {
  return root / "shards" / "run.json";
}

std::string format_shard_list(const ShardList& list) {
  Json inputs = Json::array();
  for (const ListedInput& input : list.inputs)
    inputs.push_back({{"name", to_utf8(input.name)}, {"input", to_utf8(input.input)}});
  return Json({{"run", run_json(list.settings)}, {"shards", list.count}, {"inputs", inputs}}).dump(1) + "\n";
}

ShardList read_shard_list(const std::filesystem::path& root) {
  const std::filesystem::path path = shard_list_path(root);
  if (!std::filesystem::exists(path))
    throw DataError(root.string(), "", "a run in parts (--shard I/N)", "none: there is no shards/run.json");
  return parse_shard_list(read_file(path), path);
}

ShardList parse_shard_list(const std::string& text, const std::filesystem::path& path) {
  try {
    const Json json = Json::parse(text);
    ShardList list;
    list.settings = run_of(json.at("run"));
    list.count = json.at("shards");
    for (const Json& input : json.at("inputs").elements())
      list.inputs.push_back(
          {from_utf8(input.at("name").get<std::string>()), from_utf8(input.at("input").get<std::string>())});
    if (list.count < 1) throw JsonError(std::to_string(list.count) + " shards");
    return list;
  } catch (const JsonError& error) {
    throw DataError(path.string(), "", "what the shards of a run agreed on", error.what());
  }
}

void compare(const ShardList& mine, const std::filesystem::path& folder) {
  const ShardList there = read_shard_list(folder);
  const std::string root = folder.string();
  if (there.count != mine.count)
    throw std::invalid_argument(root + " holds a run in " + std::to_string(there.count) + " shards, not in " +
                                std::to_string(mine.count) + ": pass --shard I/" +
                                std::to_string(there.count) + ", or give another folder");
  if (const auto differences = mine.settings.differences(there.settings, true); !differences.empty())
    throw std::invalid_argument(root + " holds shards of other settings (" + in_words(differences) +
                                "): give another folder, or remove it first");
  if (there.inputs != mine.inputs)
    throw std::invalid_argument(root + " holds shards of other inputs (" +
                                first_difference(there.inputs, mine.inputs) +
                                "): name the same ones, or give another folder");
}

void agree_on(const ShardList& mine, const RunFolder& part) {
  const std::filesystem::path path = shard_list_path(part.root);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    const std::filesystem::path own = part.records / "run.json";
    write_file_atomically(own, format_shard_list(mine));
    std::filesystem::create_hard_link(own, path, error);
    if (error && error != std::errc::file_exists)
      std::filesystem::rename(own, path, error);  // a file system without links
    if (!error || error == std::errc::file_exists) std::filesystem::remove(own, error);
    if (error) throw DataError(path.string(), "", "a writable file", error.message());
  }
  compare(mine, part.root);
}

std::vector<std::vector<ListedInput>> shares_of(const ShardList& list) {
  std::vector<std::string> names;
  for (const ListedInput& input : list.inputs) names.push_back(input.name);
  const std::vector<int> shards = assigned_shards(names, list.count);
  std::vector<std::vector<ListedInput>> shares(static_cast<std::size_t>(list.count));
  for (std::size_t i = 0; i < names.size(); ++i)
    shares[static_cast<std::size_t>(shards[i])].push_back(list.inputs[i]);
  return shares;
}

}  // namespace mimicx::record
