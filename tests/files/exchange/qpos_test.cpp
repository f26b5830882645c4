#include "files/exchange/qpos.h"

#include <gtest/gtest.h>

#include "core/temporary_folder.h"
#include "motion/standing_clip.h"

namespace mimicx::files {
namespace {

TEST(Qpos, JointsAreDepthFirst) {
  TemporaryFolder folder;
  write_qpos(folder.path / "a.npz", motion::standing_clip(3));
  EXPECT_EQ(read_npz(folder.path / "a.npz").at("joint_names").text,
            (std::vector<std::string>{
                "left_hip",       "left_knee",   "left_ankle",    "left_foot",  "right_hip",  "right_knee",
                "right_ankle",    "right_foot",  "spine1",        "spine2",     "spine3",     "neck",
                "head",           "left_collar", "left_shoulder", "left_elbow", "left_wrist", "right_collar",
                "right_shoulder", "right_elbow", "right_wrist"}));
}

TEST(Qpos, ForwardKinematicsReproducesTheMotion) {
  TemporaryFolder folder;
  motion::Clip clip = motion::standing_clip(9);
  for (std::size_t t = 0; t < 9; ++t) {
    clip.rotations[t][kLeftKnee] = 0.1 * static_cast<double>(t) * hinge_axis(kLeftKnee);
    clip.rotations[t][kRightElbow] = 0.7 * hinge_axis(kRightElbow);
  }
  write_qpos(folder.path / "a.npz", clip);
  const Eigen::MatrixXd qpos = to_matrix(read_npz(folder.path / "a.npz").at("qpos"));
  ASSERT_EQ(qpos.cols(), 79);
  const Character character = motion::character_of(clip);
  const auto poses = motion::poses_of(clip);
  for (Eigen::Index t = 0; t < qpos.rows(); ++t) {
    // Read as MuJoCo reads it, by a walk of our own.
    Eigen::Index at = 0;
    const auto next = [&] { return qpos(t, at++); };
    const auto ball = [&] {
      const double w = next(), x = next(), y = next(), z = next();
      return Quaterniond(w, x, y, z);
    };
    const double x = next(), y = next(), z = next();
    PerBody<Quaterniond> q;
    q[kPelvis] = ball();
    for (const int body : {1, 4, 7, 10, 2, 5, 8, 11, 3, 6, 9, 12, 15, 13, 16, 18, 20, 14, 17, 19, 21})
      q[body] = is_hinge(body) ? exp_map(next() * hinge_axis(body)) : ball();
    EXPECT_EQ(at, 79);
    const BodyPoses again = forward_kinematics(character, {x, y, z}, q);
    for (std::size_t j = 0; j < kBodies; ++j)
      EXPECT_LT((again.p_WB[j] - poses[static_cast<std::size_t>(t)].p_WB[j]).norm(), 1e-9) << t << ' ' << j;
  }
}

}  // namespace
}  // namespace mimicx::files
