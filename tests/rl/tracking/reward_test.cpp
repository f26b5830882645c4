#include "rl/tracking/reward.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rl/tracking/tracking_fixture.h"
#include "synth/noise/estimator_noise.h"

namespace mimicx::rl::tracking {
namespace {

TEST(TrackingReward, IsOneOnTheReference) {
  const Character character = make_character();
  Random random(7);
  const Pose pose = pose_of(character, random_frame(random, 0.5));
  const Reward reward = tracking_reward({}, pose, pose, nullptr);
  EXPECT_NEAR(reward.total, 1.0, 1e-12);
}

TEST(TrackingReward, TermsFollowTheirClosedForms) {
  const Character character = make_character();
  Random random(8);
  const Pose pose = pose_of(character, random_frame(random, 0.3));
  const RewardWeights w;

  const Reward shifted = tracking_reward(w, pose, moved(character, pose, 0.0, {0.03, 0.04}), nullptr);
  EXPECT_NEAR(shifted.term[0], std::exp(-w.root_position * 0.0025), 1e-9);
  EXPECT_NEAR(shifted.total, shifted.term[0], 1e-9) << "a shift must not touch any other term";

  motion::ReferenceFrame bent = pose.frame;
  bent.q[kHead] = bent.q[kHead] * exp_map(Vector3d(0.2, 0, 0));  // moves no end effector
  const Reward nod = tracking_reward(w, pose, pose_of(character, bent), nullptr);
  EXPECT_NEAR(nod.term[2], std::exp(-w.pose * 0.04 / 21.0), 1e-9);
  EXPECT_NEAR(nod.total, nod.term[2], 1e-9);

  motion::ReferenceFrame faster = pose.frame;
  faster.omega[kNeck] += Vector3d(3, 0, 4);
  const Reward fast = tracking_reward(w, pose, pose_of(character, faster), nullptr);
  EXPECT_NEAR(fast.term[3], std::exp(-w.velocity * 25.0 / 21.0), 1e-9);

  Pose lifted = pose;
  lifted.p_WB[kLeftWrist].z() += 0.1;
  EXPECT_NEAR(tracking_reward(w, pose, lifted, nullptr).term[4], std::exp(-w.end_effector * 0.01 / 4.0),
              1e-9);
}

/// The whole body turned about the pelvis, which keeps its place.
Pose turned(const Character& character, const Pose& pose, const Quaterniond& turn) {
  motion::ReferenceFrame f = pose.frame;
  f.q[0] = turn * f.q[0];
  return pose_of(character, f);
}

// End effectors are compared in the frame of the pelvis, so a turn of the whole body counts once.
TEST(TrackingReward, TurnOfTheWholeBodyChangesTheRootRotationTermOnly) {
  const Character character = make_character();
  Random random(9);
  const RewardWeights w;
  for (const Vector3d& axis : {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(0.6, 0, -0.8)}) {
    const Pose pose = pose_of(character, random_frame(random, 0.3));
    const Pose other = turned(character, pose, exp_map(0.3 * axis));
    const Reward reward = tracking_reward(w, pose, other, nullptr);
    EXPECT_NEAR(reward.term[1], std::exp(-w.root_rotation * 0.09), 1e-9);
    EXPECT_NEAR(reward.term[4], 1.0, 1e-9);
    EXPECT_NEAR(reward.total, reward.term[1], 1e-9);
  }
}

/// Angle of the rotation that leads from a to b, from the trace of its matrix.
double angle_by_trace(const Quaterniond& a, const Quaterniond& b) {
  const Matrix3d between = a.toRotationMatrix().transpose() * b.toRotationMatrix();
  return std::acos(std::clamp(0.5 * (between.trace() - 1.0), -1.0, 1.0));
}

/// Eq. 2 without its keypoints, written with matrices and the standard library.
Array<double, kRewardTerms> terms_by_matrices(const RewardWeights& w, const Pose& a, const Pose& b) {
  double pose = 0.0, velocity = 0.0, effectors = 0.0;
  for (int body = 1; body < kBodies; ++body) {
    pose += std::pow(angle_by_trace(a.frame.q[body], b.frame.q[body]), 2);
    for (int k = 0; k < 3; ++k) velocity += std::pow(a.frame.omega[body][k] - b.frame.omega[body][k], 2);
  }
  const auto local = [](const Pose& p, int body) {  // by the inverse of the pelvis' homogeneous matrix
    Eigen::Matrix4d pelvis = Eigen::Matrix4d::Identity();
    pelvis.topLeftCorner<3, 3>() = p.frame.q[0].toRotationMatrix();
    pelvis.topRightCorner<3, 1>() = p.p_WB[0];
    return Vector3d((pelvis.inverse() * p.p_WB[body].homogeneous()).head<3>());
  };
  for (int body : {kLeftWrist, kRightWrist, kLeftFoot, kRightFoot})
    effectors += (local(a, body) - local(b, body)).squaredNorm();
  const double root = (a.p_WB[0] - b.p_WB[0]).squaredNorm(),
               turn = std::pow(angle_by_trace(a.frame.q[0], b.frame.q[0]), 2);
  return {std::exp(-w.root_position * root),
          std::exp(-w.root_rotation * turn),
          std::exp(-w.pose * pose / 21.0),
          std::exp(-w.velocity * velocity / 21.0),
          std::exp(-w.end_effector * effectors / 4.0),
          1.0};
}

TEST(TrackingReward, EqualsEq2ByMatricesOnRandomPairsOfPoses) {
  const Character character = make_character();
  Random random(10);
  RewardWeights w;  // small enough for pairs of random poses to keep digits, and all different
  w.root_position = 0.11, w.root_rotation = 0.23, w.pose = 0.37, w.velocity = 0.41, w.end_effector = 0.53;
  for (int trial = 0; trial < 50; ++trial) {
    const Pose a = pose_of(character, random_frame(random, 0.4)),
               b = pose_of(character, random_frame(random, 0.4));
    const Reward reward = tracking_reward(w, a, b, nullptr);
    const auto expected = terms_by_matrices(w, a, b);
    double product = 1.0;
    for (int k = 0; k < kRewardTerms; ++k) {
      EXPECT_NEAR(reward.term[k], expected[k], 1e-9) << kRewardTermNames[k] << ", trial " << trial;
      product *= expected[k];
    }
    EXPECT_NEAR(reward.total, product, 1e-9);
    EXPECT_LT(product, 0.9) << "the poses must differ";
  }
}

motion::Keypoints camera_and_points(const Pose& pose) {
  motion::Keypoints k;
  k.intrinsics << 1000, 0, 500, 0, 1000, 500, 0, 0, 1;
  Eigen::Matrix4d e = Eigen::Matrix4d::Identity();  // looks along world +y from y = −5
  e.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  e.topRightCorner<3, 1>() = Vector3d(0, 1, 5);
  k.extrinsics = {e};
  k.uvc.emplace_back();
  for (int i = 0; i < kBodies; ++i) {
    k.names.emplace_back(kBodyNames[i]);
    const Vector3d p = k.intrinsics * (e.topLeftCorner<3, 3>() * pose.p_WB[i] + e.topRightCorner<3, 1>());
    k.uvc[0].push_back({p.x() / p.z(), p.y() / p.z(), 1.0});
  }
  return k;
}

TEST(TrackingReward, ProjectionTermIsOneWithoutKeypointsAndWithoutError) {
  const Character character = make_character();
  const Pose pose = pose_of(character, swaying_reference(2).frames[0]);
  EXPECT_EQ(tracking_reward({}, pose, moved(character, pose, 0, {0.1, 0}), nullptr).term[5], 1.0);
  const auto frames = match_keypoints(camera_and_points(pose));
  EXPECT_NEAR(tracking_reward({}, pose, pose, &frames[0]).term[5], 1.0, 1e-12);
}

TEST(TrackingReward, ProjectionErrorIsMeasuredInBoxHeights) {
  const Character character = make_character();
  const Pose pose = pose_of(character, swaying_reference(2).frames[0]);
  motion::Keypoints keypoints = camera_and_points(pose);
  for (double zoom : {1.0, 3.0}) {  // the image's resolution must not matter
    motion::Keypoints scaled = keypoints;
    scaled.intrinsics.topRows<2>() *= zoom;
    double box = match_keypoints(keypoints)[0].box_height;
    for (auto& uvc : scaled.uvc[0]) uvc.head<2>() = zoom * (uvc.head<2>() + Eigen::Vector2d(0.02 * box, 0.0));
    const auto frames = match_keypoints(scaled);
    const RewardWeights w;
    EXPECT_NEAR(tracking_reward(w, pose, pose, &frames[0]).term[5], std::exp(-w.projection * 0.0004), 1e-6);
  }
}

TEST(TrackingReward, KeypointsWithoutConfidenceDoNotCount) {
  const Character character = make_character();
  const Pose pose = pose_of(character, swaying_reference(2).frames[0]);
  motion::Keypoints keypoints = camera_and_points(pose);
  keypoints.uvc[0][kLeftWrist] = {1e6, -1e6, 0.0};
  const auto frames = match_keypoints(keypoints);
  EXPECT_NEAR(tracking_reward({}, pose, pose, &frames[0]).term[5], 1.0, 1e-12);
}

/// `points` as a COCO-17 detector reports them: in its own order, with face keypoints that match no body.
motion::Keypoints as_coco17(const motion::Keypoints& points) {
  motion::Keypoints coco = points;
  coco.names = motion::keypoint_names(motion::KeypointSet::kCoco17);
  coco.uvc.assign(points.uvc.size(), {});
  for (std::size_t t = 0; t < points.uvc.size(); ++t)
    for (const std::string& name : coco.names) {
      const auto at = std::find(points.names.begin(), points.names.end(), name) - points.names.begin();
      const bool face = at == static_cast<std::ptrdiff_t>(points.names.size());
      coco.uvc[t].push_back(face ? Vector3d(-1e4, 1e4, 1.0) : points.uvc[t][static_cast<std::size_t>(at)]);
    }
  return coco;
}

TEST(TrackingReward, Coco17IsComparedJointByJointWithoutTheFace) {
  const Character character = make_character();
  const Pose pose = pose_of(character, swaying_reference(2).frames[0]);
  const motion::Keypoints coco = as_coco17(camera_and_points(pose));
  ASSERT_EQ(coco.names.size(), 17u);
  const auto frames = match_keypoints(coco);
  ASSERT_EQ(frames[0].detections.size(), 12u);
  const RewardWeights w;
  EXPECT_NEAR(tracking_reward(w, pose, pose, &frames[0]).term[5], 1.0, 1e-12);
  for (std::size_t k = 5; k < 17; ++k) {  // one joint a tenth of the box off counts for a twelfth
    motion::Keypoints off = coco;
    off.uvc[0][k].x() += 0.1 * frames[0].box_height;
    const auto moved_frames = match_keypoints(off);
    EXPECT_NEAR(tracking_reward(w, pose, pose, &moved_frames[0]).term[5],
                std::exp(-w.projection * 0.01 / 12.0), 1e-9)
        << coco.names[k];
  }
}

}  // namespace
}  // namespace mimicx::rl::tracking
