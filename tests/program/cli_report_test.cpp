// The report of a run, made again from its folder alone.
#include "core/file.h"
#include "motion/clip_file.h"
#include "program/cli.h"
#include "run/results.h"

namespace mimicx::program {
namespace {

struct CliReport : Cli {
  void SetUp() override {
    std::filesystem::create_directories(path("in"));
    motion::write_clip(path("in/a.npz"), motion::standing_clip(20));
    motion::write_clip(path("in/b.npz"), motion::standing_clip(25));
    const Call call = mimicx("plan " + path("in") + " --threads 1 --out " + path("run"));
    ASSERT_EQ(call.status, 0) << call.text;
  }
};

TEST_F(CliReport, MatchesTheRunsReportWithoutItsInputs) {
  const auto whole = run::results_of(path("run"));
  std::filesystem::remove(path("run/report.html"));
  std::filesystem::remove_all(path("in"));
  const Call call = mimicx("report " + path("run"));
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_EQ(call.text, path("run/report.html") + "\n");
  EXPECT_EQ(run::results_of(path("run")), whole);
}

TEST_F(CliReport, NamesClipsWithoutTruthAndShowsTheOthers) {
  std::filesystem::create_directories(path("truth"));
  std::filesystem::copy(path("in/a.npz"), path("truth/a.npz"));
  const Call call = mimicx("report " + path("run") + " --truth " + path("truth"));
  EXPECT_EQ(call.status, 1);
  EXPECT_TRUE(says(call, "b: " + path("truth") + " has no truth of that name\n")) << call.text;
  EXPECT_EQ(lines_of(call.text).size(), 2u) << call.text;
  const std::string page = read_file(path("run/report.html"));
  const std::size_t first = page.find("\"who\":\"truth\",\"frames\"");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(page.find("\"who\":\"truth\",\"frames\"", first + 1), std::string::npos);
}

TEST_F(CliReport, NamesATruthThatCannotBeRead) {
  std::filesystem::create_directories(path("torn"));
  std::filesystem::copy(path("in/a.npz"), path("torn/a.npz"));
  write_file_atomically(path("torn/b.npz"), read_file(path("in/b.npz")).substr(0, 200));
  const Call call = mimicx("report " + path("run") + " --truth " + path("torn"));
  EXPECT_EQ(call.status, 1);
  EXPECT_TRUE(says(call, path("torn/b.npz") + ": the truth cannot be shown: ")) << call.text;
  EXPECT_EQ(lines_of(call.text).size(), 2u) << call.text;
}

TEST_F(CliReport, NamesClipsWhoseMotionIsMissing) {
  std::filesystem::rename(path("run/motions/a.npz"), path("a.npz"));
  const Call call = mimicx("report " + path("run"));
  std::filesystem::rename(path("a.npz"), path("run/motions/a.npz"));
  EXPECT_EQ(call.status, 1);
  EXPECT_TRUE(says(call, "a: its page is empty: expected " + path("run/motions/a.npz") + ", found no file"))
      << call.text;
  EXPECT_EQ(mimicx("report " + path("run")).status, 0);
}

TEST_F(CliReport, RejectsAFolderWithoutARun) {
  for (const char* folder : {"in", "nowhere"}) {
    const Call call = mimicx("report " + path(folder));
    EXPECT_NE(call.status, 0);
    EXPECT_EQ(lines_of(call.text).size(), 1u) << call.text;
    EXPECT_TRUE(says(call, "expected the folder of a run")) << call.text;
  }
  EXPECT_FALSE(std::filesystem::exists(path("nowhere")));
  EXPECT_FALSE(std::filesystem::exists(path("in/report.html")));
}

TEST_F(CliReport, MissingTruthLeavesTheReportUnchanged) {
  const std::string page = read_file(path("run/report.html"));
  const Call call = mimicx("report " + path("run") + " --truth " + path("none"));
  EXPECT_NE(call.status, 0);
  EXPECT_EQ(lines_of(call.text).size(), 1u) << call.text;
  EXPECT_EQ(read_file(path("run/report.html")), page);
}

}  // namespace
}  // namespace mimicx::program
