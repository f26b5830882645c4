// Results for other programs: JSON of every command, and the gate of `evaluate`.
#include <gtest/gtest.h>

#include "core/file.h"
#include "motion/clip_file.h"
#include "program/cli.h"
#include "record/json.h"

namespace mimicx::program {
namespace {

using record::Json;

struct CliResults : Cli {
  void SetUp() override {
    motion::write_clip(a, motion::standing_clip(20));
    motion::write_clip(b, motion::standing_clip(24));
  }
  /// Standard output alone.
  Json said(const std::string& arguments) const {
    const Call call = shell(std::string(MIMICX_BINARY) + " " + arguments + " 2>/dev/null");
    EXPECT_EQ(call.status, 0) << arguments;
    return Json::parse(call.text);
  }
  std::string a = path("a.npz"), b = path("b.npz");
};

TEST_F(CliResults, EveryCommandPrintsThemAsJson) {
  EXPECT_EQ(said("info " + a + " --json -")["frames"].get<int>(), 20);
  EXPECT_EQ(said("fit " + a + " --poses --out " + path("fit") + " --json -")["motions"].elements().size(),
            1U);
  EXPECT_EQ(said("corrupt " + a + " --out " + path("bench") + " --json -")["motions"].elements().size(), 1U);
  EXPECT_EQ(said("synth --kinds stand --report --json -")["demands"].elements().size(), 1U);
  EXPECT_EQ(said("render " + a + " --out " + path("a.png") + " --size 64x64 --frames 2 --json -")["width"]
                .get<int>(),
            64);
  EXPECT_TRUE(said("cluster " + a + " " + b + " --out " + path("c.json") + " --json -").contains("clusters"));
  Json run = said("plan " + a + " --no-fit --out " + path("run") + " --json -");
  EXPECT_EQ(run["runs"].elements().size(), 1U);
  EXPECT_EQ(run["runs"].at(0).at("sequences").at(0).at("status").get<std::string>(), "ok");
  EXPECT_EQ(run["runs"].at(0).at("folder").get<std::string>(), path("run"));
  EXPECT_TRUE(said("report " + path("run") + " --json -").contains("report"));
  EXPECT_TRUE(said("audit " + path("run/motions") + " --json -").contains("files"));
  said("plan " + a + " --no-fit --substeps --out " + path("stepped") + " --json -");
  EXPECT_EQ(mimicx("certify " + path("stepped/motions") + " --out " + path("certificates")).status, 0);
  const Json replayed = said("certify --replay " + path("certificates/a.cert") + " --json -")["certificates"];
  EXPECT_EQ(replayed.elements().size(), 1U);
  EXPECT_TRUE(replayed.at(0).at("same_bits").get<bool>());
  EXPECT_TRUE(
      said("evaluate --truth " + a + " --motions " + path("run/motions") + " --json -").contains("mean"));
}

TEST_F(CliResults, JsonOfRunsBesideTheirInputsHasAllOfThem) {
  const std::string json = path("results.json");
  const Call call = mimicx("plan " + a + " " + b + " --no-fit --quiet --json " + json);
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_EQ(Json::parse(read_file(json))["runs"].elements().size(), 2U);
  EXPECT_EQ(mimicx("plan " + a + " --no-fit --quiet --json " + b).status,
            2);  // a file that is not ours to overwrite
}

TEST_F(CliResults, JsonNeverReplacesAFileOfTheRun) {
  const std::string plan = "plan " + a + " --no-fit --quiet", json = " --force --json ";
  const auto refused = [&](const std::string& command, const std::string& file) {
    const Call call = mimicx(command + json + path(file));
    EXPECT_EQ(call.status, 2) << file << call.text;
    EXPECT_TRUE(says(call, "--json: expected a file") && says(call, path(file))) << call.text;
    EXPECT_EQ(lines_of(call.text).size(), 1U) << call.text;
  };
  for (const char* file : {"manifest.json", "journal.jsonl", "timing.json", "report.html", "clusters.json",
                           "lock", "report/a.js", "motions/a.npz", "clean/new.json", "shards/run.json", ""})
    refused(plan + " --out " + path("run"), std::string("run/") + file);
  for (const char* file : {"a.mimicx", "a.mimicx/manifest.json", "a.mimicx/motions/a.npz", "a.clean.npz"})
    refused(plan, file);
  for (const char* file : {"all/clean/manifest.json", "all/options/clusters.json"})
    refused("run " + path("in") + " --out " + path("all"), file);
  for (const char* folder : {"run", "a.mimicx", "all"}) EXPECT_FALSE(std::filesystem::exists(path(folder)));
  const Call beside = mimicx(plan + " --out " + path("run") + json + path("run/results.json"));
  EXPECT_EQ(beside.status, 0) << "a file that the run does not have: " << beside.text;
}

TEST_F(CliResults, JsonOfAllStagesIsThatOfTheirLast) {
  std::filesystem::create_directories(path("in"));
  std::filesystem::rename(a, path("in/a.npz"));
  const std::string run = "run " + path("in") + " --out " + path("all") +
                          " --pretrain-samples 0 --budget-samples 0 --threads 1 --json ";
  EXPECT_EQ(mimicx(run + b).status, 2);  // before the stages: not ours to overwrite
  EXPECT_FALSE(std::filesystem::exists(path("all")));
  mimicx(run + path("all.json"));
  Json runs = Json::parse(read_file(path("all.json")))["runs"];
  EXPECT_EQ(runs.at(0).at("folder").get<std::string>(), path("all/clean"));
  EXPECT_EQ(runs.at(0).at("sequences").elements().size(), 1U);
}

TEST_F(CliResults, EvaluateFailsAboveALimit) {
  const std::string evaluate = "evaluate --truth " + a + " --motions " + a;
  EXPECT_EQ(mimicx(evaluate + " --fail-above MPJPE=1 --fail-above GP=1000").status, 0);
  const Call above = mimicx(evaluate + " --fail-above MPJPE=-1");
  EXPECT_EQ(above.status, 1);
  EXPECT_TRUE(says(above, "MPJPE is 0, above -1")) << above.text;
  const Call missing = mimicx(evaluate + " --fail-above chatter=1");  // the poses have no forces
  EXPECT_EQ(missing.status, 1);
  EXPECT_TRUE(says(missing, "chatter has no value")) << missing.text;
  EXPECT_EQ(mimicx(evaluate + " " + b + " --fail-above MPJPE=1").status, 1);  // b has no truth of its name
  std::filesystem::create_directories(path("one"));
  std::filesystem::copy(a, path("one/a.npz"));
  std::filesystem::create_directories(path("both"));
  for (const std::string& file : {a, b}) std::filesystem::copy(file, path("both"));
  const std::string lost = "evaluate --truth " + path("both") + " --motions ";
  EXPECT_EQ(mimicx(lost + path("one")).status, 0);
  EXPECT_EQ(mimicx(lost + path("one") + " --fail-above MPJPE=1").status, 1) << "the other one was lost";
  EXPECT_EQ(mimicx(lost + path("both") + " " + path("one") + " --fail-above MPJPE=1").status, 1);
  const Call nowhere = mimicx(lost + path("one") + " " + path("one") + " --fail-above MPJPE=1");
  EXPECT_EQ(nowhere.status, 1) << nowhere.text;
  EXPECT_TRUE(says(nowhere, "no motion for the truth b\n")) << nowhere.text;
  EXPECT_EQ(mimicx(lost + path("both") + " --fail-above MPJPE=1").status, 0);
  for (const char* wrong : {"MPJPE", "MPJPE=", "beauty=1", "=1"}) {
    const Call call = mimicx(evaluate + " --fail-above " + wrong);
    EXPECT_EQ(call.status, 2) << wrong;
    EXPECT_TRUE(says(call, "--fail-above")) << call.text;
  }
  EXPECT_EQ(mimicx(evaluate + " --fail-above MPJPE=1 --protocol phc").status, 2);
}

/// A copy of the program alone, in a folder without data; the working folder has some.
TEST_F(CliResults, DataIsThatOfTheEnvironmentOrBesideTheProgramNeverOfTheWorkingFolder) {
  const std::filesystem::path alone = folder.path / "alone", here = folder.path / "here";
  std::filesystem::create_directories(alone);
  std::filesystem::create_directories(here / "data");
  std::filesystem::copy_file(MIMICX_BINARY, alone / "mimicx");
  std::filesystem::create_directory_symlink(std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "options",
                                            here / "data" / "options");
  const auto call = [&](const std::string& environment, const std::string& arguments) {
    return shell("cd '" + here.string() + "' && " + environment + " '" + (alone / "mimicx").string() + "' " +
                 arguments + " 2>&1");
  };
  const Call planned = call("", "adapt " + a + " --no-fit --out out");
  EXPECT_EQ(planned.status, 0) << planned.text;
  EXPECT_TRUE(says(planned, "no trained options are installed")) << planned.text;
  EXPECT_EQ(call("", "adapt " + a + " --method options --budget-samples 0 --out none").status, 2);
  EXPECT_EQ(call("MIMICX_DATA=" + (here / "data").string(),
                 "adapt " + a + " --method options --budget-samples 0 --threads 1 --quiet --out found")
                .status,
            0);
  const Call wrong = call("MIMICX_DATA=/nowhere", "adapt " + a + " --out none");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(says(wrong, "MIMICX_DATA")) << wrong.text;
  std::filesystem::create_directories(alone / "share" /
                                      "mimicx");  // as installed, where the prefix is this folder
  std::filesystem::create_directory_symlink(here / "data" / "options",
                                            alone / "share" / "mimicx" / "options");
  EXPECT_EQ(
      call("", "adapt " + a + " --method options --budget-samples 0 --threads 1 --quiet --out beside").status,
      0);
}

}  // namespace
}  // namespace mimicx::program
