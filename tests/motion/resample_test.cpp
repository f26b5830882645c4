#include "motion/resample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "motion/full_clip.h"
#include "motion/made_motions.h"
#include "motion/passthrough.h"

namespace mimicx::motion {
namespace {

using test::clip_with_everything;

TEST(Resample, ConstantRotationAndTranslationStayOnTheirCurve) {
  const Vector3d axis = Vector3d(1, -2, 0.5).normalized(), velocity(0.3, -1.2, 0.1);
  Clip clip = test::standing_clip(121, 0.0, 120.0);
  for (std::size_t t = 0; t < 121; ++t) {
    clip.rotations[t][kSpine1] = 0.8 * static_cast<double>(t) / 120.0 * axis;
    clip.trans[t] = velocity * static_cast<double>(t) / 120.0;
  }
  for (const double fps : {30.0, 50.0, 25.0}) {
    const Clip out = resampled(clip, fps);
    EXPECT_EQ(out.fps, fps);
    ASSERT_EQ(out.frames(), static_cast<int>(fps) + 1);
    for (int k = 0; k < out.frames(); ++k) {
      EXPECT_LT((out.rotations[k][kSpine1] - 0.8 * k / fps * axis).norm(), 1e-9);
      EXPECT_LT((out.trans[k] - velocity * k / fps).norm(), 1e-9);
    }
  }
}

TEST(Resample, SameRateChangesNothing) {
  const Clip clip = test::clip_with_everything();
  const Clip out = resampled(clip, clip.fps);
  EXPECT_EQ(out.rotations, clip.rotations);
  EXPECT_EQ(out.passthrough.size(), clip.passthrough.size());
  EXPECT_TRUE(out.warnings.empty());
}

TEST(Resample, KeypointsAndMovingCamerasFollow) {
  Clip clip = test::clip_with_everything();
  clip.fps = 60.0;
  clip.keypoints->uvc[1][0] = {11.5, 22.25, 0.7};
  const Clip half = resampled(clip, 30.0), third = resampled(clip, 40.0);
  EXPECT_EQ(half.frames(), 3);
  EXPECT_EQ(half.keypoints->uvc.size(), 3u);
  EXPECT_EQ(half.keypoints->extrinsics.size(), 3u);
  EXPECT_TRUE(half.warnings.empty());
  // At 40 fps frame 1 lies between the input's frames 1 and 2, midway.
  EXPECT_LT((third.keypoints->uvc[1][0] - Vector3d(11.0, 21.25, 0.7)).norm(), 1e-9);
  EXPECT_EQ(third.keypoints->uvc[1][1].z(), 0.0);
  EXPECT_NEAR(third.keypoints->extrinsics[2](0, 3), 4.5, 1e-9);
  EXPECT_LT((third.keypoints->extrinsics[1].topLeftCorner<3, 3>() - Matrix3d::Identity()).norm(), 1e-12);
}

TEST(Resample, KeypointsAtFramesOfTheInputAreTheInputs) {
  Clip clip = test::clip_with_everything();
  clip.fps = 60.0;
  for (std::size_t t = 1; t < clip.keypoints->uvc.size(); t += 2)
    for (Vector3d& point : clip.keypoints->uvc[t]) point.z() = 0.1;
  const Clip half = resampled(clip, 30.0);
  for (int k = 0; k < half.frames(); ++k) EXPECT_EQ(half.keypoints->uvc[k], clip.keypoints->uvc[2 * k]) << k;
}

TEST(Resample, ResamplesPerFrameMembersAndKeepsTheOthers) {
  Clip clip = test::standing_clip(9, 1.0, 120.0);
  const Vector3d axis = Vector3d(2, -1, 3).normalized();
  std::vector<double> hand, soft;
  std::vector<std::int64_t> frame;
  std::vector<std::string> words;
  for (int t = 0; t < 9; ++t) {
    const Vector3d turn = 0.3 * t * axis;
    hand.insert(hand.end(), turn.data(), turn.data() + 3);
    soft.insert(soft.end(), {1.0 * t, 10.0 * t, 0.0, 0.0});
    frame.push_back(t);
    words.push_back("frame " + std::to_string(t));
  }
  clip.passthrough = {{"pose_hand", NpyArray::from_double({9, 3}, hand.data())},
                      {"dmpls", NpyArray::from_double({9, 2, 2}, soft.data())},
                      {"number", NpyArray::from_int64({9}, frame.data())},
                      {"words", NpyArray::from_text(words)},
                      {"num_betas", NpyArray::scalar_int(16)},
                      {"betas_rest", NpyArray::from_double({9}, soft.data())},
                      {"markers", NpyArray::from_double({2, 9}, hand.data())}};
  const Clip out = resampled(clip, 50.0);  // frame k of it is frame 2.4 k of the input: 0, 2.4, 4.8, 7.2
  ASSERT_EQ(out.frames(), 4);
  ASSERT_EQ(out.passthrough.size(), 7u);
  EXPECT_TRUE(out.warnings.empty());
  const auto at = [&](int i) { return out.passthrough[static_cast<std::size_t>(i)].second; };
  EXPECT_EQ(at(0).shape, (std::vector<std::size_t>{4, 3}));
  EXPECT_EQ(at(1).shape, (std::vector<std::size_t>{4, 2, 2}));
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d turn = to_matrix(at(0)).row(k);
    EXPECT_LT((turn - 0.3 * 2.4 * k * axis).norm(), 1e-9) << k;
    EXPECT_NEAR(to_matrix(at(1))(k, 1), 24.0 * k, 1e-9);
  }
  EXPECT_EQ(at(2).to_double(), (std::vector<double>{0, 2, 5, 7}));
  EXPECT_EQ(at(3).text, (std::vector<std::string>{"frame 0", "frame 2", "frame 5", "frame 7"}));
  for (const int i : {4, 5, 6}) {
    EXPECT_EQ(at(i).bytes, clip.passthrough[static_cast<std::size_t>(i)].second.bytes);
    EXPECT_EQ(at(i).shape, clip.passthrough[static_cast<std::size_t>(i)].second.shape);
  }
}

/// The middle of two rows, as resampling to twice the rate gives it.
std::vector<double> halfway(const std::string& name, const std::vector<double>& first,
                            const std::vector<double>& second) {
  std::vector<double> rows = first;
  rows.insert(rows.end(), second.begin(), second.end());
  const Passthrough members = {{name, NpyArray::from_double({2, first.size()}, rows.data())}};
  const std::vector<double> all = resampled_members(members, 2, 3, 0.5)[0].second.to_double();
  return {all.begin() + static_cast<std::ptrdiff_t>(first.size()),
          all.begin() + static_cast<std::ptrdiff_t>(2 * first.size())};
}

TEST(Resample, RotationsGoTheShortWayUnderEveryNameOfTheirs) {
  for (const auto& [name, columns] : {std::pair<const char*, std::size_t>{"global_orient_incam", 3},
                                      {"root_orient", 3},
                                      {"poses_rest", 99},
                                      {"body_pose_incam", 63},
                                      {"pose_lhand", 45},
                                      {"left_hand_pose", 45},
                                      {"pose_hand", 90},
                                      {"jaw_pose", 3},
                                      {"pose_eye", 6},
                                      {"fullpose", 165}}) {
    std::vector<double> first(columns, 0.0), second(columns, 0.0);
    first[0] = 3.0, second[0] = -3.0;  // 0.28 rad apart, on either side of half a turn
    EXPECT_NEAR(std::abs(halfway(name, first, second)[0]), std::numbers::pi, 1e-9) << name;
  }
}

TEST(Resample, NumbersThatAreNoRotationsAreInterpolatedLinearly) {
  for (const auto& [name, first, second] :
       {std::tuple<const char*, std::vector<double>, std::vector<double>>{
            "pose_keypoints_2d", {500, 200, 0.9}, {510, 220, 0.7}},
        {"pose_keypoints_3d", {3, 0, 0}, {-3, 0, 0}},
        {"left_hand_pose", {3, 0, 0, 1, 0, 0}, {-3, 0, 0, 0, 1, 0}},
        {"pose_hand_pca", std::vector<double>(45, 2.0), std::vector<double>(45, -1.0)},
        {"poses_conf", {3, 0, 0}, {-3, 0, 0}},
        {"pose_embedding", {3, 0, 0}, {-3, 0, 0}},
        {"joint_orient_quat", {1, 0, 0, 0, 0, 1}, {0, 1, 0, 0, 1, 0}},
        {"body_pose_rotation_matrices", {1, 0, 0, 0, 0, 1}, {0, 1, 0, 0, 1, 0}},
        {"body_pose", {500, 200, 1}, {510, 220, 1}}})
    for (std::size_t c = 0; c < first.size(); ++c)
      EXPECT_NEAR(halfway(name, first, second)[c], 0.5 * (first[c] + second[c]), 1e-12) << name;
}

TEST(Resample, ARoundedRateLosesNoFrame) {
  Clip clip = test::random_clip(4, 100, 0.3, 1.0 / 0.033333);
  EXPECT_EQ(resampled(clip, 30.0).frames(), 100);
  clip.fps = 120.001;
  clip.rotations.resize(97);
  clip.trans.resize(97);
  EXPECT_EQ(resampled(clip, 30.0).frames(), 25);
}

TEST(Resample, RejectsARateThatGivesTooManyFrames) {
  const Clip slow = test::standing_clip(200, 1.0, 0.01);
  try {
    resampled(slow, 30.0);
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("is the frame rate right?"), std::string::npos) << error.what();
  }
}

TEST(Resample, MembersAtInputFramesAreBitIdentical) {
  Clip clip = test::clip_with_everything();
  clip.fps = 60.0;
  const Clip half = resampled(clip, 30.0);
  const auto all = to_matrix(clip.passthrough[0].second), kept = to_matrix(half.passthrough[0].second);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(kept.row(k), all.row(2 * k));
}

}  // namespace
}  // namespace mimicx::motion
