#include "record/shard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>

namespace mimicx::record {
namespace {

/// "kick_1" … "kick_8", "walk_1" …: as data sets name their clips.
std::vector<std::string> patterned_names(int kinds) {
  std::vector<std::string> names;
  for (int kind = 0; kind < kinds; ++kind)
    for (int k = 1; k <= 8; ++k) names.push_back("kind" + std::to_string(kind) + "_" + std::to_string(k));
  return names;
}

TEST(Shard, EachSequenceIsInOneShardAndSizesDifferByAtMostOne) {
  const std::vector<std::string> names = patterned_names(40);
  for (const int count : {1, 2, 5, 64, 320, 1000}) {
    const std::vector<int> shards = assigned_shards(names, count);
    ASSERT_EQ(shards.size(), names.size());
    std::vector<int> sizes(static_cast<std::size_t>(count));
    for (const int shard : shards) {
      ASSERT_TRUE(shard >= 0 && shard < count) << shard;
      ++sizes[static_cast<std::size_t>(shard)];
    }
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    EXPECT_LE(*most - *least, 1) << count;
  }
}

/// As docs/cluster.md says it in words: how many names come before, by a loop of its own.
int shard_by_counting(const std::vector<std::string>& names, const std::string& name, int count) {
  const auto key = [](const std::string& text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text) {
      hash ^= static_cast<std::uint8_t>(c);
      hash *= 1099511628211u;
    }
    hash = (hash ^ (hash >> 33)) * 18397679294719823053u;
    hash = (hash ^ (hash >> 33)) * 14181476777654086739u;
    hash ^= hash >> 33;
    return std::pair(hash, text);
  };
  const auto before = std::count_if(names.begin(), names.end(),
                                    [&](const std::string& other) { return key(other) < key(name); });
  return static_cast<int>(before % count);
}

TEST(Shard, AssignmentDependsOnHashesNotOnListOrder) {
  std::vector<std::string> names = patterned_names(12);
  names.push_back("g\xc3\xa4hn/\xff");  // bytes are bytes
  std::mt19937 shuffle(7);
  for (const int count : {2, 7}) {
    std::shuffle(names.begin(), names.end(), shuffle);
    const std::vector<int> shards = assigned_shards(names, count);
    for (std::size_t i = 0; i < names.size(); ++i)
      EXPECT_EQ(shards[i], shard_by_counting(names, names[i], count)) << names[i];
  }
}

TEST(Shard, SpreadsNamesThatFollowAPattern) {
  const std::vector<std::string> names = patterned_names(200);
  const std::vector<int> shards = assigned_shards(names, 8);
  std::map<int, int> eighths;  // all that end on _8; dealt in their own order, one shard would have all 200
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].ends_with("_8")) ++eighths[shards[i]];
  for (const auto& [shard, size] : eighths) EXPECT_LT(size, 50) << shard;
}

TEST(Shard, ParsesIOfNFromZeroAndRejectsTheRest) {
  EXPECT_EQ(parse_shard("0/1").count, 1);
  EXPECT_EQ(parse_shard("63/64").index, 63);
  for (const char* text : {"", "3", "/", "1/", "/2", "64/64", "-1/4", "1/0", "0/-1", "1/2/3", "1 /2", "a/b",
                           "0x1/2", "1/99999999999"})
    EXPECT_THROW(parse_shard(text), std::invalid_argument) << text;
}

TEST(Shard, FolderNamesSortByNumber) {
  EXPECT_EQ(shard_name({3, 64}), "003-of-064");
  EXPECT_EQ(shard_name({999, 1000}), "0999-of-1000");
  EXPECT_EQ(shard_folder("out", {0, 2}).manifest(), "out/shards/000-of-002/manifest.json");
  EXPECT_EQ(shard_folder("out", {0, 2}).plan("a"), "out/plans/a.npz");
}

std::optional<Shard> of_variables(const std::map<std::string, std::string>& variables) {
  return shard_of_array([&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

std::map<std::string, std::string> task(const char* id, const char* count, const char* first,
                                        const char* last) {
  return {{"SLURM_ARRAY_TASK_ID", id},
          {"SLURM_ARRAY_TASK_COUNT", count},
          {"SLURM_ARRAY_TASK_MIN", first},
          {"SLURM_ARRAY_TASK_MAX", last}};
}

TEST(Shard, TaskOfACompleteArrayGetsItsIndex) {
  EXPECT_FALSE(of_variables({}));
  const auto from_zero = of_variables(task("3", "8", "0", "7")),
             from_one = of_variables(task("8", "8", "1", "8"));
  ASSERT_TRUE(from_zero && from_one);
  EXPECT_EQ(from_zero->index, 3);
  EXPECT_EQ(from_zero->count, 8);
  EXPECT_EQ(from_one->index, 7);
  EXPECT_EQ(from_one->count, 8);
}

TEST(Shard, RejectsTasksOfIncompleteArrays) {
  EXPECT_THROW(of_variables({{"SLURM_ARRAY_TASK_ID", "3"}}), std::invalid_argument);
  EXPECT_THROW(of_variables(task("3", "2", "3", "5")), std::invalid_argument) << "--array=3,5";
  EXPECT_THROW(of_variables(task("2", "2", "2", "3")), std::invalid_argument) << "--array=2-3";
  EXPECT_THROW(of_variables(task("0", "4", "0", "6")), std::invalid_argument) << "--array=0-6:2";
  EXPECT_THROW(of_variables(task("9", "8", "0", "7")), std::invalid_argument);
  EXPECT_THROW(of_variables(task("x", "8", "0", "7")), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::record
