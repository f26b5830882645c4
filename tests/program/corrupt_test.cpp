#include "synth/corrupt.h"

#include <fstream>

#include "core/file.h"
#include "motion/surface_points.h"
#include "program/cli.h"

namespace mimicx::program {
namespace {

TEST(BenchmarkTruth, IsOurBodyAtThirtyFramesOnTheFloor) {
  motion::Clip clip = foreign_clip(60.0);
  import::rotate_world(import::rotation_to_z_up('y'), clip);
  import::shift_world({0.0, 0.0, 0.4}, clip);
  clip.betas[0] = 2.0;  // of SMPL-X: means nothing here
  const motion::Clip truth = synth::benchmark_truth(clip);
  EXPECT_EQ(truth.body_model, "mimicx");
  EXPECT_EQ(truth.fps, 30.0);
  EXPECT_EQ(truth.frames(), 20);
  EXPECT_EQ(truth.betas, (std::array<double, kBetas>{}));
  EXPECT_TRUE(truth.passthrough.empty() && !truth.keypoints);
  const Character body = make_character();
  EXPECT_NEAR(motion::lowest_height(motion::surface_points(body), motion::poses_of(truth)[9]), 0.0, 0.002);
  clip.on_floor = true;
  EXPECT_NEAR(
      motion::lowest_height(motion::surface_points(body), motion::poses_of(synth::benchmark_truth(clip))[9]),
      0.4, 0.05);
}

TEST_F(Cli, CorruptWritesPairsThatEvaluateScores) {
  motion::write_clip(path("ours.npz"), motion::standing_clip(40));
  motion::write_clip(path("foreign.npz"), foreign_clip(60.0));
  const Call call = mimicx("corrupt " + path("ours.npz") + " " + path("foreign.npz") + " --out " + path("b"));
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_TRUE(says(call, "2 motions, each as truth")) << call.text;
  const Call table = mimicx("evaluate --truth " + path("b/truth") + " --motions " + path("b/noisy"));
  EXPECT_EQ(table.status, 0) << table.text;
  EXPECT_TRUE(says(table, "foreign") && says(table, "ours") && says(table, "mean")) << table.text;
  EXPECT_EQ(motion::read_clip(path("b/truth/ours.npz")).trans, motion::standing_clip(40).trans);
}

TEST_F(Cli, CorruptsAFileIndependentlyOfTheOthers) {
  motion::write_clip(path("x.npz"), motion::standing_clip(40));
  motion::write_clip(path("a.npz"), motion::standing_clip(30));
  for (const char* noise : {"independent", "gvhmr"}) {
    const std::string end = std::string(" --camera moving --seed 5 --noise ") + noise + " --out ";
    EXPECT_EQ(mimicx("corrupt " + path("x.npz") + end + path("alone")).status, 0);
    EXPECT_EQ(mimicx("corrupt " + path("a.npz") + " " + path("x.npz") + end + path("both")).status, 0);
    for (const char* file : {"/truth/x.npz", "/noisy/x.npz"})
      EXPECT_EQ(read_file(path("alone") + file), read_file(path("both") + file)) << file;
    EXPECT_NE(motion::read_clip(path("both/noisy/a.npz")).trans[0],
              motion::read_clip(path("both/noisy/x.npz")).trans[0]);
    EXPECT_EQ(mimicx("corrupt " + path("x.npz") + " --camera moving --seed 6 --out " + path("other")).status,
              0);
    EXPECT_NE(read_file(path("other/noisy/x.npz")), read_file(path("alone/noisy/x.npz")));
  }
}

TEST_F(Cli, CorruptLeavesNoTruthInTheNoisyFile) {
  motion::Clip clip = motion::standing_clip(40);
  clip.passthrough.emplace_back("secret", NpyArray::scalar(1.0));
  motion::write_clip(path("x.npz"), clip);
  for (const std::string camera : {"perturbed", "moving"}) {
    EXPECT_EQ(mimicx("corrupt " + path("x.npz") + " --camera " + camera + " --out " + path("b")).status, 0);
    const motion::Clip truth = motion::read_clip(path("b/truth/x.npz")),
                       noisy = motion::read_clip(path("b/noisy/x.npz"));
    EXPECT_FALSE(truth.keypoints);
    ASSERT_TRUE(noisy.keypoints);
    EXPECT_TRUE(noisy.passthrough.empty() && truth.passthrough.empty());
    EXPECT_EQ(noisy.keypoints->extrinsics.count(), camera == "moving" ? 40 : 1);
    std::vector<std::string> members;
    const Npz archive = read_npz(path("b/noisy/x.npz"));
    for (const auto& [name, array] : archive.members()) members.push_back(name);
    std::sort(members.begin(), members.end());
    EXPECT_EQ(members,
              (std::vector<std::string>{"betas", "body_model", "camera_extrinsics", "camera_intrinsics",
                                        "gender", "joint_names", "keypoint_names", "keypoints_2d",
                                        "mocap_framerate", "poses", "trans"}));
    for (int t = 0; t < truth.frames(); ++t) {
      EXPECT_NE(noisy.trans[t], truth.trans[t]);
      for (int b = 0; b < kBodies; ++b) EXPECT_NE(noisy.rotations[t][b], truth.rotations[t][b]);
    }
    for (std::size_t k = 0; k < kBetas; ++k) EXPECT_NE(noisy.betas[k], truth.betas[k]);
  }
}

TEST_F(Cli, CorruptWritesOtherKeypointsOrNone) {
  motion::write_clip(path("x.npz"), motion::standing_clip(20));
  for (const auto& [set, points] : {std::pair("coco17", 17u), std::pair("coco133", 133u)}) {
    EXPECT_EQ(mimicx("corrupt " + path("x.npz") + " --keypoints " + set + " --out " + path(set)).status, 0);
    EXPECT_EQ(motion::read_clip(path(std::string(set) + "/noisy/x.npz")).keypoints->names.size(), points);
  }
  EXPECT_EQ(mimicx("corrupt " + path("x.npz") + " --keypoints none --out " + path("n")).status, 0);
  EXPECT_FALSE(motion::read_clip(path("n/noisy/x.npz")).keypoints);
}

TEST_F(Cli, CorruptNamesSkippedFilesAndContinues) {
  motion::write_clip(path("good.npz"), motion::standing_clip(20));
  motion::write_clip(path("one.npz"), motion::standing_clip(1));
  std::ofstream(path("bad.npz")) << "PK nonsense";
  const Call call = mimicx("corrupt " + path("bad.npz") + " " + path("one.npz") + " " + path("good.npz") +
                           " " + path("none.npz") + " --out " + path("b"));
  EXPECT_EQ(call.status, 1) << call.text;
  for (const char* file : {"bad.npz", "one.npz", "none.npz"})
    EXPECT_TRUE(says(call, path(file) + ": left out: ")) << call.text;
  EXPECT_TRUE(says(call, "expected at least 2 frames, found 1")) << call.text;
  EXPECT_TRUE(says(call, "b: 1 motions")) << call.text;
  EXPECT_TRUE(std::filesystem::exists(path("b/noisy/good.npz")));
}

TEST_F(Cli, CorruptRejectsUnknownNoise) {
  motion::write_clip(path("x.npz"), motion::standing_clip(20));
  const std::string start = "corrupt " + path("x.npz") + " --out " + path("b") + " --noise ";
  const Call unknown = mimicx(start + "mystery");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(says(unknown, "known: independent, gvhmr, vibe")) << unknown.text;
  const Call amplitude = mimicx(start + "stature=0,mystery=1");
  EXPECT_EQ(amplitude.status, 2);
  EXPECT_TRUE(says(amplitude, "unknown amplitude 'mystery'; known: joint_static")) << amplitude.text;
  EXPECT_EQ(mimicx(start + "stature=0,proportions=0").status, 0);
  EXPECT_EQ(motion::read_clip(path("b/noisy/x.npz")).betas, motion::standing_clip(20).betas);
}

}  // namespace
}  // namespace mimicx::program
