// Many motions: folders of folders, and a run that is killed.
#include "core/file.h"
#include "import/motion_file.h"
#include "motion/clip_file.h"
#include "program/cli.h"
#include "run/results.h"

namespace mimicx::program {
namespace {

struct CliMany : Cli {
  void SetUp() override {
    for (const char* file : {"in/b.npz", "in/CMU/01/a.npz", "in/CMU/02/a.npz"}) {
      std::filesystem::create_directories(std::filesystem::path(path(file)).parent_path());
      motion::write_clip(path(file), motion::standing_clip(20));
    }
  }
};

TEST_F(CliMany, OutputsKeepTheFolderTreeOfTheInputs) {
  for (const auto& [command, part] : std::vector<std::pair<std::string, std::string>>{
           {"plan ", "run/motions/"}, {"fit ", "run/"}, {"corrupt ", "run/noisy/"}}) {
    const Call call = mimicx(command + path("in") + " --out " + path("run"));
    EXPECT_EQ(call.status, 0) << call.text;
    for (const char* name : {"b", "CMU/01/a", "CMU/02/a"})
      EXPECT_TRUE(std::filesystem::exists(path(part + name + ".npz"))) << command << name << call.text;
    std::filesystem::remove_all(path("run"));
  }
}

TEST_F(CliMany, OutputFolderInsideTheInputsIsSkipped) {
  const std::string command = "plan " + path("in") + " --out " + path("in/run");
  EXPECT_EQ(mimicx(command).status, 0);
  const auto whole = run::results_of(path("in/run"));
  EXPECT_EQ(mimicx(command).status, 0);
  EXPECT_EQ(run::results_of(path("in/run")), whole);
  const std::string fit = "fit " + path("in/CMU") + " --out " + path("in/CMU/fits");
  EXPECT_EQ(mimicx(fit).status, 0);
  EXPECT_EQ(mimicx(fit).status, 0) << "its own outputs are replaced, not read";
}

// A run into the folder of its inputs could not go on: a run's folder has no inputs.
TEST_F(CliMany, OutputFolderOfTheInputsIsWrongUsage) {
  const Call call = mimicx("plan " + path("in") + " --out " + path("in/"));
  EXPECT_EQ(call.status, 2) << call.text;
  EXPECT_TRUE(says(call, "--out: expected a folder for the results alone")) << call.text;
  EXPECT_FALSE(std::filesystem::exists(path("in/manifest.json")));
}

// What the first command would write there, the second would read, or refuse to overwrite.
TEST_F(CliMany, InputsAmongTheResultsAreWrongUsageAtOnce) {
  for (const char* part : {"C", "C/motions", "C/rejected", "C/inputs", "C/references", "C/fits", "C/clean",
                           "C/plans", "C/truth"}) {
    std::filesystem::create_directories(path(part));
    import::write_motion(path(part) + "/w.bvh", motion::standing_clip(20));
  }
  const auto before = run::results_of(path("C"));
  const auto refused = [&](const std::string& command, const std::string& input) {
    const Call call = mimicx(command + " " + path(input) + " --out " + path("C"));
    EXPECT_EQ(call.status, 2) << command << ' ' << input << call.text;
    EXPECT_TRUE(says(call, "--out: expected a folder for the results alone")) << call.text;
    EXPECT_TRUE(says(call, path(input))) << call.text;
    EXPECT_EQ(run::results_of(path("C")), before) << command << ' ' << input;
  };
  for (const char* input :
       {"C", "C/motions", "C/rejected", "C/inputs", "C/references", "C/fits", "C/clean", "C/plans"})
    refused("plan", input);
  refused("imitate", "C/motions/w.bvh");
  refused("teach", "C/plans");
  refused("corrupt", "C/truth");
  for (const char* command : {"pretrain", "teach", "corrupt", "fit"}) refused(command, "C");
}

TEST_F(CliMany, InputsMayLieInTheOutputFolderBesideTheResults) {
  for (const char* command : {"plan ", "fit "})
    for (const char* time : {"first", "second"}) {
      const Call call = mimicx(command + path("in/CMU/01") + " --out " + path("in"));
      EXPECT_EQ(call.status, 0) << command << ", " << time << call.text;
    }
}

TEST_F(CliMany, CertificatesKeepTheFolderTreeOfTheRun) {
  ASSERT_EQ(mimicx("plan " + path("in/CMU") + " --no-fit --substeps --out " + path("run")).status, 0);
  const Call call = mimicx("certify " + path("run/motions") + " --out " + path("certificates"));
  EXPECT_EQ(call.status, 0) << call.text;
  for (const char* name : {"01/a", "02/a"})
    EXPECT_TRUE(std::filesystem::exists(path("certificates/" + std::string(name) + ".cert"))) << name;
}

TEST_F(CliMany, PartsOfMotionsGetNoCertificates) {
  std::filesystem::rename(path("in/CMU/02/a.npz"), path("in/CMU/02/b.part2.npz"));  // a motion of this name
  ASSERT_EQ(mimicx("plan " + path("in/CMU") + " --no-fit --substeps --out " + path("run")).status, 0);
  std::filesystem::copy_file(path("run/motions/01/a.npz"), path("run/motions/01/a.part1.npz"));
  const Call call = mimicx("certify " + path("run/motions") + " --out " + path("certificates"));
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_EQ(lines_of(call.text),
            std::vector<std::string>{
                "certify: 1 part of motions left out (NAME.partK.npz): parts have no physics steps"});
  for (const char* name : {"01/a.cert", "02/b.part2.cert"})
    EXPECT_TRUE(std::filesystem::exists(path("certificates/" + std::string(name)))) << name;
  EXPECT_FALSE(std::filesystem::exists(path("certificates/01/a.part1.cert")));
  const std::string part = path("run/motions/01/a.part1.npz");
  EXPECT_EQ(mimicx("certify " + part + " --out " + path("certificates")).status, 1) << "it was asked for";
}

TEST_F(CliMany, KilledRunContinuesToTheSameBytes) {
  const std::string command = "plan " + path("in") + " --threads 1 --out ";
  ASSERT_EQ(mimicx(command + path("whole")).status, 0);
  EXPECT_FALSE(std::filesystem::exists(path("whole/journal.jsonl")));
  mimicx(command + path("halves") + " 2>&1 & while [ ! -s " + path("halves/journal.jsonl") +
         " ] && kill -0 $! 2>/dev/null; do sleep 0.005; done; kill -9 $!; wait $!");
  ASSERT_TRUE(std::filesystem::exists(path("halves/journal.jsonl"))) << "it was killed in its middle";
  const Call again = mimicx(command + path("halves"));
  EXPECT_EQ(again.status, 0) << again.text;
  EXPECT_EQ(run::results_of(path("halves")), run::results_of(path("whole")));
}

}  // namespace
}  // namespace mimicx::program
