#include "record/shard_list.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "core/error.h"
#include "core/file.h"
#include "core/temporary_folder.h"
#include "record/folder_lock.h"
#include "record/outputs.h"

namespace mimicx::record {
namespace {

ShardList list_of(int count, const std::vector<ListedInput>& inputs) {
  ShardList list;
  list.settings.version = "1";
  list.settings.samples = 100;
  list.settings.settings = {{"gamma", 0.5}};
  list.count = count;
  list.inputs = inputs;
  return list;
}

/// The part of a run, with its folder.
RunFolder part_of(const TemporaryFolder& folder, int index, int count) {
  const RunFolder part = shard_folder(folder.path, {index, count});
  make_folder(part.records);
  return part;
}

/// What is said of `mine` by a folder whose list is `there`; empty where it agrees.
std::string said_of(const ShardList& mine, const ShardList& there) {
  const TemporaryFolder folder;
  agree_on(there, part_of(folder, 0, there.count));
  try {
    agree_on(mine, part_of(folder, 1, mine.count));
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(ShardList, RoundTripKeepsNamesOfAnyBytes) {
  const TemporaryFolder folder;
  const ShardList list = list_of(2, {{"a", "in/a.npz"}, {"\xff", "in/\xff.npz"}});
  agree_on(list, part_of(folder, 0, 2));
  const ShardList back = read_shard_list(folder.path);
  EXPECT_EQ(back.count, 2);
  EXPECT_EQ(back.inputs, list.inputs);
  EXPECT_TRUE(back.settings.differences(list.settings).empty());
  EXPECT_TRUE(std::filesystem::is_empty(shard_folder(folder.path, {0, 2}).records)) << "nothing is left over";
  EXPECT_TRUE(holds_run(folder.path)) << "its motions are no inputs of another run";
}

TEST(ShardList, NamesTheDifferenceInOneLine) {
  const ShardList list = list_of(2, {{"a", "a.npz"}, {"b", "b.npz"}});
  EXPECT_EQ(said_of(list, list), "");
  ShardList other = list;
  other.count = 3;
  EXPECT_TRUE(has(said_of(other, list), "in 2 shards, not in 3: pass --shard I/2")) << said_of(other, list);
  other = list;
  other.settings.settings = {{"gamma", 0.75}};
  EXPECT_TRUE(has(said_of(other, list), "(gamma is 0.5 there, 0.75 here)")) << said_of(other, list);
  other = list;
  other.settings.samples = 200;
  EXPECT_EQ(said_of(other, list), "") << "a budget may grow";
  other = list_of(2, {{"a", "a.npz"}, {"c", "c.npz"}});
  EXPECT_TRUE(has(said_of(other, list), "motion 2 of 2 is b.npz there, c.npz here")) << said_of(other, list);
  other = list_of(2, {{"a", "a.npz"}});
  EXPECT_TRUE(has(said_of(other, list), "motion 2 of 2 is b.npz there, none here")) << said_of(other, list);
}

TEST(ShardList, OneOfSeveralConcurrentWritersWins) {
  for (int round = 0; round < 20; ++round) {
    const TemporaryFolder folder;
    constexpr int kParts = 8;
    std::atomic<int> agreed = 0, refused = 0;
    std::vector<RunFolder> parts;
    for (int i = 0; i < kParts; ++i) parts.push_back(part_of(folder, i, kParts));
    std::vector<std::thread> machines;
    for (int i = 0; i < kParts; ++i)
      machines.emplace_back([&, i] {
        try {
          agree_on(list_of(kParts, {{"a", std::to_string(i)}}), parts[static_cast<std::size_t>(i)]);
          ++agreed;
        } catch (const std::invalid_argument&) {
          ++refused;
        }
      });
    for (std::thread& machine : machines) machine.join();
    EXPECT_EQ(agreed, 1);
    EXPECT_EQ(refused, kParts - 1);
  }
}

TEST(ShardList, RejectsOtherFilesByName) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_shard_list(folder.path), DataError);
  make_folder(folder.path / "shards");
  for (const char* text : {"", "{}", "[1]", "{\"run\": {}, \"shards\": 0, \"inputs\": []}"}) {
    write_file_atomically(shard_list_path(folder.path), text);
    EXPECT_THROW(read_shard_list(folder.path), DataError) << text;
  }
}

TEST(FolderLock, SharedAndExclusiveLocksExcludeEachOther) {
  const TemporaryFolder folder;
  for (const char* file : {"", "lock"}) {
    {
      const FolderLock one(folder.path, Hold::kShared, file), two(folder.path, Hold::kShared, file);
      EXPECT_THROW(FolderLock(folder.path, Hold::kAlone, file), OutputRefused);
    }
    const FolderLock alone(folder.path, Hold::kAlone, file);
    EXPECT_THROW(FolderLock(folder.path, Hold::kShared, file), OutputRefused);
  }
}

}  // namespace
}  // namespace mimicx::record
