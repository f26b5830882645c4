#include "import/body_model.h"
#include "motion/clip_file.h"

#include <gtest/gtest.h>

#include "core/npz/npz.h"
#include "core/temporary_folder.h"
#include "import/motion_file.h"
#include "import/small_body_model.h"
#include "motion/made_motions.h"
#include "motion/prepare/prepare.h"

namespace mimicx::import {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using test::SmallModel, test::kVertices, test::kComponents, test::kFileJoints;

constexpr std::array<double, kBetas> kSomeBetas = {1.5, -0.5, 0.3, 0, 2, -1, 0.1, 0.2, -0.3, 0.7};

TEST(BodyModel, JointsAreTheRegressorTimesTheShapedVertices) {
  const SmallModel small;
  write_npz(scratch("model.npz"), small.file());
  const RestJoints joints = read_body_model(scratch("model.npz")).joints(kSomeBetas);
  for (int j = 0; j < kBodies; ++j) EXPECT_LT((joints[j] - small.joint(j, kSomeBetas)).norm(), 1e-12) << j;
}

TEST(BodyModel, RejectsOtherLayoutsNamingTheMember) {
  const SmallModel small;
  const auto refused = [&](const std::string& key, const NpyArray& array) {
    Npz npz = small.file();
    npz.set(key, array);
    write_npz(scratch("bad.npz"), npz);
    EXPECT_THROW(read_body_model(scratch("bad.npz")), DataError) << key;
  };
  refused("v_template", from_matrix(MatrixXd::Zero(kVertices, 2)));
  refused("shapedirs", from_matrix(MatrixXd::Zero(kVertices, 3)));
  refused("J_regressor", from_matrix(MatrixXd::Zero(kFileJoints, kVertices + 1)));
  refused("kintree_table", from_matrix(MatrixXd::Zero(2, kFileJoints)));
  EXPECT_THROW(read_body_model(scratch("none.npz")), DataError);
}

TEST(BodyModel, MotionUsesTheJointsOfItsOwnBody) {
  const SmallModel small;
  write_npz(scratch("model.npz"), small.file());
  motion::Clip clip = test::random_clip(3, 4, 0.4);
  clip.body_model = "smplx";
  clip.betas = kSomeBetas;
  motion::write_clip(scratch("clip.npz"), clip);
  ReadConfig config;
  config.smplx = scratch("model.npz");
  const motion::Clip read = read_motion(scratch("clip.npz"), config);
  EXPECT_TRUE(read.warnings.empty()) << "the shape is known now";
  // Forward kinematics by hand, frame 1.
  const auto poses = motion::poses_of(read);
  PerBody<Quaterniond> q;
  PerBody<Vector3d> p;
  for (int j = 0; j < kBodies; ++j) {
    const Quaterniond local = exp_map(clip.rotations[1][j]);
    if (j == 0) {
      q[0] = local;
      p[0] = clip.trans[1] + small.joint(0, kSomeBetas);
    } else {
      const int parent = kParents[j];
      q[j] = q[parent] * local;
      p[j] = p[parent] + q[parent] * (small.joint(j, kSomeBetas) - small.joint(parent, kSomeBetas));
    }
    EXPECT_LT((poses[1].p_WB[j] - p[j]).norm(), 1e-12) << j;
  }
  const motion::Reference reference = motion::prepare_reference(read, {}, nullptr);
  EXPECT_LT((reference.character.joint_offset[kLeftKnee] -
             (small.joint(kLeftKnee, kSomeBetas) - small.joint(kLeftHip, kSomeBetas)))
                .norm(),
            1e-12);
  // Written and read again without the model, it keeps its body.
  motion::write_clip(scratch("again.npz"), read);
  const auto again = motion::poses_of(read_motion(scratch("again.npz")));
  for (int j = 0; j < kBodies; ++j) EXPECT_EQ(again[1].p_WB[j], poses[1].p_WB[j]);
}

TEST(BodyModel, BetasOfAnotherGenderThanTheModelGiveAWarning) {
  const auto warnings = [](const std::string& gender, const std::string& model) {
    write_npz(scratch(model), SmallModel().file());
    motion::Clip clip = test::random_clip(3, 4, 0.4);
    clip.body_model = "smplx";
    clip.betas = kSomeBetas;
    clip.gender = gender;
    motion::write_clip(scratch("clip.npz"), clip);
    ReadConfig config;
    config.smplx = scratch(model);
    return read_motion(scratch("clip.npz"), config).warnings;
  };
  for (const std::string gender : {"male", "female"})
    EXPECT_EQ(
        warnings(gender, "model.npz"),
        std::vector<std::string>{"the betas are of the " + gender + " model: model.npz must be that model"});
  EXPECT_EQ(warnings("male", "SMPLX_FEMALE.npz").size(), 1u);
  EXPECT_EQ(warnings("female", "SMPLX_MALE.npz").size(), 1u);
  EXPECT_TRUE(warnings("Male", "SMPLX_MALE.npz").empty()) << "the name of the model says it";
  EXPECT_TRUE(warnings("female", "smplx_female.npz").empty());
  EXPECT_TRUE(warnings("neutral", "model.npz").empty());
}

TEST(BodyModel, TheStandardBodyKeepsThePelvisWhereItIs) {
  motion::Clip clip = test::random_clip(3, 4, 0.4);
  clip.betas[0] = 2.0;
  motion::write_clip(scratch("clip.npz"), clip);
  ReadConfig config;
  config.standard_body = true;
  const motion::Clip read = read_motion(scratch("clip.npz"), config);
  EXPECT_EQ(read.betas, (std::array<double, kBetas>{}));
  EXPECT_EQ(motion::poses_of(read)[2].p_WB[0], motion::poses_of(clip)[2].p_WB[0]);
}

TEST(BodyModel, IgnoresBetasOfAnotherModel) {
  const SmallModel small;
  write_npz(scratch("model.npz"), small.file());
  motion::Clip clip = test::random_clip(3, 4, 0.4);
  clip.body_model = "smplh";
  clip.betas = kSomeBetas;
  motion::write_clip(scratch("clip.npz"), clip);
  ReadConfig config;
  config.smplx = scratch("model.npz");
  const motion::Clip read = read_motion(scratch("clip.npz"), config);
  EXPECT_FALSE(read.rest_joints);
  EXPECT_EQ(read.warnings.size(), 1u);
}

}  // namespace
}  // namespace mimicx::import
