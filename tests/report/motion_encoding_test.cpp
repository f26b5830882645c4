#include "report/motion_encoding.h"

#include <gtest/gtest.h>

#include <numbers>

#include "report/digits_reader.h"

namespace mimicx::report {
namespace {

constexpr std::size_t kFrame = 9 + 6 * kBodies;

BodyPoses twisted_pose(const Character& character, double angle, const Vector3d& place = {1.5, -2.0, 0.9}) {
  PerBody<Quaterniond> q;
  for (int b = 0; b < kBodies; ++b) q[b] = exp_map(Vector3d(0.1 * angle, -0.2 * angle, 0.05 * b));
  q[0] = exp_map(Vector3d(0.0, angle, 0.0));
  return forward_kinematics(character, place, q);
}

/// Poses as the page makes them: the pelvis, turns of all bodies, and bones.
BodyPoses posed_by_page(const std::string& text, std::size_t frame, const Character& c) {
  BodyPoses poses;
  for (std::size_t b = 0; b < kBodies; ++b) {
    Vector3d turn;
    for (std::size_t i = 0; i < 3; ++i)
      turn[static_cast<int>(i)] =
          number_at(text, frame * kFrame + 9 + 6 * b + 2 * i, 2) * std::numbers::pi / 2048.0;
    const double angle = turn.norm();
    poses.q_WB[b] =
        angle > 0.0 ? Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) : Quaterniond::Identity();
    if (b == 0)
      for (std::size_t i = 0; i < 3; ++i)
        poses.p_WB[0][static_cast<int>(i)] = 1e-3 * number_at(text, frame * kFrame + 3 * i, 3);
    else
      poses.p_WB[b] = poses.p_WB[kParents[b]] + poses.q_WB[kParents[b]] * c.joint_offset[b];
  }
  return poses;
}

TEST(MotionEncoding, PosesRoundTripToAMillimetreAndATenthOfADegree) {
  const Character c = make_character();
  const std::vector<BodyPoses> poses = {twisted_pose(c, 0.0), twisted_pose(c, 3.1),
                                        twisted_pose(c, 1.0, {-99.0, 120.0, 3.0})};
  const std::string text = encode_poses(poses);
  ASSERT_EQ(text.size(), poses.size() * kFrame);
  for (std::size_t t = 0; t < poses.size(); ++t) {
    const BodyPoses back = posed_by_page(text, t, c);
    for (int b = 0; b < kBodies; ++b) {
      EXPECT_LT((back.p_WB[b] - poses[t].p_WB[b]).norm(), 1.5e-3) << b;
      EXPECT_LT(back.q_WB[b].angularDistance(poses[t].q_WB[b]), 0.1 * std::numbers::pi / 180.0) << b;
    }
  }
}

TEST(MotionEncoding, ArrowsAreInMillimetresAndNewtons) {
  files::FloorArrows frame;
  frame[1] = {{0.1234, -40.0, 0.0}, {-12.0, 3.4, 1500.0}};
  const std::string text = encode_ground({frame});
  ASSERT_EQ(text.size(), 45u);
  const std::vector<int> expected = {123, -40000, -12, 3, 1500};
  for (std::size_t k = 0; k < 15; ++k)
    EXPECT_EQ(number_at(text, 3 * k, 3), k < 5 || k >= 10 ? 0 : expected[k - 5]) << k;
}

TEST(MotionEncoding, CentresAreInMillimetres) {
  const Character c = make_character();
  const BodyPoses pose = twisted_pose(c, 0.4);
  const std::string text = encode_centers(c, {pose});
  ASSERT_EQ(text.size(), 9u);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(1e-3 * number_at(text, 3 * static_cast<std::size_t>(k), 3), center_of_mass(c, pose)[k],
                0.501e-3);
}

TEST(MotionEncoding, SupportIsCountedAndRelativeToThePelvis) {
  const Character c = make_character();
  const std::vector<BodyPoses> poses = {twisted_pose(c, 0.0), twisted_pose(c, 0.0)};
  const std::string text = encode_support({{}, {{1.4, -2.1}, {1.6, -2.0}}}, poses);
  ASSERT_EQ(text.size(), 1u + 1u + 8u);
  EXPECT_EQ(count_at(text, 0, 1), 0) << "in the air";
  EXPECT_EQ(count_at(text, 1, 1), 2);
  const std::vector<int> expected = {-100, -100, 100, 0};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(number_at(text, 2 + 2 * k, 2), expected[k]);
}

TEST(MotionEncoding, TorquesAreInThousandthsOfTheirBounds) {
  PerBody<double> shares{};
  shares[4] = 0.1234;
  shares[21] = 1.25;
  const std::string text = encode_torques({shares});
  ASSERT_EQ(text.size(), 2u * kBodies);
  for (std::size_t b = 0; b < kBodies; ++b)
    EXPECT_EQ(number_at(text, 2 * b, 2), b == 4 ? 123 : b == 21 ? 1250 : 0);
}

}  // namespace
}  // namespace mimicx::report
