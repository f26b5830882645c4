// The built program as a user meets it: exit statuses, messages, files.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/npz.h"
#include "motion/import/bvh.h"
#include "motion/import/motion_file.h"
#include "motion/import/world.h"
#include "physics/mjcf.h"
#include "pipeline/record/run_folder.h"
#include "pipeline/results.h"
#include "pipeline/standing_clip.h"
#include "pipeline/temporary_folder.h"

namespace mimicx {
namespace {

struct Call {
  int status;
  std::string text;  ///< both streams
};

Call mimicx(const std::string& arguments) {
  FILE* pipe = popen((std::string(MIMICX_BINARY) + " " + arguments + " 2>&1").c_str(), "r");
  Call call{-1, {}};
  char buffer[4096];
  while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) call.text.append(buffer, n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) call.status = WEXITSTATUS(status);
  return call;
}

bool says(const Call& call, const std::string& words) { return call.text.find(words) != std::string::npos; }

struct Cli : testing::Test {
  std::string path(const std::string& name) const { return (folder.path / name).string(); }
  TemporaryFolder folder;
};

TEST_F(Cli, HelpIsEverywhere) {
  EXPECT_EQ(mimicx("--help").status, 0);
  for (const char* command : {"plan", "run", "pretrain", "adapt", "imitate", "fit", "cluster", "evaluate",
                              "info", "convert", "audit", "export-mjcf", "synth", "config"}) {
    const Call call = mimicx(std::string(command) + " --help");
    EXPECT_EQ(call.status, 0) << command;
    EXPECT_TRUE(says(call, command)) << call.text;
    EXPECT_TRUE(says(mimicx("--help"), command));
  }
}

TEST_F(Cli, VersionNamesTheInstructionSet) {
  const Call call = mimicx("--version");
  EXPECT_EQ(call.status, 0);
  EXPECT_TRUE(says(call, MIMICX_TARGET)) << call.text;
}

TEST_F(Cli, WrongUsageIsStatusTwo) {
  write_clip(path("a.npz"), standing_clip(20));
  const std::string a = path("a.npz"), out = " --out " + path("out");
  for (const std::string& arguments : {std::string(),
                                       std::string("dance"),
                                       std::string("imitate"),
                                       "imitate" + out,
                                       "imitate " + a + out + " --samples -1",
                                       "imitate " + a + out + " --samples many",
                                       "imitate " + a + out + " --threads 0",
                                       "imitate " + a + out + " --limit-seconds -1",
                                       "imitate " + a + " " + a + out,
                                       "imitate " + a + out + " --frobnicate",
                                       "imitate " + a + out + " --set gamma",
                                       "imitate " + a + out + " --set gamma=2",
                                       "imitate " + a + out + " --set bin_frames=0",
                                       "imitate " + a + out + " --set characters=100",
                                       std::string("plan"),
                                       "plan " + a + out + " --samples 1",
                                       "plan " + a + out + " --set plan_horizon=0",
                                       "plan " + a + out + " --set gamma=0.9",
                                       "adapt " + a + out + " --method dance",
                                       "adapt " + a + out + " --method plan --set gamma=0.9",
                                       "adapt " + a + out + " --method paper --set plan_horizon=5",
                                       "adapt " + a + out + " --switch-penalty 1",
                                       "adapt " + a + out + " --switch-penalty nan",
                                       "adapt " + a + out + " --rescue-reward 1.5",
                                       "adapt " + a + out + " --rescue-reward nan",
                                       "run " + a + out + " --rescue-reward -1",
                                       std::string("evaluate"),
                                       std::string("info"),
                                       "convert " + a,
                                       "convert " + a + " " + path("b.fbx"),
                                       "convert " + a + " " + path("b.npz") + " --rate 25",
                                       "info " + a + " --up w",
                                       "info " + a + " --scale 0",
                                       "info " + a + " --body mine",
                                       "info " + a + " --smplx " + path("none.npz"),
                                       std::string("synth"),
                                       std::string("audit"),
                                       std::string("export-mjcf"),
                                       "export-mjcf " + path("c.xml") + " --betas 6",
                                       "export-mjcf " + path("c.xml") + " --betas 0,0,0,0,0,0,0,0,0,0,0",
                                       "export-mjcf " + path("c.xml") + " --betas 1 --motion " + a,
                                       std::string("cluster"),
                                       "cluster " + a,
                                       "cluster " + a + out + " --radius -1",
                                       "cluster " + a + out + " --clusters 0",
                                       "cluster " + a + out + " --clusters 2",
                                       "cluster " + a + out + " --clusters 1 --radius 2"}) {
    const Call call = mimicx(arguments);
    EXPECT_EQ(call.status, 2) << "mimicx " << arguments << '\n' << call.text;
    EXPECT_FALSE(call.text.empty());
  }
}

TEST_F(Cli, ConfigPrintsTheDefaultsThatHelpNames) {
  const auto json = nlohmann::json::parse(mimicx("config --json").text);
  for (const auto& [command, option, setting] :
       std::vector<std::array<std::string, 3>>{{"imitate", "--samples", "samples"},
                                               {"adapt", "--budget-samples", "samples"},
                                               {"adapt", "--switch-penalty", "switch_penalty"},
                                               {"adapt", "--rescue-reward", "rescue_reward"},
                                               {"adapt", "--seed", "seed"},
                                               {"pretrain small", "--samples", "samples"},
                                               {"pretrain small", "--radius", "cluster_radius"}}) {
    const double value = json.at(command).at(setting);
    const Call help = mimicx(command.substr(0, command.find(' ')) + " --help");
    const std::size_t at = help.text.find(option + " ");
    ASSERT_NE(at, std::string::npos) << command << ' ' << option;
    const std::size_t bracket = help.text.find('[', at);
    EXPECT_EQ(std::stod(help.text.substr(bracket + 1)), value) << command << ' ' << option << help.text;
  }
  const Call table = mimicx("config");
  EXPECT_EQ(table.status, 0);
  EXPECT_TRUE(says(table, "pretrain paper") && says(table, "switch_penalty")) << table.text;
}

TEST_F(Cli, TheSelectorsNumbersAreRecorded) {
  write_clip(path("a.npz"), standing_clip(20));
  mimicx("adapt " + path("a.npz") +
         " --budget-samples 0 --threads 1 --switch-penalty -0.5 --rescue-reward 0.25" + " --out " +
         path("out"));
  const auto manifest = nlohmann::json::parse(read_file(path("out/manifest.json")));
  EXPECT_EQ(manifest["run"]["settings"]["switch_penalty"], -0.5);
  EXPECT_EQ(manifest["run"]["settings"]["rescue_reward"], 0.25);
}

TEST_F(Cli, AnUnreadableFileIsStatusOneAndNamed) {
  std::ofstream(path("bad.npz")) << "PK nonsense";
  for (const std::string& arguments : {"info " + path("bad.npz"), "info " + path("none.npz"),
                                       "convert " + path("bad.npz") + " " + path("o.npz"),
                                       "imitate " + path("bad.npz") + " --out " + path("out")}) {
    const Call call = mimicx(arguments);
    EXPECT_EQ(call.status, 1) << arguments << '\n' << call.text;
    EXPECT_TRUE(says(call, ".npz")) << call.text;
  }
}

TEST_F(Cli, EvaluateSaysWhatItCouldNotScore) {
  for (const char* part : {"truth", "a", "b", "c", "d"}) std::filesystem::create_directories(path(part));
  for (const char* file : {"truth/x.npz", "a/x.npz", "b/x.npz", "a/y.npz", "d/y.npz"})
    write_clip(path(file), standing_clip(20));
  std::ofstream(path("c/x.npz")) << "no archive";
  const std::string truth = "evaluate --truth " + path("truth") + " --motions ";
  EXPECT_EQ(mimicx(truth + path("b")).status, 0);
  const Call foreign = mimicx(truth + path("a"));
  EXPECT_EQ(foreign.status, 1);
  EXPECT_TRUE(says(foreign, "the truth of y")) << foreign.text;
  EXPECT_EQ(mimicx(truth + path("b") + " " + path("b")).status, 0);
  const Call broken = mimicx(truth + path("b") + " " + path("c"));
  EXPECT_EQ(broken.status, 1);
  EXPECT_TRUE(says(broken, "c/x: ")) << broken.text;
  const Call apart = mimicx(truth + path("b") + " " + path("d"));
  EXPECT_EQ(apart.status, 1);
  EXPECT_TRUE(says(apart, "no motion is in all")) << apart.text;
}

TEST_F(Cli, AnInterruptLeavesACheckpointAndTheSameCommandEndsWithTheSameBytes) {
  write_clip(path("a.npz"), standing_clip(20));
  const std::string settings =
      " --samples 40960 --set characters=64 --set group_size=16 --set horizon=8"
      " --set minibatch=256 --set hidden_1=16 --set hidden_2=16 --out ";
  const std::string command = "imitate " + path("a.npz") + settings;
  ASSERT_EQ(mimicx(command + path("whole")).status, 0);
  // TERM: shells hide INT from what they start in the background. The handler is there before the manifest.
  const Call interrupted =
      mimicx(command + path("halves") + " 2>&1 & while [ ! -e " + path("halves/manifest.json") +
             " ]; do sleep 0.01; done; kill -TERM $!; wait $!");
  EXPECT_EQ(interrupted.status, 130) << interrupted.text;
  EXPECT_TRUE(says(interrupted, "interrupted; the same command continues")) << interrupted.text;
  ASSERT_EQ(mimicx(command + path("halves")).status, 0);
  EXPECT_EQ(results_of(path("halves")), results_of(path("whole")));
}

TEST_F(Cli, APlanIsInterruptedBetweenWindowsAndTheSameCommandEndsWithTheSameBytes) {
  write_clip(path("a.npz"), standing_clip(90));
  const std::string command = "plan " + path("a.npz") + " --out ";
  ASSERT_EQ(mimicx(command + path("whole")).status, 0);
  const Call interrupted =
      mimicx(command + path("halves") + " 2>&1 & while [ ! -e " + path("halves/manifest.json") +
             " ]; do sleep 0.01; done; kill -TERM $!; wait $!");
  EXPECT_EQ(interrupted.status, 130) << interrupted.text;
  EXPECT_TRUE(says(interrupted, "interrupted; the same command continues")) << interrupted.text;
  EXPECT_FALSE(std::filesystem::exists(path("halves/motions/a.npz")));
  ASSERT_EQ(mimicx(command + path("halves")).status, 0);
  EXPECT_EQ(results_of(path("halves")), results_of(path("whole")));
}

TEST_F(Cli, AdaptPlansAndTrainsNothingWhereThePlanSucceeds) {
  write_clip(path("a.npz"), standing_clip(20));
  const Call call = mimicx("adapt " + path("a.npz"));
  EXPECT_EQ(call.status, 0) << call.text;
  const auto manifest = nlohmann::json::parse(read_file(path("a.mimicx/manifest.json")));
  EXPECT_EQ(manifest["run"]["method"], "auto");
  EXPECT_EQ(manifest["sequences"][0]["method"], "plan");
  EXPECT_EQ(manifest["sequences"][0]["samples"], 0);
  EXPECT_TRUE(std::filesystem::exists(path("a.mimicx/plans/a.npz")));
  EXPECT_TRUE(std::filesystem::exists(path("a.clean.npz")));
  EXPECT_FALSE(std::filesystem::exists(path("a.mimicx/training")));
  EXPECT_EQ(mimicx("adapt --method paper " + path("a.npz")).status, 1) << "a folder of another method";
}

TEST_F(Cli, InfoSaysWhatTheFileHolds) {
  write_clip(path("a.npz"), standing_clip(20));
  const Call call = mimicx("info " + path("a.npz"));
  EXPECT_EQ(call.status, 0);
  EXPECT_TRUE(says(call, "20 at 30 fps")) << call.text;
  EXPECT_TRUE(says(call, "mimicx")) << call.text;
}

TEST_F(Cli, InfoOfOneFrameSaysWhatItHoldsAndThatItIsTooShort) {
  Clip clip = standing_clip(1);
  clip.keypoints.emplace();
  clip.keypoints->names = {"nose", "left_hip", "right_hip"};
  clip.keypoints->uvc.assign(1, std::vector<Vector3d>(3, Vector3d::Ones()));
  clip.keypoints->extrinsics = {Eigen::Matrix4d::Identity()};
  write_clip(path("one.npz"), clip);
  const Call call = mimicx("info " + path("one.npz"));
  EXPECT_EQ(call.status, 1);
  EXPECT_TRUE(says(call, "3 per frame, 2 of them joints of the body, static camera")) << call.text;
  EXPECT_TRUE(says(call, path("one.npz") + ": expected at least 2 frames to prepare it, found 1"))
      << call.text;
}

TEST_F(Cli, ConvertKeepsTheMotion) {
  const Clip clip = standing_clip(20);
  write_clip(path("a.npz"), clip);
  EXPECT_EQ(mimicx("convert " + path("a.npz") + " " + path("new/b.npz")).status, 0);
  const Clip back = read_clip(path("new/b.npz"));
  EXPECT_EQ(back.rotations, clip.rotations);
  EXPECT_EQ(back.trans, clip.trans);
}

/// A standing motion as another program wrote it: SMPL-X, y up, at `fps`.
Clip foreign_clip(double fps) {
  Clip clip = standing_clip(40);
  clip.body_model = "smplx";
  clip.fps = fps;
  rotate_world(rotation_to_z_up('y').conjugate(), clip);
  std::vector<double> hands(40 * 90, 0.25);
  clip.passthrough.emplace_back("pose_hand", NpyArray::from_double({40, 90}, hands.data()));
  return clip;
}

TEST_F(Cli, ConvertChoosesTheFormatBySuffixAndSaysWhatItDecided) {
  write_clip(path("a.npz"), foreign_clip(60.0));
  const Call call = mimicx("convert " + path("a.npz") + " " + path("b.npy") + " --rate 30");
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_TRUE(says(call, "a.npz: up axis: y, turned to z")) << call.text;
  const Call info = mimicx("info " + path("b.npy"));
  EXPECT_TRUE(says(info, "Motion-X") && says(info, "20 at 30 fps")) << info.text;
  EXPECT_EQ(mimicx("convert " + path("a.npz") + " " + path("c.npy")).status, 1) << "60 fps do not fit";
}

TEST_F(Cli, WithoutAFolderTheCleanMotionStandsBesideItsInput) {
  write_clip(path("a.npz"), foreign_clip(60.0));
  // Untrained, the standing policy may fail; what is tested is where things go.
  const std::string command = "imitate " + path("a.npz") + " --samples 1 --threads 1 --rate input";
  const Call call = mimicx(command);
  ASSERT_TRUE(std::filesystem::exists(path("a.mimicx/manifest.json"))) << call.text;
  const auto manifest = nlohmann::json::parse(read_file(path("a.mimicx/manifest.json")));
  const auto& entry = manifest["sequences"][0];
  EXPECT_NE(entry["decisions"].dump().find("up axis: y"), std::string::npos) << entry["decisions"];
  ASSERT_EQ(std::filesystem::exists(path("a.clean.npz")), entry["status"] == "ok") << call.text;
  if (entry["status"] != "ok") GTEST_SKIP() << "the untrained policy fell";
  const Clip input = read_clip(path("a.npz")), clean = read_clip(path("a.clean.npz"));
  EXPECT_EQ(clean.body_model, "smplx");
  EXPECT_EQ(clean.fps, 60.0);
  EXPECT_EQ(clean.frames(), input.frames());
  EXPECT_EQ(read_npz(path("a.clean.npz")).at("pose_hand").bytes, input.passthrough[0].second.bytes);
  EXPECT_EQ(mimicx(command).status, 0) << "the same command keeps what is there";
  // A folder stands for its inputs, not for clean copies.
  EXPECT_FALSE(
      says(mimicx("cluster " + folder.path.string() + " --clusters 1 --out " + path("c.json")), "clean"));
}

TEST_F(Cli, ABvhComesBackAsACleanBvh) {
  write_bvh(path("clip.bvh"), standing_clip(40));
  const Call call = mimicx("imitate " + path("clip.bvh") + " --samples 1 --threads 1");
  ASSERT_TRUE(std::filesystem::exists(path("clip.mimicx/motions/clip.npz"))) << call.text;
  EXPECT_EQ(call.status, 0);
  const Clip clean = read_motion(path("clip.clean.bvh"));
  EXPECT_EQ(clean.frames(), 40);
  EXPECT_EQ(clean.fps, 30.0);
  const auto simulated = poses_of(read_clip(path("clip.mimicx/motions/clip.npz"))), back = poses_of(clean);
  for (std::size_t j = 0; j < kBodies; ++j)
    EXPECT_LT((simulated[20].p_WB[j] - back[20].p_WB[j]).norm(), 1e-6) << j;
}

TEST_F(Cli, ARunOfOtherReadingIsRefused) {
  write_clip(path("a.npz"), standing_clip(20));
  const std::string command = "imitate " + path("a.npz") + " --samples 0 --threads 1 --out " + path("out");
  mimicx(command);
  EXPECT_EQ(mimicx(command + " --fps 25").status, 2);
}

TEST_F(Cli, AuditFailsLoudlyDoesTheRestAndWritesJson) {
  Clip clip = standing_clip(20);
  for (Vector3d& p : clip.trans) p.z() += 0.2;  // hovers
  write_clip(path("hover.npz"), clip);
  std::ofstream(path("bad.npz")) << "PK nonsense";
  const Call call =
      mimicx("audit " + path("bad.npz") + " " + path("hover.npz") + " --json " + path("audit.json"));
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, "bad.npz: left out: ")) << call.text;
  EXPECT_TRUE(says(call, "hover.npz: mean unexplained root force 687 N, 100 % of the weight")) << call.text;
  EXPECT_TRUE(says(call, "no point within 1 cm of the floor in 100 % of the frames")) << call.text;
  const auto json = nlohmann::json::parse(read_file(path("audit.json")));
  const auto& audit = json["files"][0]["audits"][0];
  EXPECT_EQ(audit["passed"], false);
  EXPECT_EQ(audit["rows"]["root_force_N"].size(), 18u);
  EXPECT_NEAR(audit["summary"]["root_force_mean_N"].get<double>(), 9.81 * 70.0, 1.0);
}

TEST_F(Cli, ExportMjcfWritesTheShapeOfTheNumbersOrOfTheMotion) {
  Clip clip = standing_clip(20);
  clip.betas[0] = 2.0;
  clip.betas[3] = -1.5;
  write_clip(path("a.npz"), clip);
  EXPECT_EQ(mimicx("export-mjcf --betas 2,0,0,-1.5 " + path("b.xml")).status, 0);
  EXPECT_EQ(mimicx("export-mjcf --motion " + path("a.npz") + " " + path("m.xml")).status, 0);
  EXPECT_EQ(mimicx("export-mjcf " + path("new/standard.xml")).status, 0);
  EXPECT_EQ(read_file(path("b.xml")), to_mjcf(make_character(clip.betas), {}));
  EXPECT_EQ(read_file(path("m.xml")), read_file(path("b.xml")));
  EXPECT_EQ(read_file(path("new/standard.xml")), to_mjcf(make_character(), {}));
}

TEST_F(Cli, ExportMjcfTakesTheBodyThatConvertWritesQposFor) {
  // A body of known joints, as a licensed model gives it, and one that is fitted to a skeleton.
  Clip clip = standing_clip(20);
  clip.body_model = "smplx";
  clip.rest_joints.emplace();
  const Character standard = make_character();
  for (std::size_t b = 0; b < kBodies; ++b)
    (*clip.rest_joints)[b] =
        b == 0 ? rest_pelvis("smplx")
               : Vector3d((*clip.rest_joints)[kParents[b]] + 1.1 * standard.joint_offset[b]);
  write_clip(path("a.npz"), clip);
  EXPECT_EQ(mimicx("export-mjcf --motion " + path("a.npz") + " " + path("a.xml")).status, 0);
  EXPECT_EQ(read_file(path("a.xml")), to_mjcf(character_of(clip), {}));
  EXPECT_NE(read_file(path("a.xml")), to_mjcf(standard, {}));

  Clip shaped = standing_clip(20);
  shaped.betas[0] = 1.5;
  write_bvh(path("b.bvh"), shaped);
  const std::string export_b = "export-mjcf --motion " + path("b.bvh") + " " + path("b.xml");
  EXPECT_EQ(mimicx(export_b).status, 0);
  EXPECT_EQ(read_file(path("b.xml")), to_mjcf(character_of(read_motion(path("b.bvh"))), {}));
  EXPECT_EQ(mimicx(export_b + " --body standard").status, 0);
  EXPECT_EQ(read_file(path("b.xml")), to_mjcf(standard, {}));
}

TEST_F(Cli, ImitateDoesTheRestWhenOneInputFails) {
  write_clip(path("a.npz"), standing_clip(20));
  const std::string command =
      "imitate " + path("none.npz") + " " + path("a.npz") + " --samples 1 --threads 1 --out " + path("out");
  const Call call = mimicx(command);
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(std::filesystem::exists(path("out/motions/a.npz"))) << call.text;
  const auto manifest = nlohmann::json::parse(read_file(path("out/manifest.json")));
  ASSERT_EQ(manifest["sequences"].size(), 2u);
  EXPECT_EQ(manifest["sequences"][0]["status"], "failed");
  EXPECT_EQ(manifest["sequences"][1]["input"], path("a.npz"));
  EXPECT_EQ(mimicx(command + " --seed 2").status, 2) << "a folder of another seed";
}

TEST_F(Cli, WhatCannotBeLookedAtDoesNotStopTheOthers) {
  write_clip(path("a.npz"), standing_clip(20));
  write_clip(path("one.npz"), standing_clip(1));
  std::filesystem::create_symlink(path("loop.npz"), path("loop.npz"));
  std::filesystem::create_directory(path("empty"));
  std::filesystem::create_directory(path("locked"));
  std::filesystem::permissions(path("locked"), std::filesystem::perms::none);
  const Call call =
      mimicx("imitate " + path("empty") + " " + path("loop.npz") + " " + path("locked/b.npz") + " " +
             path("one.npz") + " " + path("a.npz") + " --samples 1 --threads 1 --out " + path("out"));
  std::filesystem::permissions(path("locked"), std::filesystem::perms::owner_all);
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, path("empty") + ": expected a file, found a folder")) << call.text;
  EXPECT_TRUE(says(call, path("loop.npz") + ": expected a readable file, found Too many")) << call.text;
  EXPECT_TRUE(says(call, path("one.npz") + ": expected at least 2 frames, found 1")) << call.text;
  EXPECT_TRUE(std::filesystem::exists(path("out/motions/a.npz"))) << call.text;
}

TEST_F(Cli, AFolderThatCannotBeMadeDoesNotStopTheOthers) {
  write_clip(path("a.npz"), standing_clip(20));
  write_clip(path("b.npz"), standing_clip(20));
  std::ofstream(path("a.mimicx")) << "in the way";
  const Call call = mimicx("imitate " + path("a.npz") + " " + path("b.npz") + " --samples 1 --threads 1");
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, path("a.npz") + ": left out: ")) << call.text;
  EXPECT_TRUE(std::filesystem::exists(path("b.clean.npz"))) << call.text;
}

TEST_F(Cli, ClusterTakesFilesAndFoldersInAnyOrderAndLeavesOutWhatFails) {
  std::filesystem::create_directory(path("more"));
  write_clip(path("a.npz"), standing_clip(20));
  write_clip(path("more/a.npz"), standing_clip(40));
  write_clip(path("more/b.npz"), standing_clip(60));
  std::ofstream(path("more/bad.npz")) << "PK nonsense";
  const std::string end = " --clusters 2 --out ";
  const Call call = mimicx("cluster " + path("a.npz") + " " + path("more") + end + path("c.json"));
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, "more/bad.npz: left out")) << call.text;
  for (const char* line : {"3 motions", "cluster 0: ", "cluster 1: ", "- a\n", "- a-2\n", "- b\n"})
    EXPECT_TRUE(says(call, line)) << line << call.text;
  const std::string bytes = read_file(path("c.json"));
  std::filesystem::remove(path("more/bad.npz"));
  const Call other = mimicx("cluster " + path("more") + " " + path("a.npz") + end + path("d.json"));
  EXPECT_EQ(other.status, 0) << other.text;
  EXPECT_EQ(read_file(path("d.json")), bytes);
}

}  // namespace
}  // namespace mimicx
