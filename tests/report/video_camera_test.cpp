#include "report/video_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/standing_clip.h"
#include "record/json.h"
#include "report/digits_reader.h"

namespace mimicx::report {
namespace {

constexpr int kCameraFrames = 4;
constexpr double kFocal = 800.0, kMiddleU = 400.0, kMiddleV = 300.0;

/// Four metres in front of the body, at the height of its hips, moving to the right by 1 cm a frame.
Vector3d seen_from(const Vector3d& p_W, int frame) {
  return {p_W.x() - 0.01 * frame, 0.9 - p_W.z(), p_W.y() + 4.0};
}

Eigen::Matrix4d pose_of_camera(int frame) {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topRows<3>() << 1, 0, 0, -0.01 * frame, 0, 0, -1, 0.9, 0, 1, 0, 4.0;
  return pose;
}

/// A clip whose wrists, left knee, head and pelvis were seen where they are, `beside` pixels to the right;
/// and a nose.
motion::Clip seen_clip(double beside = 0.0) {
  motion::Clip clip = motion::standing_clip(kCameraFrames);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  motion::Keypoints keypoints;
  keypoints.names = {"nose", "left_wrist", "right_wrist", "left_knee", "head", "pelvis"};
  keypoints.intrinsics << kFocal, 0, kMiddleU, 0, kFocal, kMiddleV, 0, 0, 1;
  for (int t = 0; t < kCameraFrames; ++t) {
    keypoints.extrinsics.push_back(pose_of_camera(t));
    keypoints.uvc.push_back({Vector3d(-1000.0, 5.0, 1.0)});
    for (const int body : {kLeftWrist, kRightWrist, kLeftKnee, kHead, kPelvis}) {
      const Vector3d p = seen_from(poses[t].p_WB[body], t);
      keypoints.uvc[t].emplace_back(kMiddleU + kFocal * p.x() / p.z() + beside,
                                    kMiddleV + kFocal * p.y() / p.z(), 0.5);
    }
  }
  clip.keypoints = keypoints;
  return clip;
}

/// From where the clip's own camera is.
std::vector<double> distances(const ReportCamera& camera, const PerFrame<BodyPoses>& poses) {
  return distances_from_seen(camera, camera.placed, poses);
}

TEST(ReportCamera, KeepsOnlyPointsOfTheBody) {
  const auto camera = camera_of(seen_clip());
  ASSERT_TRUE(camera);
  ASSERT_EQ(camera->points.size(), 5u) << "a nose is on no body";
  EXPECT_EQ(camera->points[3].body, kHead);
  // All hang on the pelvis: what is between was not seen.
  EXPECT_EQ(camera->bones, (std::vector<std::array<int, 2>>{{0, 4}, {1, 4}, {2, 4}, {3, 4}}));
  EXPECT_FALSE(camera_of(motion::standing_clip(kCameraFrames)));
  motion::Clip faces = seen_clip();
  faces.keypoints->names.assign(6, "nose");
  EXPECT_FALSE(camera_of(faces));
}

TEST(ReportCamera, DistancesAreInPixelsOfAMovingCamera) {
  const motion::Clip clip = seen_clip();
  for (const double px : distances(*camera_of(clip), poses_of(clip))) EXPECT_NEAR(px, 0.0, 1e-6);
  for (const double px : distances(*camera_of(seen_clip(7.0)), poses_of(clip))) EXPECT_NEAR(px, 7.0, 1e-6);
}

TEST(ReportCamera, WeighsByConfidence) {
  motion::Clip clip = seen_clip();
  for (auto& frame : clip.keypoints->uvc) {
    for (Vector3d& p : frame) p.z() = 0.0;
    frame[1] += Vector3d(3.0, 4.0, 0.75);
    frame[2] += Vector3d(9.0, 0.0, 0.25);
    frame[3].x() = 1e5;  // was not seen at all
  }
  for (const double px : distances(*camera_of(clip), poses_of(clip)))
    EXPECT_NEAR(px, 0.75 * 5.0 + 0.25 * 9.0, 1e-6);
}

TEST(ReportCamera, UndetectedPointsHaveNoDistance) {
  motion::Clip clip = seen_clip();
  auto poses = poses_of(clip);
  poses.push_back(poses.back());  // longer than what was seen
  for (Vector3d& p : clip.keypoints->uvc[1]) p.z() = 0.0;
  for (Vector3d& p : poses[2].p_WB) p.y() -= 10.0;  // behind the camera
  const std::vector<double> px = distances(*camera_of(clip), poses);
  ASSERT_EQ(px.size(), 5u);
  EXPECT_FALSE(std::isnan(px[0]) || std::isnan(px[3]));
  EXPECT_TRUE(std::isnan(px[1]) && std::isnan(px[2]) && std::isnan(px[4]));
}

TEST(ReportCamera, RoundTripsThroughThePage) {
  const auto camera = camera_of(seen_clip());
  const auto json = record::Json::parse(camera_json(*camera));
  EXPECT_FALSE(json.contains("told"));
  EXPECT_EQ(json.at("fx").get<double>(), kFocal);
  EXPECT_EQ(json.at("cy").get<double>(), kMiddleV);
  ASSERT_EQ(json.at("extrinsics").elements().size(), static_cast<std::size_t>(kCameraFrames));
  EXPECT_EQ(json.at("extrinsics").at(2).get<std::vector<double>>(),
            (std::vector<double>{1, 0, 0, -0.02, 0, 0, -1, 0.9, 0, 1, 0, 4.0}));
  EXPECT_EQ(json.at("points").at(0).get<std::vector<double>>(), (std::vector<double>{kLeftWrist, 0, 0, 0}));
  const auto seen = json.at("seen").get<std::string>();
  ASSERT_EQ(seen.size(), 7u * 5u * kCameraFrames);
  for (int t = 0; t < kCameraFrames; ++t)
    for (std::size_t k = 0; k < 5; ++k) {
      const std::size_t at = 7 * (5 * static_cast<std::size_t>(t) + k);
      EXPECT_NEAR(0.1 * number_at(seen, at, 3), camera->uvc[t][k].x(), 0.0501);
      EXPECT_NEAR(0.1 * number_at(seen, at + 3, 3), camera->uvc[t][k].y(), 0.0501);
      EXPECT_NEAR(count_at(seen, at + 6, 1) / 63.0, 0.5, 0.01);
    }
}

}  // namespace
}  // namespace mimicx::report
