#include "record/shard.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "core/number_text.h"

namespace mimicx::record {
namespace {

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<int> whole_number(const char* text) {
  return text == nullptr ? std::nullopt : whole_number(std::string_view(text));
}

/// FNV-1a with its bits mixed: alone it changes few high bits with the last character, in which names of a
/// pattern differ. Source of the mixing: Appleby, MurmurHash3, fmix64.
std::uint64_t hash_of(std::string_view name) {
  std::uint64_t hash = fnv1a(name);
  for (const std::uint64_t factor : {0xff51afd7ed558ccdu, 0xc4ceb9fe1a85ec53u})
    hash = (hash ^ hash >> 33) * factor;
  return hash ^ hash >> 33;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto index = whole_number(std::string_view(text).substr(0, slash));
    const auto count = whole_number(std::string_view(text).substr(slash + 1));
    if (index && count && *index >= 0 && *index < *count) return {*index, *count};
  }
  throw std::invalid_argument("--shard: expected I/N with I from 0 to N - 1, found " + text);
}

std::optional<Shard> shard_of_array(const std::function<const char*(const char*)>& variable) {
  const char* task = variable("SLURM_ARRAY_TASK_ID");
  if (task == nullptr) return std::nullopt;
  const std::optional<int> id = whole_number(task);
  const auto count = whole_number(variable("SLURM_ARRAY_TASK_COUNT"));
  const auto first = whole_number(variable("SLURM_ARRAY_TASK_MIN"));
  const auto last = whole_number(variable("SLURM_ARRAY_TASK_MAX"));
  const bool whole = id && count && first && last && (*first == 0 || *first == 1) && *count >= 1 &&
                     *last == *first + *count - 1 && *id >= *first && *id <= *last;
  if (!whole)
    throw std::invalid_argument(
        "this task is of a Slurm array that begins at neither 0 nor 1 or leaves tasks out, so its share of "
        "the "
        "motions is not known: pass --shard I/N, or --shard whole for all of them");
  return Shard{*id - *first, *count};
}

std::string shard_name(const Shard& shard) {
  const int width = std::max(3, static_cast<int>(std::to_string(shard.count).size()));
  return formatted("%0*d-of-%0*d", width, shard.index, width, shard.count);
}

RunFolder shard_folder(const std::filesystem::path& root, const Shard& shard) {
  return {root, root / "shards" / shard_name(shard)};
}

std::vector<int> assigned_shards(const std::vector<std::string>& names, int count) {
  std::vector<std::tuple<std::uint64_t, std::string_view, std::size_t>> order;
  for (std::size_t i = 0; i < names.size(); ++i) order.emplace_back(hash_of(names[i]), names[i], i);
  std::sort(order.begin(), order.end());
  std::vector<int> shards(names.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    shards[std::get<2>(order[k])] = static_cast<int>(k % static_cast<std::size_t>(count));
  return shards;
}

}  // namespace mimicx::record
