#include "files/clean_copy.h"

#include <gtest/gtest.h>

#include "core/temporary_folder.h"
#include "import/world_transform.h"
#include "motion/clip_file.h"
#include "motion/resample.h"
#include "motion/standing_clip.h"

namespace mimicx::files {
namespace {

double distance(const motion::Clip& a, const motion::Clip& b) {
  const auto p = motion::poses_of(a), q = motion::poses_of(b);
  EXPECT_EQ(p.size(), q.size());
  double most = 0.0;
  for (std::size_t t = 0; t < std::min(p.size(), q.size()); ++t)
    for (std::size_t j = 0; j < kBodies; ++j) most = std::max(most, (p[t].p_WB[j] - q[t].p_WB[j]).norm());
  return most;
}

struct CleanCopy : testing::Test {
  std::filesystem::path path(const std::string& name) const { return folder.path / name; }
  TemporaryFolder folder;
};

TEST_F(CleanCopy, HasTheInputsBodyAtTheSimulatedPlace) {
  const motion::Clip simulated = motion::standing_clip(40);
  const NpyArray joints = from_matrix(Eigen::MatrixXd::Random(40, 66));
  motion::write_clip(path("simulated.npz"), simulated,
                     {{"reward", NpyArray::scalar(1.0)}, {"joints", joints}, {"joint_torques", joints}});
  for (const char* model : {"smpl", "smplh", "smplx"}) {
    motion::Clip input = simulated;
    input.body_model = model;
    input.betas[1] = 0.7;
    input.gender = "female";
    motion::write_clip(path("input.npz"), input);
    const auto [body, feet] =
        write_clean_copy(path("simulated.npz"), path("input.npz"), {}, false, path("copy.npz"));
    EXPECT_NEAR(feet, 0.0, 1e-9);
    EXPECT_NE(body.find(model), std::string::npos) << body;
    const Npz file = read_npz(path("copy.npz"));
    EXPECT_NE(file.at("joints").to_double(), joints.to_double()) << "of another body";
    EXPECT_FALSE(read_npz(path("copy.npz")).has("joint_torques"));
    const motion::Clip copy = motion::read_clip(path("copy.npz"));
    EXPECT_EQ(copy.body_model, model);
    EXPECT_EQ(copy.betas, input.betas);
    EXPECT_EQ(copy.gender, "female");
    EXPECT_LT(distance(copy, simulated), 1e-12);
    EXPECT_TRUE(read_npz(path("copy.npz")).has("reward"));
  }
}

// Longer legs under the same pelvis.
TEST_F(CleanCopy, TellsHowFarTheFeetOfAnotherBodyAreFromTheFloor) {
  motion::Clip simulated = motion::standing_clip(10);
  simulated.betas[0] = 2.0;
  motion::write_clip(path("simulated.npz"), simulated);
  motion::Clip input = motion::standing_clip(10);
  input.body_model = "smplh";
  motion::write_clip(path("input.npz"), input);
  const double feet =
      write_clean_copy(path("simulated.npz"), path("input.npz"), {}, false, path("copy.npz")).feet;
  const auto foot = [](const motion::Clip& clip) { return motion::poses_of(clip)[0].p_WB[kLeftFoot].z(); };
  EXPECT_NEAR(feet, foot(motion::read_clip(path("copy.npz"))) - foot(simulated), 1e-6);
  EXPECT_GT(feet, 0.03) << "m: the copy hangs over the floor";
}

TEST_F(CleanCopy, KeepsJointsAndForcesWhereTheFitChangedTheShape) {
  motion::Clip simulated = motion::standing_clip(40);
  simulated.betas[0] = 1.25;
  simulated.betas[3] = -0.5;
  std::vector<double> joints;
  for (const BodyPoses& pose : motion::poses_of(simulated))
    for (const Vector3d& p : pose.p_WB) joints.insert(joints.end(), p.data(), p.data() + 3);
  motion::write_clip(path("simulated.npz"), simulated,
                     {{"joints", NpyArray::from_double({40, kBodies, 3}, joints.data())}});
  motion::write_clip(path("input.npz"), motion::standing_clip(40));
  write_clean_copy(path("simulated.npz"), path("input.npz"), {}, false, path("copy.npz"));
  const motion::Clip copy = motion::read_clip(path("copy.npz"));
  EXPECT_EQ(copy.betas, simulated.betas);
  const std::vector<double> of_copy = read_npz(path("copy.npz")).at("joints").to_double();
  const auto poses = motion::poses_of(copy);
  for (std::size_t j = 0; j < kBodies; ++j)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(of_copy[3 * j + static_cast<std::size_t>(axis)], poses[0].p_WB[j][axis], 1e-12)
          << "joints and betas are of one body";
}

TEST_F(CleanCopy, AtTheInputsRateHasItsFramesAndHands) {
  motion::Clip input = motion::standing_clip(101);
  input.fps = 50.0;
  input.passthrough.emplace_back("pose_hand", from_matrix(Eigen::MatrixXd::Random(101, 90)));
  const motion::Clip simulated = motion::resampled(input, 30.0);
  const motion::Clip copy = at_rate_of(simulated, input);
  ASSERT_EQ(copy.frames(), 101);
  EXPECT_EQ(copy.fps, 50.0);
  EXPECT_EQ(copy.passthrough[0].second.bytes, input.passthrough[0].second.bytes);
  // Every fifth frame of the input is a third frame of the simulation.
  for (std::size_t k = 0; 5 * k < 101; ++k)
    for (std::size_t j = 0; j < kBodies; ++j)
      EXPECT_LT((copy.rotations[5 * k][j] - simulated.rotations[3 * k][j]).norm(), 1e-9);
}

// 240 frames a second end up to seven frames after the last frame of the simulation.
TEST_F(CleanCopy, AtTheInputsRateGoesOnAtItsLastVelocities) {
  motion::Clip input = motion::standing_clip(48);
  input.fps = 240.0;
  for (int t = 0; t < 48; ++t) {
    input.trans[t].x() += 0.005 * t;
    input.rotations[t][kLeftElbow] = Vector3d(0.0, 0.01 * t, 0.0);
  }
  const motion::Clip copy = at_rate_of(motion::resampled(input, 30.0), input);
  ASSERT_EQ(copy.frames(), 48);
  for (int t = 0; t < 48; ++t) {
    EXPECT_LT((copy.trans[t] - input.trans[t]).norm(), 1e-9) << t;
    EXPECT_LT((copy.rotations[t][kLeftElbow] - input.rotations[t][kLeftElbow]).norm(), 1e-9) << t;
  }
}

TEST_F(CleanCopy, HasTheInputsFormat) {
  const motion::Clip simulated = motion::standing_clip(40);
  motion::write_clip(path("simulated.npz"), simulated);
  motion::Clip input = simulated;
  input.body_model = "smplx";
  import::write_motion(path("input.npy"), input);
  write_clean_copy(path("simulated.npz"), path("input.npy"), {}, false, path("new/copy.npy"));
  EXPECT_LT(distance(import::read_motion(path("new/copy.npy")), simulated), 1e-9);
  EXPECT_EQ(clean_suffix("a/walk.npy"), ".npy");
  EXPECT_EQ(clean_suffix("a/walk.txt"), ".npz");
}

}  // namespace
}  // namespace mimicx::files
