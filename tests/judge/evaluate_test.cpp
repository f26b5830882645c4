#include "judge/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "core/temporary_folder.h"
#include "files/archive_members.h"
#include "motion/clip_file.h"
#include "motion/resample.h"
#include "motion/standing_clip.h"
#include "record/json.h"

namespace mimicx::judge {
namespace {

struct Evaluate : testing::Test {
  void SetUp() override {
    std::filesystem::create_directory(truth);
    std::filesystem::create_directory(motions);
  }
  /// A truth and a motion that is the truth moved by `metres` to the side.
  void add_pair(const std::string& name, double metres) const {
    motion::Clip clip = motion::standing_clip(20);
    motion::write_clip(truth / (name + ".npz"), clip);
    for (auto& t : clip.trans) t.x() += metres;
    motion::write_clip(motions / (name + ".npz"), clip);
  }
  double metric(const EvaluatedMotion& m, const std::string& name) const {
    for (const auto& d : motion::metric_definitions())
      if (name == d.name) return (m.metrics.*d.value).value;
    throw std::invalid_argument(name);
  }

  TemporaryFolder folder;
  std::filesystem::path truth = folder.path / "truth", motions = folder.path / "motions";
};

TEST_F(Evaluate, ShiftedMotionScoresItsShift) {
  add_pair("a", 0.030);
  const Evaluation e = evaluate_folders(truth, motions);
  ASSERT_EQ(e.motions.size(), 1u);
  ASSERT_TRUE(e.motions[0].ok) << e.motions[0].reason;
  EXPECT_NEAR(metric(e.motions[0], "MRPE"), 30.0, 1e-6);
  EXPECT_NEAR(metric(e.motions[0], "gMPJPE"), 30.0, 1e-6);
  EXPECT_NEAR(metric(e.motions[0], "MPJPE"), 0.0, 1e-6);
}

// A fit moves the scene with the motion: on a box of 0.3 m both stand, here and 3 cm farther.
TEST_F(Evaluate, EachMotionStandsOnItsOwnScene) {
  motion::Clip clip = motion::standing_clip(20);
  clip.scene.plates.push_back({.half_extents = {0.5, 0.5}, .height = 0.3});
  for (auto& t : clip.trans) t.z() += 0.3;
  motion::write_clip(truth / "box.npz", clip);
  for (auto& t : clip.trans) t.x() += 0.03;
  clip.scene.plates[0].centre.x() += 0.03;
  motion::write_clip(motions / "box.npz", clip);
  const EvaluatedMotion box = evaluate_folders(truth, motions).motions.at(0);
  ASSERT_TRUE(box.ok) << box.reason;
  EXPECT_NEAR(metric(box, "MRPE"), 30.0, 1e-6);
  EXPECT_LT(metric(box, "GP"), 1.0);
  EXPECT_LT(metric(box, "Float"), 1.0);
}

// A slide of 10 mm per frame at 30 fps is one of 2.5 mm at 120.
// Forces belong to the body that was simulated: stature and mass are the truth's.
TEST_F(Evaluate, MotionsWithForcesKeepTheirBody) {
  add_pair("a", 0.0);
  motion::Clip clip = motion::standing_clip(20);
  const files::Members members = {
      {"ground_wrenches", files::wrenches_member(files::WrenchRows(20), files::Precision::kFloat64)},
      {"joint_torques", files::joints_member(files::VectorRows(20), files::Precision::kFloat64)}};
  motion::write_clip(motions / "a.npz", clip, members);
  import::ReadConfig tall;
  tall.height = 1.95;
  const EvaluatedMotion usual = evaluate_folders(truth, motions).motions.at(0),
                        with_height = evaluate_folders(truth, motions, tall).motions.at(0);
  ASSERT_TRUE(with_height.ok) << with_height.reason;
  EXPECT_EQ(metric(with_height, "GP"), metric(usual, "GP"));
  EXPECT_GT(metric(with_height, "gMPJPE"), metric(usual, "gMPJPE")) << "the truth is taller";
}

TEST_F(Evaluate, ScoresMotionsOfAnotherRateAt30Fps) {
  motion::Clip clip = motion::standing_clip(21);
  motion::write_clip(truth / "slide.npz", clip);
  for (int t = 0; t < clip.frames(); ++t) clip.trans[t].x() += 0.010 * t;
  motion::write_clip(motions / "slide.npz", clip);
  const EvaluatedMotion at_30 = evaluate_folders(truth, motions).motions.at(0);
  motion::write_clip(motions / "slide.npz", motion::resampled(clip, 120.0));
  const EvaluatedMotion at_120 = evaluate_folders(truth, motions).motions.at(0);
  ASSERT_TRUE(at_30.ok && at_120.ok) << at_120.reason;
  EXPECT_EQ(at_120.frames, 21);
  EXPECT_NEAR(metric(at_30, "Vel"), 10.0, 1e-6);
  for (const char* name : {"Vel", "FS_gt", "Jitter", "MRPE"})
    EXPECT_NEAR(metric(at_120, name), metric(at_30, name), 1e-6) << name;
}

TEST_F(Evaluate, MeanIsOverFilesWithAValue) {
  add_pair("a", 0.010);
  add_pair("b", 0.030);
  std::ofstream(motions / "c.npz") << "broken";
  const Evaluation e = evaluate_folders(truth, motions);
  ASSERT_EQ(e.motions.size(), 3u);
  EXPECT_FALSE(e.motions[2].ok);
  EXPECT_NEAR(mean_of(e, motion::metric_definitions().front()), 20.0, 1e-6);
}

TEST_F(Evaluate, ListsFilesWithoutAPartner) {
  add_pair("a", 0.0);
  motion::write_clip(truth / "only_truth.npz", motion::standing_clip(20));
  motion::write_clip(motions / "only_motion.npz", motion::standing_clip(20));
  const Evaluation e = evaluate_folders(truth, motions);
  EXPECT_EQ(e.unmatched, std::vector<std::string>{"only_truth"});
  ASSERT_EQ(e.motions.size(), 2u);
  EXPECT_FALSE(e.motions[1].ok);
  EXPECT_NE(e.motions[1].reason.find("only_motion"), std::string::npos);
}

TEST_F(Evaluate, EqualNamesAreToldApart) {
  add_pair("a", 0.030);
  import::write_motion(motions / "a.bvh", motion::standing_clip(20));
  const Evaluation e = evaluate_folders(truth, motions);
  ASSERT_EQ(e.motions.size(), 2u);
  EXPECT_FALSE(e.motions[0].ok) << "a.bvh, of which there is no truth";
  EXPECT_EQ(e.motions[1].name, "a-2");
  EXPECT_TRUE(e.motions[1].ok) << "a.npz";
  EXPECT_NEAR(metric(e.motions[1], "MRPE"), 30.0, 1e-3);
}

TEST_F(Evaluate, TruthHasTheSuffixOfTheMotionWhereThereAreTwo) {
  add_pair("a", 0.030);
  import::write_motion(truth / "a.bvh", motion::standing_clip(20));
  const Evaluation e = evaluate_folders(truth, motions);
  ASSERT_EQ(e.motions.size(), 1u);
  EXPECT_NEAR(metric(e.motions[0], "MRPE"), 30.0, 1e-3);
  EXPECT_EQ(e.unmatched, std::vector<std::string>{"a.bvh"});
}

// The reader moves a motion that begins over 50 m away by a multiple of 100 m, here one of the two.
TEST_F(Evaluate, MotionsOnEitherSideOfFiftyMetresAreAsNearAsTheyAre) {
  motion::Clip clip = motion::standing_clip(20);
  const double shift = 49.9 - clip.trans.front().x();
  for (Vector3d& p : clip.trans) p.x() += shift;
  motion::write_clip(truth / "a.npz", clip);
  for (Vector3d& p : clip.trans) p.x() += 0.2;
  motion::write_clip(motions / "a.npz", clip);
  const Evaluation e = evaluate_folders(truth, motions);
  ASSERT_EQ(e.motions.size(), 1u);
  EXPECT_NEAR(metric(e.motions[0], "MRPE"), 200.0, 1e-3);
  EXPECT_TRUE(std::any_of(e.motions[0].told.begin(), e.motions[0].told.end(), [](const std::string& line) {
    return line.ends_with("a.npz: place: moved by (-100, 0) m to the origin");
  }));
}

/// A run writes a motion near the origin whose truth is 300 m away; other distances are what they are.
TEST_F(Evaluate, DistancesAreNotTakenModuloHundredMetres) {
  const auto distance = [&](double of_truth, double of_motion) {
    const motion::Clip clip = motion::standing_clip(20);
    for (const auto& [folder, x] : {std::pair(truth, of_truth), {motions, of_motion}}) {
      motion::Clip moved = clip;
      for (Vector3d& p : moved.trans) p.x() += x - clip.trans.front().x();
      motion::write_clip(folder / "a.npz", moved);
    }
    return metric(evaluate_folders(truth, motions).motions.at(0), "MRPE") / 1000.0;
  };
  EXPECT_NEAR(distance(-30.0, 30.0), 60.0, 1e-6);
  EXPECT_NEAR(distance(0.0, 100.0), 100.0, 1e-6);
  EXPECT_NEAR(distance(0.0, 330.0), 330.0, 1e-6);
  EXPECT_NEAR(distance(330.0, 331.0), 1.0, 1e-6);
  EXPECT_NEAR(distance(300.0, 0.2), 0.2, 1e-6) << "of a run";
}

TEST_F(Evaluate, MissingFileIsNamed) {
  add_pair("a", 0.0);
  const Evaluation e = evaluate_folders(truth, motions / "none.npz");
  ASSERT_EQ(e.motions.size(), 1u);
  EXPECT_EQ(e.motions[0].reason.find("truth"), std::string::npos) << e.motions[0].reason;
}

TEST_F(Evaluate, DifferentLengthsFailThatFileOnly) {
  add_pair("a", 0.0);
  add_pair("b", 0.0);
  motion::write_clip(motions / "a.npz", motion::standing_clip(15));
  const Evaluation e = evaluate_folders(truth, motions);
  EXPECT_FALSE(e.motions[0].ok);
  EXPECT_TRUE(e.motions[1].ok);
}

TEST_F(Evaluate, ComparesFoldersOverTheirCommonMotions) {
  add_pair("a", 0.010);
  add_pair("b", 0.030);
  add_pair("c", 0.090);
  const std::filesystem::path fewer = folder.path / "fewer";
  std::filesystem::create_directory(fewer);
  for (const char* name : {"a.npz", "b.npz"})  // exact ones
    std::filesystem::copy(truth / name, fewer / name);
  const Comparison comparison = compare_folders(truth, {motions.string(), fewer.string()});
  EXPECT_EQ(comparison.left_out, 1);
  ASSERT_EQ(comparison.evaluations.size(), 2u);
  EXPECT_NEAR(mean_of(comparison.evaluations[0], motion::metric_definitions().front()), 20.0, 1e-6);
  EXPECT_NEAR(mean_of(comparison.evaluations[1], motion::metric_definitions().front()), 0.0, 1e-6);
  EXPECT_NE(format_comparison(comparison).find("means over 2 motions"), std::string::npos);
  const auto json = record::Json::parse(comparison_json(comparison));
  EXPECT_EQ(json.at("motions").elements().size(), 2u);
  EXPECT_NEAR(json.at("rows").at(0).at("mean").at("MRPE").get<double>(), 20.0, 1e-6);
}

TEST_F(Evaluate, TruthsThatNoFolderHasAMotionOfAreLeftOutOfAComparison) {
  add_pair("a", 0.010);
  add_pair("b", 0.030);
  const std::filesystem::path fewer = folder.path / "fewer";
  std::filesystem::create_directory(fewer);
  std::filesystem::copy(truth / "a.npz", fewer / "a.npz");
  motion::write_clip(truth / "lost.npz", motion::standing_clip(20));
  const Comparison comparison = compare_folders(truth, {motions.string(), fewer.string()});
  EXPECT_EQ(comparison.unmatched, std::vector<std::string>{"lost"});
  EXPECT_EQ(comparison.left_out, 2) << "b, which one folder has, and lost";
  const auto json = record::Json::parse(comparison_json(comparison));
  EXPECT_EQ(json.at("unmatched").at(0).get<std::string>(), "lost");
}

TEST_F(Evaluate, RejectsFoldersWithoutMotions) {
  EXPECT_THROW(evaluate_folders(truth, motions), DataError);
  EXPECT_THROW(evaluate_folders(truth, folder.path / "none"), DataError);
}

TEST_F(Evaluate, JsonHasEveryMetricWithItsDefinition) {
  add_pair("a", 0.010);
  const auto json = record::Json::parse(evaluation_json(evaluate_folders(truth, motions)));
  EXPECT_EQ(json.at("definitions").items().size(), motion::metric_definitions().size());
  for (const auto& d : motion::metric_definitions()) {
    EXPECT_FALSE(json.at("definitions").at(d.name).at("definition").get<std::string>().empty());
    EXPECT_TRUE(json.at("motions").at(0).at("metrics").contains(d.name));
    EXPECT_TRUE(json.at("mean").contains(d.name));
  }
  EXPECT_NEAR(json.at("mean").at("MRPE").get<double>(), 10.0, 1e-6);
}

}  // namespace
}  // namespace mimicx::judge
