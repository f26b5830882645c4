#include "import/clip_checks.h"

#include <gtest/gtest.h>

#include "core/temporary_folder.h"
#include "import/motion_file.h"
#include "import/motionx.h"
#include "import/world_transform.h"
#include "motion/clip_file.h"
#include "motion/made_motions.h"
#include "motion/resample.h"
#include "motion/synthetic_clip.h"

namespace mimicx::import {
namespace {

/// The clip as a foreign file.
motion::Clip read_as_foreign(motion::Clip clip) {
  clip.body_model = "smplx";
  clip.betas = {};
  motion::write_clip(scratch("clip.npz"), clip);
  return read_motion(scratch("clip.npz"));
}

bool says(const std::vector<std::string>& lines, const std::string& words) {
  for (const std::string& line : lines)
    if (line.find(words) != std::string::npos) return true;
  return false;
}

motion::Clip walk() { return test::synthetic_clip("walk", 3); }

/// Standing with the arms out.
PerBody<Vector3d> arms_out(const motion::Clip& clip) {
  PerBody<Vector3d> pose;
  pose.fill(Vector3d::Zero());
  pose[0] = clip.rotations[0][0];
  return pose;
}

TEST(ClipChecks, DropsALeadingTPoseAndTheTransitionOutOfIt) {
  for (const int poses : {1, 3})
    for (const int way : {0, 1, 2}) {
      const motion::Clip sound = motion::resampled(walk(), 120.0);
      motion::Clip clip = sound;
      const PerBody<Vector3d> t = arms_out(clip);
      for (int k = 0; k < way; ++k) {  // halfway poses
        PerBody<Vector3d> between = t;
        for (int j = 0; j < kBodies; ++j)
          between[j] = t[j] + (way - k) / (way + 1.0) * (sound.rotations[0][j] - t[j]);
        clip.rotations.insert(clip.rotations.begin(), between);
        clip.trans.insert(clip.trans.begin(), sound.trans[0]);
      }
      clip.rotations.insert(clip.rotations.begin(), static_cast<std::size_t>(poses), t);
      clip.trans.insert(clip.trans.begin(), static_cast<std::size_t>(poses), sound.trans[0]);
      const motion::Clip back = read_as_foreign(clip);
      const int added = poses + way, left = clip.frames() - back.frames();
      EXPECT_GE(left, poses) << poses << ' ' << way;
      EXPECT_LE(left, added) << poses << ' ' << way;
      EXPECT_TRUE(says(back.decisions, "T-pose")) << poses << ' ' << way;
      EXPECT_EQ(back.rotations.back(), sound.rotations.back());
    }
}

TEST(ClipChecks, DropsPerFrameMembersOfTheTPose) {
  motion::Clip clip = walk();
  clip.rotations.insert(clip.rotations.begin(), arms_out(clip));
  clip.trans.insert(clip.trans.begin(), clip.trans[0]);
  std::vector<double> number(clip.rotations.size());
  for (std::size_t t = 0; t < number.size(); ++t) number[t] = static_cast<double>(t);
  clip.passthrough.emplace_back("number", NpyArray::from_double({number.size()}, number.data()));
  const motion::Clip back = read_as_foreign(clip);
  ASSERT_EQ(back.frames() + 1, clip.frames());
  EXPECT_EQ(back.passthrough[0].second.to_double().front(), 1.0);
  EXPECT_EQ(back.passthrough[0].second.shape[0], back.rotations.size());
}

TEST(ClipChecks, KeepsATPoseThatIsLeftAtHumanSpeed) {
  motion::Clip clip = walk();
  const PerBody<Vector3d> t = arms_out(clip), first = clip.rotations[0];
  for (int k = 30; k-- > 0;) {  // a second
    PerBody<Vector3d> between = t;
    for (int j = 0; j < kBodies; ++j) between[j] = t[j] + k / 30.0 * (first[j] - t[j]);
    clip.rotations.insert(clip.rotations.begin(), between);
    clip.trans.insert(clip.trans.begin(), clip.trans[0]);
  }
  EXPECT_EQ(read_as_foreign(clip).frames(), clip.frames());
}

TEST(ClipChecks, WarnsOfAJumpOfTheBodyWithOrWithoutReturn) {
  for (const bool back : {false, true}) {
    motion::Clip clip = walk();
    for (int t = 40; t < (back ? 41 : clip.frames()); ++t) clip.trans[t].x() += 8.0;
    const motion::Clip read = read_as_foreign(clip);
    EXPECT_TRUE(says(read.warnings, "the body jumps by 8")) << back;
    EXPECT_TRUE(says(read.warnings, "from frame 39 to 40")) << back;
    EXPECT_EQ(says(read.warnings, "from frame 40 to 41"), back);
  }
  EXPECT_FALSE(says(read_as_foreign(walk()).warnings, "jumps"));
}

TEST(ClipChecks, HoldsInvalidAnglesAndRejectsDegrees) {
  motion::Clip clip = walk();
  clip.rotations[20][kLeftKnee] = {1e30, 0.0, 0.0};
  const motion::Clip back = read_as_foreign(clip);
  EXPECT_TRUE(says(back.warnings, "an angle of 1e+30 rad in frame 20"));
  EXPECT_EQ(back.rotations[20][kLeftKnee], clip.rotations[19][kLeftKnee]);
  EXPECT_EQ(back.rotations[20][kRightKnee], clip.rotations[20][kRightKnee]);
  motion::Clip degrees = walk();
  for (auto& frame : degrees.rotations)
    for (Vector3d& rotation : frame) rotation *= 180.0 / test::kPi;
  try {
    read_as_foreign(degrees);
    ADD_FAILURE();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("rotations in radians"), std::string::npos) << error.what();
  }
}

TEST(ClipChecks, RejectsAPersonBehindTheCamera) {
  motion::Clip clip = walk();
  motion::Keypoints k;
  k.names = {"left_hip"};
  k.uvc.assign(clip.rotations.size(), {Vector3d(300, 200, 1)});
  k.intrinsics << 1000, 0, 500, 0, 1000, 500, 0, 0, 1;
  Eigen::Matrix4d camera = Eigen::Matrix4d::Identity();
  camera.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // looks along y, z is up
  camera.topRightCorner<3, 1>() = Vector3d(0, 1, 6);
  k.extrinsics = {camera};
  clip.keypoints = k;
  EXPECT_NO_THROW(read_as_foreign(clip));
  camera(2, 3) = -6.0;
  clip.keypoints->extrinsics = {camera};
  try {
    read_as_foreign(clip);
    ADD_FAILURE();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("behind it in"), std::string::npos) << error.what();
  }
}

TEST(ClipChecks, MotionXInCentimetresIsNotTakenForAist) {
  motion::Clip clip = walk();
  clip.body_model = "smplx";
  clip.betas = {};
  Eigen::MatrixXd values = to_matrix(to_motionx(clip));
  values.middleCols(309, 3) *= 100.0;
  write_file_atomically(scratch("cm.npy"), format_npy(from_matrix(values)));
  const motion::Clip back = read_motion(scratch("cm.npy"));
  EXPECT_TRUE(says(back.decisions, "centimetres"));
  EXPECT_FALSE(says(back.decisions, "AIST"));
  for (int t = 0; t < clip.frames(); ++t) EXPECT_LT((back.trans[t] - clip.trans[t]).norm(), 1e-9);
}

}  // namespace
}  // namespace mimicx::import
