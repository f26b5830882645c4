#include "record/journal.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "core/temporary_folder.h"

namespace mimicx::record {
namespace {

SequenceEntry entry(int k) {
  SequenceEntry e;
  e.name = std::to_string(1000 + k).append("\xff\t");
  e.input = e.name;
  e.output = e.name;
  e.reason = "a\nb";
  e.metrics = {{"MPJPE", 0.1 + k}, {"Float_gt", std::nan("")}};
  e.arrangement = {{0, 1}, {35, 4}};
  e.files = {{e.output, "00ff"}};
  return e;
}

Timing timing(int k) { return {entry(k).name, 1.5 * k, 0.5, 0.25, 2}; }

TEST(Journal, ReplayGivesTheManifestOfAnUninterruptedRun) {
  const TemporaryFolder folder;
  const auto path = folder.path / "journal.jsonl";
  Manifest expected, manifest;
  expected.put(entry(0)), manifest.put(entry(0));
  Journal journal(path);
  std::vector<Timing> times, expected_times;
  for (const int k : {1, 2, 0, 3}) {
    SequenceEntry e = entry(k);
    e.ok = true;
    journal.append(e, timing(k));
    expected.put(e);
    expected_times.push_back(timing(k));
  }
  replay_journal(path, manifest, times);
  EXPECT_EQ(format_manifest(manifest), format_manifest(expected));
  EXPECT_EQ(format_timing(times, manifest.sequences), format_timing(expected_times, manifest.sequences));
  replay_journal(path, manifest, times);
  EXPECT_EQ(format_manifest(manifest), format_manifest(expected)) << "twice is once";
}

TEST(Journal, IncompleteLastLineIsIgnored) {
  const TemporaryFolder folder;
  const auto path = folder.path / "journal.jsonl";
  Journal journal(path);
  journal.append(entry(1), timing(1));
  const auto whole = std::filesystem::file_size(path);
  journal.append(entry(2), timing(2));
  for (auto bytes = std::filesystem::file_size(path) - 1; bytes >= whole; bytes -= 7) {
    std::filesystem::resize_file(path, bytes);
    Manifest manifest;
    std::vector<Timing> times;
    replay_journal(path, manifest, times);
    ASSERT_EQ(manifest.sequences.size(), 1u);
  }
  write_file_atomically(path, "no json\n");
  Manifest manifest;
  std::vector<Timing> times;
  EXPECT_THROW(replay_journal(path, manifest, times), DataError);
}

TEST(Journal, AppendingIsConstantTime) {
  const TemporaryFolder folder;
  const auto path = folder.path / "journal.jsonl";
  Journal journal(path);
  std::uintmax_t first = 0, before = 0;
  for (int k = 0; k < 200; ++k) {
    journal.append(entry(k), {entry(k).name, 1.0, 0.5, 0.25, 2});
    const auto size = std::filesystem::file_size(path);
    if (k == 0) first = size;
    ASSERT_LE(size - before, first + 16) << k;
    before = size;
  }
}

TEST(Journal, ClearRemovesTheFileAndAppendStartsANewOne) {
  const TemporaryFolder folder;
  const auto path = folder.path / "journal.jsonl";
  Journal journal(path);
  EXPECT_FALSE(std::filesystem::exists(path));
  journal.append(entry(1), timing(1));
  journal.clear();
  EXPECT_FALSE(std::filesystem::exists(path));
  journal.append(entry(2), timing(2));
  Manifest manifest;
  std::vector<Timing> times;
  replay_journal(path, manifest, times);
  ASSERT_EQ(manifest.sequences.size(), 1u);
  EXPECT_EQ(manifest.sequences[0].name, entry(2).name);
}

}  // namespace
}  // namespace mimicx::record
