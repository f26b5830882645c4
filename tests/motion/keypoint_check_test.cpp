#include "motion/keypoint_check.h"

#include <gtest/gtest.h>

#include <functional>

namespace mimicx::motion {
namespace {

/// Two points in ten frames, as a detector and a camera give them.
Keypoints sound() {
  Keypoints k;
  k.names = {"left_hip", "right_hip"};
  for (int t = 0; t < 10; ++t)
    k.uvc.push_back({Vector3d(600.0 + t, 500.0, 0.9), Vector3d(640.0 + t, 502.0, 0.5)});
  k.intrinsics << 1200, 0, 960, 0, 1200, 540, 0, 0, 1;
  Eigen::Matrix4d camera = Eigen::Matrix4d::Identity();
  camera.topLeftCorner<3, 3>() = exp_map(Vector3d(0.3, -1.0, 0.2)).toRotationMatrix();
  camera(2, 3) = 4.0;
  k.extrinsics = {camera};
  return k;
}

struct Checked {
  std::string failure;                 ///< empty: none
  std::vector<std::string> decisions;  ///< what was put right
  Keypoints keypoints;
};

Checked checked(const std::function<void(Keypoints&)>& change) {
  Checked c{{}, {}, sound()};
  change(c.keypoints);
  try {
    check_keypoints("a.npz", c.keypoints, c.decisions);
  } catch (const DataError& error) {
    c.failure = error.what();
  }
  return c;
}

TEST(KeypointCheck, ValidKeypointsStayUnchanged) {
  const Checked c = checked([](Keypoints&) {});
  EXPECT_EQ(c.failure, "");
  EXPECT_TRUE(c.decisions.empty());
  EXPECT_EQ(c.keypoints.uvc, sound().uvc);
}

TEST(KeypointCheck, CorrectsAndReportsConfidencesAboveOne) {
  const Checked percent = checked([](Keypoints& k) {
    for (auto& frame : k.uvc)
      for (Vector3d& p : frame) p.z() *= 100.0;
  });
  ASSERT_EQ(percent.decisions.size(), 1u);
  EXPECT_NE(percent.decisions[0].find("percent"), std::string::npos);
  for (std::size_t t = 0; t < 10; ++t)
    EXPECT_LT((percent.keypoints.uvc[t][0] - sound().uvc[t][0]).norm(), 1e-12);
  const Checked over = checked([](Keypoints& k) { k.uvc[3][0].z() = 1.04; });
  ASSERT_EQ(over.decisions.size(), 1u);
  EXPECT_EQ(over.keypoints.uvc[3][0].z(), 1.0);
  EXPECT_EQ(over.keypoints.uvc[3][1].z(), 0.5);
}

TEST(KeypointCheck, AFarPointCountsAsUndetectedAndAllFarPointsAreRejected) {
  const Checked one = checked([](Keypoints& k) { k.uvc[4][1] = {1e12, 500.0, 0.9}; });
  EXPECT_EQ(one.failure, "");
  EXPECT_EQ(one.keypoints.uvc[4][1].z(), 0.0);
  ASSERT_EQ(one.decisions.size(), 1u);
  EXPECT_NE(one.decisions[0].find("1 points up to 1e+12 px"), std::string::npos) << one.decisions[0];
  const Checked all = checked([](Keypoints& k) {
    for (auto& frame : k.uvc)
      for (Vector3d& p : frame) p.x() = 1e12;
  });
  EXPECT_EQ(all.failure, "a.npz: keypoints_2d: expected pixels, found points 1e+12 px away");
}

TEST(KeypointCheck, ReportsKeypointsWithoutAnyDetection) {
  for (const double confidence : {0.0, -1.0}) {
    const Checked none = checked([&](Keypoints& k) {
      for (auto& frame : k.uvc)
        for (Vector3d& p : frame) p.z() = confidence;
    });
    EXPECT_EQ(none.failure, "");
    ASSERT_EQ(none.decisions.size(), 1u) << confidence;
    EXPECT_NE(none.decisions[0].find("none is detected"), std::string::npos) << none.decisions[0];
  }
}

TEST(KeypointCheck, RejectsInvalidDetectionsAndCamerasInOneLine) {
  const auto scale = [](double by) {
    return [by](Keypoints& k) { k.extrinsics[0].topLeftCorner<3, 3>() *= by; };
  };
  const auto uv = [](Keypoints& k) {
    for (auto& frame : k.uvc)
      for (Vector3d& p : frame) p = {p.x() / 1920.0, p.y() / 1080.0, p.z()};
  };
  const std::vector<std::pair<std::function<void(Keypoints&)>, std::string>> cases = {
      {uv, "expected pixels, as the focal length is, found coordinates up to 0.4648"},
      {[](Keypoints& k) { k.uvc[0][0].z() = 255.0; }, "expected confidences between 0 and 1, found 255"},
      {[](Keypoints& k) {
         k.names = {"nose", "nose"};
       },
       "expected 2 different names, found 'nose' twice"},
      {[](Keypoints& k) { k.intrinsics(1, 1) = -1200; },
       "expected focal lengths over 0, found 1200 and -1200"},
      {[](Keypoints& k) { k.intrinsics.transposeInPlace(); }, "found a last row of 960 540 1"},
      {[](Keypoints& k) { k.extrinsics[0].col(0) *= -1.0; }, "found a mirrored camera"},
      {scale(100.0), "found a rotation scaled by 100"},
      {scale(0.0), "found other axes than right angles"},
      {[](Keypoints& k) { k.extrinsics[0](0, 0) += 0.3; }, "found other axes than right angles"},
      {[](Keypoints& k) { k.extrinsics[0].transposeInPlace(); }, "a transposed matrix?"}};
  for (const auto& [change, words] : cases) {
    const std::string failure = checked(change).failure;
    EXPECT_NE(failure.find(words), std::string::npos) << words << "\n" << failure;
    EXPECT_EQ(failure.find('\n'), std::string::npos);
  }
  const Checked moving = checked([](Keypoints& k) {
    k.extrinsics.assign(10, k.extrinsics[0]);
    k.extrinsics[7].col(1) *= -1.0;
  });
  EXPECT_NE(moving.failure.find("camera_extrinsics, frame 7"), std::string::npos) << moving.failure;
}

}  // namespace
}  // namespace mimicx::motion
