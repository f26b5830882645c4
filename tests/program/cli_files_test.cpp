// The subcommands that look at files or write others.
#include <fstream>

#include "core/file.h"
#include "core/npz/npz.h"
#include "import/bvh.h"
#include "import/bvh_write.h"
#include "import/motion_file.h"
#include "physics/mjcf.h"
#include "program/cli.h"
#include "record/json.h"
#include "run/preparation.h"

namespace mimicx::program {
namespace {

TEST_F(Cli, EvaluateListsUnscoredMotions) {
  for (const char* part : {"truth", "a", "b", "c", "d"}) std::filesystem::create_directories(path(part));
  for (const char* file : {"truth/x.npz", "a/x.npz", "b/x.npz", "a/y.npz", "d/y.npz"})
    motion::write_clip(path(file), motion::standing_clip(20));
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

TEST_F(Cli, InfoListsTheFilesContents) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const Call call = mimicx("info " + path("a.npz"));
  EXPECT_EQ(call.status, 0);
  EXPECT_TRUE(says(call, "20 at 30 fps")) << call.text;
  EXPECT_TRUE(says(call, "mimicx")) << call.text;
}

TEST_F(Cli, InfoDescribesThePreparationOfARun) {
  const std::filesystem::path noisy =
      std::filesystem::path(MIMICX_SOURCE_DIR) / "data/synthetic/test/noisy/stand_1.npz";
  const run::PreparedMotion prepared = run::prepare_motion(noisy, {}, {.fit = true});
  ASSERT_EQ(mimicx("info " + noisy.string() + " --json " + path("info.json")).status, 0);
  const record::Json told = record::Json::parse(read_file(path("info.json"))).at("prepared");
  for (const char* name : {"floor_shift_mm", "change_mean_mm", "change_max_mm", "foot_level_deg"})
    EXPECT_NEAR(told.at(name).get<double>(), value_of(prepared.preparation_values, name), 1e-6) << name;
}

TEST_F(Cli, ResultsGoIntoNewFolders) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  for (const std::string& command :
       {"info " + path("a.npz") + " --json ", "scene " + path("a.npz") + " --out ",
        "cluster " + path("a.npz") + " --out "}) {
    const std::string file = path("new" + std::to_string(command.size()) + "/folder/x.json");
    EXPECT_EQ(mimicx(command + file).status, 0) << command;
    EXPECT_TRUE(std::filesystem::exists(file)) << command;
  }
}

TEST_F(Cli, AMissingFileLeavesNoFolderBehind) {
  const Call call = mimicx("plan " + path("nothere.npz"));
  EXPECT_EQ(call.status, 1);
  EXPECT_TRUE(says(call, path("nothere.npz") + ": left out: expected a readable file, found none"))
      << call.text;
  EXPECT_FALSE(std::filesystem::exists(path("nothere.mimicx")));
}

TEST_F(Cli, InfoTellsOfAMotionOfOneFrameAllButItsPreparation) {
  motion::Clip clip = motion::standing_clip(1);
  clip.keypoints.emplace();
  clip.keypoints->names = {"nose", "left_hip", "right_hip"};
  clip.keypoints->uvc.assign(1, std::vector<Vector3d>(3, Vector3d::Ones()));
  clip.keypoints->extrinsics = {Eigen::Matrix4d::Identity()};
  motion::write_clip(path("one.npz"), clip);
  const Call call = mimicx("info " + path("one.npz") + " --json " + path("one.json"));
  EXPECT_EQ(call.status, 0);
  EXPECT_TRUE(says(call, "3 per frame, 2 of them with a place on the body, static camera")) << call.text;
  EXPECT_TRUE(says(call, path("one.npz") + ": expected at least 2 frames to prepare it, found 1"))
      << call.text;
  const record::Json told = record::Json::parse(read_file(path("one.json")));
  EXPECT_EQ(told.at("frames").get<int>(), 1);
  EXPECT_FALSE(told.contains("prepared"));
}

TEST_F(Cli, ConvertKeepsTheMotion) {
  const motion::Clip clip = motion::standing_clip(20);
  motion::write_clip(path("a.npz"), clip);
  EXPECT_EQ(mimicx("convert " + path("a.npz") + " " + path("new/b.npz")).status, 0);
  const motion::Clip back = motion::read_clip(path("new/b.npz"));
  EXPECT_EQ(back.rotations, clip.rotations);
  EXPECT_EQ(back.trans, clip.trans);
}

TEST_F(Cli, ConvertSaysWhatTheFormatCannotHold) {
  motion::Clip clip = motion::standing_clip(20);
  motion::write_clip(path("standard.npz"), clip);
  clip.betas[0] = 1.5;
  motion::write_clip(path("tall.npz"), clip);
  EXPECT_TRUE(says(mimicx("convert " + path("tall.npz") + " " + path("a.npy")), "no place for the body"));
  EXPECT_FALSE(says(mimicx("convert " + path("tall.npz") + " " + path("a.bvh")), "no place for the body"));
  EXPECT_FALSE(
      says(mimicx("convert " + path("standard.npz") + " " + path("b.npy")), "no place for the body"));
  for (const char* option : {"--arrows", "--skin shapes"}) {
    const Call call = mimicx("convert " + path("tall.npz") + " " + path("c.bvh") + " " + option);
    EXPECT_EQ(call.status, 2);
    EXPECT_TRUE(says(call, "expected OUT to be a .glb, found")) << call.text;
    EXPECT_FALSE(std::filesystem::exists(path("c.bvh")));
  }
}

TEST_F(Cli, SceneIsReadKeptLearntOnAndRefusedWhereTheFloorMustBeFlat) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  write_file_atomically(path("box.json"),
                        R"({"plates": [{"centre": [0, 2], "half_extents": [0.5, 0.5], "height": 0.3}]})");
  write_file_atomically(path("bad.json"), R"({"plates": [{"centre": [0, 2], "height": 0.3}]})");
  const Call call = mimicx("convert " + path("a.npz") + " " + path("b.npz") + " --scene " + path("box.json"));
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_TRUE(says(call, "scene: 1 plate up to 0.3 m")) << call.text;
  EXPECT_EQ(motion::read_clip(path("b.npz")).scene, (Scene{{{{0, 2}, 0.0, {0.5, 0.5}, 0.3}}}));
  EXPECT_TRUE(says(mimicx("convert " + path("b.npz") + " " + path("c.bvh")), "no place for the scene"));
  const Call bad = mimicx("convert " + path("a.npz") + " " + path("d.npz") + " --scene " + path("bad.json"));
  EXPECT_NE(bad.status, 0);
  EXPECT_TRUE(says(bad, "bad.json: plate 1: expected")) << bad.text;
  EXPECT_FALSE(std::filesystem::exists(path("d.npz")));
  const Call corrupt = mimicx("corrupt " + path("b.npz") + " --out " + path("e"));
  EXPECT_TRUE(corrupt.status != 0 && says(corrupt, "expected a flat floor")) << corrupt.text;
  const Call imitate = mimicx("imitate " + path("b.npz") + " --samples 1 --out " + path("f"));
  EXPECT_EQ(imitate.status, 0) << imitate.text;
  EXPECT_EQ(motion::read_clip(path("f/motions/b.npz")).scene, motion::read_clip(path("b.npz")).scene);
}

/// Who sits where no seat is told gets a hint, and --scene auto puts one there.
TEST_F(Cli, SeatIsFoundToldAndPlannedOnWhereAutoIsAsked) {
  motion::Clip clip = motion::read_clip(std::filesystem::path(MIMICX_SOURCE_DIR) /
                                        "data/synthetic/scenes/truth/sit_down_1.npz");
  clip.scene = {};
  clip.rotations.erase(clip.rotations.begin(), clip.rotations.begin() + 105);
  clip.trans.erase(clip.trans.begin(), clip.trans.begin() + 105);
  clip.rotations.resize(35), clip.trans.resize(35);
  motion::write_clip(path("a.npz"), clip);
  const Call found = mimicx("scene " + path("a.npz") + " --out " + path("a.json"));
  EXPECT_TRUE(says(found, "a seat of 0.3")) << found.text;
  const Call flat = mimicx("plan " + path("a.npz") + " --limit-seconds 1e-9 --out " + path("flat"));
  EXPECT_TRUE(says(flat, "looks like steps or a seat (a seat of 0.3")) << flat.text;
  EXPECT_TRUE(says(flat, "): try --scene auto")) << flat.text;
  EXPECT_FALSE(says(flat, "nothing comes near")) << flat.text;
  write_file_atomically(path("far.json"),
                        R"({"plates": [{"centre": [40, 20], "half_extents": [0.3, 0.3], "height": 0.37}]})");
  EXPECT_TRUE(says(mimicx("plan " + path("a.npz") + " --limit-seconds 1e-9 --out " + path("far") +
                          " --scene " + path("far.json")),
                   "nothing comes near the scene"));
  for (const std::string& command :
       {std::string("info "), "evaluate --truth " + path("a.npz") + " --motions "})
    EXPECT_TRUE(says(mimicx(command + path("a.npz") + " --scene " + path("far.json")),
                     "nothing comes near the scene"))
        << command;
  const Call on_seat = mimicx("plan " + path("a.npz") + " --scene auto --out " + path("seated"));
  EXPECT_EQ(on_seat.status, 0) << on_seat.text;
  EXPECT_TRUE(says(on_seat, "scene: a seat of 0.3")) << on_seat.text;
  EXPECT_FALSE(says(on_seat, "nothing comes near")) << on_seat.text;
  EXPECT_EQ(motion::read_clip(path("seated/motions/a.npz")).scene.plates.size(), 1u);
  const Call own = mimicx("scene " + path("seated/motions/a.npz"));
  EXPECT_TRUE(says(own, "a plate of the file: 0.")) << own.text;
  const Call other = mimicx("audit " + path("seated/motions/a.npz") + " --scene " + path("far.json"));
  EXPECT_TRUE(other.status == 1 && says(other, "forces were made on its own scene")) << other.text;
  EXPECT_TRUE(says(mimicx("audit --poses " + path("a.npz") + " --scene auto"), "--scene: expected a file"));
  EXPECT_FALSE(says(mimicx("plan " + path("a.npz") + " --quiet --limit-seconds 1e-9 --out " + path("quiet")),
                    "looks like"));
}

TEST_F(Cli, ConvertLeavesForcesOutThatNoLongerBelongToTheMotion) {
  motion::write_clip(path("a.npz"), motion::standing_clip(12));
  ASSERT_EQ(mimicx("plan " + path("a.npz") + " --no-fit --out " + path("run")).status, 0);
  const std::string planned = path("run/motions/a.npz");
  const Call same = mimicx("convert " + planned + " " + path("same.npz"));
  EXPECT_FALSE(says(same, "forces")) << same.text;
  EXPECT_TRUE(read_npz(path("same.npz")).has("ground_wrenches"));
  for (const std::string option : {"--mass 90", "--height 1.9"}) {
    const Call call = mimicx("convert " + planned + " " + path("other.npz") + " --force " + option);
    EXPECT_EQ(call.status, 0) << call.text;
    EXPECT_TRUE(says(call, "without its forces")) << call.text;
    for (const char* name : {"ground_wrenches", "velocities", "joint_torques", "body_weight"})
      EXPECT_FALSE(read_npz(path("other.npz")).has(name)) << option << ' ' << name;
  }
  for (const std::string option : {"--fps 30", "--fps 60", "--up y", "--scale 0.01", "--body standard"}) {
    const Call call = mimicx("convert " + planned + " " + path("kept.npz") + " --force " + option);
    EXPECT_TRUE(call.status == 0 && !says(call, "without its forces")) << call.text;
    for (const char* name : {"ground_wrenches", "velocities", "joint_torques", "body_weight", "trans"})
      EXPECT_EQ(read_npz(path("kept.npz")).at(name).bytes, read_npz(planned).at(name).bytes)
          << option << name;
    EXPECT_EQ(mimicx("convert " + planned + " " + path("kept.mot") + " " + option).status, 0) << option;
  }
  for (const std::string option : {"--fps 60", "--up y", "--mass 90"}) {
    const Call audit = mimicx("audit " + planned + " " + option);
    EXPECT_TRUE(audit.status == 1 && says(audit, "forces were made with the motion as it is")) << audit.text;
  }
}

TEST_F(Cli, FitWritesTheAxesThatWereAskedForSoThatTheyAreBelieved) {
  motion::write_clip(path("a.npz"), foreign_clip(30.0));  // with z up it lies
  import::ReadConfig z_up;
  z_up.up = 'z';
  const motion::Clip lying = import::read_motion(path("a.npz"), z_up);
  ASSERT_NE(import::read_motion(path("a.npz")).rotations, lying.rotations);
  ASSERT_EQ(mimicx("fit " + path("a.npz") + " --up z --out " + path("fitted")).status, 0);
  EXPECT_EQ(import::read_motion(path("fitted/a.npz")).rotations, lying.rotations);
}

TEST_F(Cli, ConvertChoosesTheFormatBySuffixAndPrintsDecisions) {
  motion::write_clip(path("a.npz"), foreign_clip(60.0));
  const Call call = mimicx("convert " + path("a.npz") + " " + path("b.npy") + " --rate 30");
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_TRUE(says(call, "a.npz: up axis: y, turned to z")) << call.text;
  const Call info = mimicx("info " + path("b.npy"));
  EXPECT_TRUE(says(info, "Motion-X") && says(info, "20 at 30 fps")) << info.text;
  EXPECT_EQ(mimicx("convert " + path("a.npz") + " " + path("c.npy")).status, 1) << "60 fps do not fit";
}

TEST_F(Cli, AuditReportsFailuresContinuesAndWritesJson) {
  motion::Clip clip = motion::standing_clip(20);
  for (Vector3d& p : clip.trans) p.z() += 0.2;  // hovers
  motion::write_clip(path("hover.npz"), clip);
  std::ofstream(path("bad.npz")) << "PK nonsense";
  const Call call =
      mimicx("audit " + path("bad.npz") + " " + path("hover.npz") + " --json " + path("audit.json"));
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, "bad.npz: left out: ")) << call.text;
  EXPECT_TRUE(says(call, "hover.npz: mean unexplained root force 686 N, 100 % of the weight")) << call.text;
  EXPECT_TRUE(says(call, "no point within 1 cm of the floor in 100 % of the frames")) << call.text;
  const auto json = record::Json::parse(read_file(path("audit.json")));
  const auto& audit = json.at("files").at(0).at("audits").at(0);
  EXPECT_FALSE(audit.at("passed").get<bool>());
  EXPECT_EQ(audit.at("rows").at("root_force_N").elements().size(), 18u);
  EXPECT_NEAR(audit.at("summary").at("root_force_mean_N").get<double>(), 9.81 * 70.0, 1.0);
}

TEST_F(Cli, ExportMjcfWritesTheShapeOfTheNumbersOrOfTheMotion) {
  motion::Clip clip = motion::standing_clip(20);
  clip.betas[0] = 2.0;
  clip.betas[3] = -1.5;
  motion::write_clip(path("a.npz"), clip);
  EXPECT_EQ(mimicx("export-mjcf --betas 2,0,0,-1.5 " + path("b.xml")).status, 0);
  EXPECT_EQ(mimicx("export-mjcf --motion " + path("a.npz") + " " + path("m.xml")).status, 0);
  EXPECT_EQ(mimicx("export-mjcf " + path("new/standard.xml")).status, 0);
  EXPECT_EQ(read_file(path("b.xml")), physics::to_mjcf(make_character(clip.betas), {}));
  EXPECT_EQ(read_file(path("m.xml")), read_file(path("b.xml")));
  EXPECT_EQ(read_file(path("new/standard.xml")), physics::to_mjcf(make_character(), {}));
}

TEST_F(Cli, ExportMjcfUsesTheBodyOfConvertsQpos) {
  // A body of known joints, as a licensed model gives it, and one that is fitted to a skeleton.
  motion::Clip clip = motion::standing_clip(20);
  clip.body_model = "smplx";
  clip.rest_joints.emplace();
  const Character standard = make_character();
  for (std::size_t b = 0; b < kBodies; ++b)
    (*clip.rest_joints)[b] =
        b == 0 ? mimicx::rest_pelvis("smplx")
               : Vector3d((*clip.rest_joints)[kParents[b]] + 1.1 * standard.joint_offset[b]);
  motion::write_clip(path("a.npz"), clip);
  EXPECT_EQ(mimicx("export-mjcf --motion " + path("a.npz") + " " + path("a.xml")).status, 0);
  EXPECT_EQ(read_file(path("a.xml")), physics::to_mjcf(motion::character_of(clip), {}));
  EXPECT_NE(read_file(path("a.xml")), physics::to_mjcf(standard, {}));

  motion::Clip shaped = motion::standing_clip(20);
  shaped.betas[0] = 1.5;
  import::write_bvh(path("b.bvh"), shaped);
  const std::string export_b = "export-mjcf --motion " + path("b.bvh") + " " + path("b.xml");
  EXPECT_EQ(mimicx(export_b).status, 0);
  EXPECT_EQ(read_file(path("b.xml")),
            physics::to_mjcf(motion::character_of(import::read_motion(path("b.bvh"))), {}));
  EXPECT_EQ(mimicx(export_b + " --body standard").status, 0);
  EXPECT_EQ(read_file(path("b.xml")), physics::to_mjcf(standard, {}));
}

TEST_F(Cli, ClusterTakesFilesAndFoldersAndSkipsFailures) {
  std::filesystem::create_directory(path("more"));
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  motion::write_clip(path("more/a.npz"), motion::standing_clip(40));
  motion::write_clip(path("more/b.npz"), motion::standing_clip(60));
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
}  // namespace mimicx::program
