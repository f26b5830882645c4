#include "page/session.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "import/motion_file.h"
#include "program/cli.h"
#include "program/small_run.h"
#include "record/json.h"
#include "run/results.h"

namespace mimicx::page {
namespace {

using record::Json;

struct PageSession : testing::Test {
  void SetUp() override {
    motion::write_clip(stand, motion::standing_clip(20));
    import::write_motion(bvh, motion::standing_clip(25));
  }
  Json plan(const std::string& file) {
    Json said;
    program::run_in_context([&](const record::RunContext& context) {
      said = Json::parse(session.plan(file, context));
      return record::RunOutcome::kAllGood;
    });
    return said;
  }
  std::string path(const std::string& name) const { return (folder.path / name).string(); }

  TemporaryFolder folder;
  Session session{folder.path / "session"};
  std::string stand = path("stand.npz"), bvh = path("turn.bvh");
};

TEST_F(PageSession, WritesTheBytesOfMimicxPlan) {
  Json said = plan(stand);
  EXPECT_TRUE(said["ok"].get<bool>()) << said["row"]["reason"].dump();
  const Call call = program::mimicx("plan " + stand + " --gains --out " + path("run"));
  ASSERT_EQ(call.status, 0) << call.text;
  auto expected = run::results_of(path("run")), found = run::results_of(path("session/0"));
  expected.erase("clusters.json");  // a page has no options to map its motions among
  for (auto* files : {&expected, &found}) files->erase("report.html");
  EXPECT_TRUE(expected.contains("motions/stand.npz"));
  EXPECT_TRUE(expected.contains("gains/stand.npz"));
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [name, bytes] : expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_TRUE(found.at(name) == bytes) << name;
  }
}

TEST_F(PageSession, SavesTheBytesOfMimicxConvert) {
  plan(stand);
  const std::string motion = path("session/0/motions/stand.npz");
  EXPECT_TRUE(session.saved(0, ".npz") == read_file(motion));
  for (const std::string suffix : {".bvh", ".glb", ".csv"}) {
    const std::string out = path("out" + suffix);
    const Call call = program::mimicx("convert " + motion + " " + out);
    ASSERT_EQ(call.status, 0) << call.text;
    EXPECT_TRUE(session.saved(0, suffix) == read_file(out)) << suffix;
  }
  EXPECT_THROW(session.saved(0, ".doc"), std::invalid_argument);
  EXPECT_THROW(session.saved(1, ".npz"), std::invalid_argument);
}

TEST_F(PageSession, SavesABvhAsItsCleanCopy) {
  EXPECT_TRUE(plan(bvh)["ok"].get<bool>());
  EXPECT_TRUE(session.saved(0, ".bvh") == read_file(path("session/0/clean/turn.bvh")));
}

TEST_F(PageSession, ReportsBadFilesInTheProgramsWords) {
  const std::string bad = path("bad.bvh");
  write_file_atomically(bad, "HIERARCHY\nROOT hips\n{\n  OFFSET 0 zero 0\n");
  Json said = plan(bad);
  EXPECT_FALSE(said["ok"].get<bool>());
  const auto reason = said["row"]["reason"].get<std::string>();
  EXPECT_EQ(reason.find('\n'), std::string::npos);
  EXPECT_TRUE(said["clip"]["motions"].elements().empty());
  const Call call = program::mimicx("plan " + bad + " --out " + path("run"));
  EXPECT_EQ(call.status, 1);
  EXPECT_TRUE(program::says(call, reason)) << reason << "\n" << call.text;
  EXPECT_THROW(session.saved(0, ".npz"), std::invalid_argument);
  EXPECT_THROW(session.play(0), std::invalid_argument);
}

TEST_F(PageSession, ResumesTheRunsOfAnEarlierSession) {
  plan(bvh);
  plan(stand);
  Session next(folder.path / "session");
  EXPECT_EQ(Json::parse(next.take_up(bvh))["number"], 0);
  EXPECT_EQ(Json::parse(next.take_up(stand))["number"], 1);
  EXPECT_TRUE(next.saved(0, ".bvh") == session.saved(0, ".bvh"));
  EXPECT_TRUE(next.saved(1, ".npz") == session.saved(1, ".npz"));
  EXPECT_EQ(next.play(1).frames(), session.play(1).frames());
  EXPECT_THROW(next.take_up(stand), DataError);
}

TEST_F(PageSession, MotionsAreNumberedAndShareBodies) {
  EXPECT_EQ(plan(stand)["number"], 0);
  Json second = plan(bvh);
  EXPECT_EQ(second["number"], 1);
  for (const Json& motion : second["clip"]["motions"].elements())
    EXPECT_TRUE(second["bodies"].contains(motion.at("body").get<std::string>()));
  EXPECT_EQ(session.play(0).frames(), 20);
}

TEST_F(PageSession, EmptyReportHasMetricsAndSkinButNoClip) {
  const std::string page = empty_report();
  const std::string begin = R"(<script id="data" type="application/json">)";
  const std::size_t at = page.find(begin);
  ASSERT_NE(at, std::string::npos);
  Json data = Json::parse(page.substr(at + begin.size(), page.find("</script>", at) - at - begin.size()));
  EXPECT_TRUE(data["rows"].elements().empty());
  EXPECT_FALSE(data["metrics"].elements().empty());
  EXPECT_NE(page.find("id=\"skin\""), std::string::npos);
  EXPECT_EQ(page.find("id=\"clip-0\""), std::string::npos);
}

}  // namespace
}  // namespace mimicx::page
