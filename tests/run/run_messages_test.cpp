// What a run tells the person who waits.
#include "run/run_messages.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mimicx::run {
namespace {

record::SequenceEntry walk_entry() {
  record::SequenceEntry entry;
  entry.name = "walk";
  entry.ok = true;
  entry.frames = 150;
  entry.fps = 30.0;
  entry.input_metrics = {{"slip", 1.7}, {"GP", 0.0}, {"Float_gt", std::nan("")}, {"Jitter", 9.0}};
  entry.metrics = {{"gMPJPE", 12.04}, {"slip", 0.2}, {"GP", 0.01}, {"Float_gt", 3.0}, {"Jitter", 0.4}};
  return entry;
}

record::SequenceEntry fallen(const std::string& name) {
  record::SequenceEntry entry;
  entry.name = name;
  entry.reason = "it falls at 2.1 s";
  entry.metrics = {{"gMPJPE", 800.0}, {"slip", 4.0}};
  return entry;
}

TEST(ResultLine, ListsImprovementsAndOmitsInvisibleFaults) {
  EXPECT_EQ(result_line(walk_entry()),
            "walk: ok, 12.0 mm from the reference, sliding 1.7 -> 0.2 mm a frame, floating 3.0 mm, "
            "jitter 90 -> 4 m/s^3");
}

TEST(ResultLine, TellsWhatBecameWorseAndWhy) {
  record::SequenceEntry entry = walk_entry();
  entry.worse = {{"sliding", "0.4 -> 0.9 mm a frame", {{31, 40}, {77, 77}}, "its reference slides, too"},
                 {"moving of standing feet", "1.3 -> 1.7 mm a frame", {{3, 4}}, "its reference does not"}};
  EXPECT_TRUE(result_line(entry).ends_with(
      "; worse than the input: sliding (its reference slides, too), moving of standing feet 1.3 -> 1.7 mm a "
      "frame (its reference does not)"))
      << result_line(entry);
  EXPECT_EQ(in_words(entry.worse[0]),
            "sliding 0.4 -> 0.9 mm a frame, most at frames 31-40, 77: its reference slides, too");
}

TEST(ResultLine, GivesTheReasonOfAFailure) {
  EXPECT_EQ(result_line(fallen("jump")), "jump: failed, it falls at 2.1 s, 800.0 mm from the reference");
  record::SequenceEntry unread;
  unread.name = "x";
  unread.reason = "x.npz: key 'poses' expected";
  EXPECT_EQ(result_line(unread), "x: failed, x.npz: key 'poses' expected");
}

TEST(Summary, CountsFailuresAndExcludesThemFromMedians) {
  std::vector<record::SequenceEntry> entries = {walk_entry(), walk_entry(), fallen("jump")};
  entries[1].metrics[0].second = 20.0;
  const std::vector<std::string> lines = summary(entries, 61.0, "to look at: out/report.html");
  const std::vector<std::string> expected = {"2 of 3 motions are ok: 10 s of motion in 1 min 01 s",
                                             "  in the median 16.0 mm from the reference, at most 20.0 mm",
                                             "  sliding 1.7 -> 0.2 mm a frame",
                                             "  floating 3.0 mm",
                                             "  jitter 90 -> 4 m/s^3",
                                             "  failed: jump",
                                             "  to look at: out/report.html"};
  EXPECT_EQ(lines, expected);
}

TEST(WhatNext, NamesAnInfeasibleReferenceUnlessTimeRanOut) {
  record::SequenceEntry entry = fallen("jump");
  entry.output = "rejected/jump.npz";
  entry.feasibility = {{"infeasible_share", 0.1}};
  const auto blames = [&] {
    for (const std::string& line : what_next(entry, {"out"}))
      if (line.find("feasible") != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(blames());
  entry.ending = record::SequenceEnding::kLimitSeconds;
  EXPECT_FALSE(blames());
}

TEST(Summary, HasAtMostEightLines) {
  std::vector<record::SequenceEntry> entries(3, walk_entry());
  for (record::SequenceEntry& entry : entries)
    entry.input_metrics = {{"slip", 2.0}, {"GP", 2.0}, {"Float_gt", 2.0}, {"Jitter", 2.0}};
  for (int k = 0; k < 9; ++k) entries.push_back(fallen("fall_" + std::to_string(k)));
  const std::vector<std::string> lines = summary(entries, 1.0, "report.html");
  EXPECT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines[6], "  failed: fall_0, fall_1, fall_2, fall_3, fall_4 and 4 more");
}

}  // namespace
}  // namespace mimicx::run
