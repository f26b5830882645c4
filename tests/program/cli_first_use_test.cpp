// The first quarter of an hour: what a new user is told.
#include <fstream>

#include "core/file.h"
#include "core/npz/npy.h"
#include "core/npz/npz.h"
#include "import/bvh_write.h"
#include "import/motion_file.h"
#include "motion/clip_file.h"
#include "program/cli.h"
#include "record/json.h"
#include "run/results.h"

namespace mimicx::program {
namespace {

/// A body that hovers a metre over a floor that is told: nothing can follow it.
motion::Clip hovering_clip() {
  motion::Clip clip = motion::standing_clip(20);
  for (Vector3d& p : clip.trans) p.z() += 1.0;
  return clip;
}

/// Settings under which a training is a matter of a second.
constexpr const char* kSmall =
    " --threads 1 --set characters=64 --set group_size=16 --set horizon=8 --set minibatch=256"
    " --set hidden_1=16 --set hidden_2=16";

TEST_F(Cli, FailurePrintsItsMotionAndTheNextStep) {
  motion::write_clip(path("a.npz"), hovering_clip());
  const std::string command =
      "plan " + path("a.npz") + " --floor 0 --as-is --set plan_budget=4 --threads 1 --out " + path("run");
  const Call call = mimicx(command);
  ASSERT_EQ(call.status, 1) << call.text;
  EXPECT_NE(first_match(call.text, "fails at frame [0-9]+"), "") << "which frame\n" << call.text;
  EXPECT_TRUE(says(call, " m from its reference")) << "which body\n" << call.text;
  EXPECT_TRUE(says(call, "the body hovers")) << "what it asks for\n" << call.text;
  EXPECT_TRUE(says(call, "rejected motion: " + path("run/rejected/a.npz"))) << call.text;
  EXPECT_TRUE(says(call, "in " + path("run/report.html"))) << call.text;
  EXPECT_TRUE(says(call, "mimicx adapt trains policies where a plan fails")) << call.text;
  EXPECT_TRUE(says(call, "mimicx audit --poses '" + path("run/references/a.npz") + "'")) << call.text;
}

TEST_F(Cli, QuietPrintsOnlyFailures) {
  motion::write_clip(path("good.npz"), motion::standing_clip(30));
  write_file_atomically(path("bad.npz"), "no archive");
  const std::string inputs = "plan " + path("good.npz") + ' ' + path("bad.npz") + " --as-is --threads 1";
  const Call told = mimicx(inputs + " --out " + path("told"));
  ASSERT_EQ(told.status, 1) << told.text;
  EXPECT_TRUE(says(told, "good: ok, ")) << told.text;
  EXPECT_TRUE(says(told, "1 of 2 motions are ok")) << told.text;
  EXPECT_TRUE(says(told, "  failed: bad")) << told.text;
  const Call quiet = mimicx(inputs + " --quiet --out " + path("quiet"));
  EXPECT_EQ(quiet.status, 1);
  EXPECT_TRUE(quiet.text.starts_with("bad: failed, ")) << quiet.text;
  EXPECT_FALSE(says(quiet, "good")) << quiet.text;
}

TEST_F(Cli, ReportsASpentBudgetAndALargerOneContinues) {
  motion::write_clip(path("a.npz"), hovering_clip());
  const std::string command =
      "imitate " + path("a.npz") + " --floor 0 --as-is" + kSmall + " --out " + path("run") + " --samples ";
  const Call first = mimicx(command + "512");
  ASSERT_EQ(first.status, 1) << first.text;
  EXPECT_TRUE(says(first, "the training spent its budget: with a larger --samples than 512")) << first.text;
  const std::string before = read_file(path("run/training/a.csv"));
  const Call more = mimicx(command + "1024");
  EXPECT_EQ(more.status, 1) << more.text;
  EXPECT_TRUE(says(more, "goes on from a training of 512 samples")) << more.text;
  EXPECT_TRUE(read_file(path("run/training/a.csv")).starts_with(before)) << "the same training";
  const auto manifest = record::Json::parse(read_file(path("run/manifest.json")));
  EXPECT_EQ(manifest.at("run").at("samples").get<int>(), 1024);
  EXPECT_EQ(manifest.at("sequences").at(0).at("samples").get<int>(), 1024);
  const auto done = run::results_of(path("run"));
  mimicx(command + "1024");
  EXPECT_EQ(run::results_of(path("run")), done) << "the same budget keeps what is there";
  EXPECT_EQ(mimicx(command + "512").status, 2) << "less is another run";
}

TEST_F(Cli, NamesTheSettingInWhichARunDiffers) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const std::string command = "imitate " + path("a.npz") + " --samples 0 --threads 1 --out " + path("run");
  mimicx(command);
  const Call seed = mimicx(command + " --seed 2");
  EXPECT_EQ(seed.status, 2);
  EXPECT_TRUE(says(seed, "other settings (seed is 1 there, 2 here):")) << seed.text;
  const Call set = mimicx(command + " --set gamma=0.5 --fps 25");
  EXPECT_TRUE(says(set, "(reading is none there, fps=25 here; gamma is 0.92 there, 0.5 here):")) << set.text;
  const std::string options =
      "pretrain " + path("a.npz") + " --samples 1 --threads 1 --no-encoder --out " + path("options");
  EXPECT_EQ(mimicx(options).status, 0);
  const Call other = mimicx(options + " --seed 3");
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(says(other, "(seed is 1 there, 3 here)")) << other.text;
}

TEST_F(Cli, BvhPrintsThreeDecisionsAndAllOnRequest) {
  const std::filesystem::path bvh =
      std::filesystem::path(MIMICX_SHARED_DIR) / "motions" / "bvh" / "strutting_01_000.bvh";
  if (!std::filesystem::exists(bvh)) GTEST_SKIP() << "no " << bvh;
  const std::string command = "convert " + bvh.string() + " " + path("a.npz");
  const Call few = mimicx(command), all = mimicx(command + " --verbose");
  ASSERT_EQ(few.status, 0) << few.text;
  EXPECT_EQ(lines_of(few.text).size(), 3u) << few.text;
  EXPECT_TRUE(says(few, "BVH: 120 frames per second, y up, ")) << few.text;
  EXPECT_TRUE(says(few, " m up to the floor")) << few.text;
  EXPECT_GE(lines_of(all.text).size(), 9u) << all.text;
  EXPECT_TRUE(says(all, "residuals in mm: ") && says(all, "left knee ")) << all.text;
  for (const std::string_view name : kBodyNames)
    EXPECT_TRUE(name.find('_') == std::string_view::npos || !says(all, std::string(name))) << name;
  EXPECT_EQ(mimicx("plan " + bvh.string() + " --limit-seconds 1e-3 --out " + path("run")).status, 1);
  const auto manifest = record::Json::parse(read_file(path("run/manifest.json")));
  EXPECT_GE(manifest.at("sequences").at(0).at("decisions").elements().size(), 9u)
      << "the manifest has all of them";
}

TEST_F(Cli, EvaluateAndAuditTakeFilesOfEveryFormat) {
  const motion::Clip clip = motion::standing_clip(40);
  motion::write_clip(path("truth.npz"), clip);
  import::write_bvh(path("walk.clean.bvh"), clip);
  import::write_motion(path("walk.npy"), clip);
  const Call score = mimicx("evaluate --truth " + path("truth.npz") + " --motions " + path("walk.clean.bvh"));
  EXPECT_EQ(score.status, 0) << score.text;
  EXPECT_NE(first_match(score.text, "walk +0\\.00 +0\\.00"), "") << score.text;
  std::filesystem::create_directories(path("in/sub"));
  std::filesystem::create_directories(path("truths/sub"));
  import::write_bvh(path("in/sub/a.bvh"), clip);
  motion::write_clip(path("truths/sub/a.npz"), clip);
  const Call tree = mimicx("evaluate --truth " + path("truths") + " --motions " + path("in"));
  EXPECT_EQ(tree.status, 0) << tree.text;
  EXPECT_TRUE(says(tree, "sub/a")) << tree.text;
  for (const char* file : {"walk.clean.bvh", "walk.npy", "truth.npz"}) {
    const Call audit = mimicx("audit " + path(file));
    EXPECT_EQ(audit.status, 0) << audit.text;
    EXPECT_TRUE(says(audit, "poses alone")) << audit.text;
  }
}

TEST_F(Cli, EstimatorPickleErrorNamesTheConverter) {
  std::ofstream(path("hmr4d_results.pt")) << "PK\x03\x04 archive/data.pkl";
  std::ofstream(path("wham_output")) << "\x80\x04}.";
  for (const char* file : {"hmr4d_results.pt", "wham_output"})
    for (const char* command : {"info ", "plan --out OUT ", "audit --poses "}) {
      const Call call = mimicx(command + path(file));
      EXPECT_EQ(call.status, 1) << call.text;
      EXPECT_TRUE(says(call, "tools/convert_video_results.py")) << call.text;
    }
  std::filesystem::remove_all("OUT");
}

TEST_F(Cli, JointPositionsGiveACleanNpz) {
  std::vector<double> values;
  for (const BodyPoses& pose : motion::poses_of(motion::standing_clip(20)))
    for (int b = 0; b < kBodies; ++b)
      for (const double x : {pose.p_WB[b].x(), pose.p_WB[b].z(), -pose.p_WB[b].y()}) values.push_back(x);
  write_file_atomically(path("gen.npy"), format_npy(NpyArray::from_double({20, kBodies, 3}, values.data())));
  const Call call = mimicx("plan " + path("gen.npy") + " --threads 1");
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_TRUE(says(call, "joint positions: 20 frames per second (assumed: --fps overrides), y up"))
      << call.text;
  EXPECT_EQ(motion::read_clip(path("gen.clean.npz")).fps, 30.0);
}

TEST_F(Cli, MovesAMotionDownOntoTheFloor) {
  motion::Clip clip = motion::standing_clip(20);
  for (Vector3d& p : clip.trans) p.z() += 10.0;
  motion::write_clip(path("a.npz"), clip);
  const Call call = mimicx("info " + path("a.npz"));
  EXPECT_TRUE(says(call, "moved 10.0")) << call.text;
  EXPECT_TRUE(says(call, " m down to the floor") && !says(call, "moved -")) << call.text;
}

TEST_F(Cli, LibraryMessagesDoNotReachTheUser) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  std::filesystem::create_directories(path("run"));
  std::ofstream(path("text")) << "x";
  std::ofstream(path("bad.npz")) << "PK\x03\x04nonsense";
  std::ofstream(path("bad.npy")) << "\x93NUMPY\x01\x00\x10\x00{'descr': '<f8',";
  std::ofstream(path("bad.bvh")) << "HIERARCHY ROOT";
  std::ofstream(path("bad.txt")) << "{\"Frames\": [[1, ";
  std::ofstream(path("run/manifest.json")) << "{\n \"run\": {\"version\": 3}}";
  std::filesystem::create_directories(path("run2"));
  std::ofstream(path("run2/manifest.json")) << "{\n \"run";
  std::filesystem::create_directories(path("run3"));
  mimicx("imitate " + path("a.npz") + " --samples 0 --threads 1 --out " + path("run3"));
  std::ofstream(path("run3/journal.jsonl")) << "{\"sequence\": 3}\n";
  std::ofstream(path("run3/timing.json")) << "[";
  std::filesystem::create_directories(path("options"));
  std::ofstream(path("options/options.npz")) << "PK";
  const char* foreign =
      "std::|basic_|filesystem error|json|nlohmann|what\\(\\)|terminate|bad_alloc|vector::|stoi|from_chars|"
      "invalid argument|__|CLI::|Eigen|logic_error|out_of_range|map::at|\\.cpp|\\.h:";
  for (const char* line : {"info DIR/bad.npz",
                           "info DIR/bad.npy",
                           "info DIR/bad.bvh",
                           "info DIR/bad.txt",
                           "info DIR/text",
                           "info DIR/none",
                           "info DIR",
                           "info /dev/null",
                           "convert DIR/a.npz DIR/text/x.npz",
                           "convert DIR/a.npz /proc/x.npz",
                           "export-mjcf /proc/x/y.xml",
                           "plan DIR/a.npz --out DIR/text",
                           "plan DIR/a.npz --out /proc/x",
                           "plan DIR/a.npz --out DIR/run",
                           "plan DIR/a.npz --out DIR/run2",
                           "imitate DIR/a.npz --samples 0 --threads 1 --out DIR/run3",
                           "fit DIR/a.npz --out DIR/text",
                           "fit DIR/a.npz --out /proc/x",
                           "corrupt DIR/a.npz --out DIR/text",
                           "synth --kinds wave --out DIR/text",
                           "cluster DIR/a.npz --clusters 1 --out DIR/text/c.json",
                           "cluster DIR/a.npz --clusters 9 --out DIR/c.json",
                           "evaluate --truth DIR/none --motions DIR/a.npz",
                           "evaluate --truth DIR/a.npz --motions DIR/text",
                           "evaluate --truth DIR/a.npz --motions DIR/a.npz --json /proc/x",
                           "audit DIR/text",
                           "audit --poses DIR/text --csv /proc/x",
                           "adapt DIR/a.npz --options DIR/options",
                           "adapt DIR/a.npz --options DIR/text",
                           "pretrain DIR/text --out DIR/o1",
                           "pretrain DIR/a.npz --out DIR/run2",
                           "plan DIR/a.npz --set plan_horizon=1e300",
                           "plan DIR/a.npz --joint-map DIR/text --out DIR/o2",
                           "info DIR/bad.bvh --joint-map DIR/a.npz",
                           "run DIR/a.npz --out /proc/x"}) {
    const std::string arguments = replaced(line, "DIR", folder.path.string());
    const Call call = mimicx(arguments);
    EXPECT_TRUE(call.status == 1 || call.status == 2 || call.status == 0) << arguments << ": " << call.status;
    std::string said = call.text;  // names of files apart
    for (std::size_t at; (at = said.find(folder.path.string())) != std::string::npos;)
      said.erase(at, said.find_first_of(": \n", at + folder.path.string().size()) - at);
    EXPECT_EQ(first_match(said, foreign), "") << arguments << '\n' << call.text;
  }
}

}  // namespace
}  // namespace mimicx::program
