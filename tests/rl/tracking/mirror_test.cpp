#include "rl/tracking/mirror.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "rl/tracking/tracking_fixture.h"

namespace mimicx::rl::tracking {
namespace {

/// The body that a body becomes in the mirror, by its name.
int counterpart(int body) {
  std::string name(kBodyNames[body]);
  if (name.starts_with("left"))
    name.replace(0, 4, "right");
  else if (name.starts_with("right"))
    name.replace(0, 5, "left");
  return body_of_name(name);
}

const Eigen::DiagonalMatrix<double, 3> kWorldMirror(1, -1, 1), kBodyMirror(-1, 1, 1);

/// R → M R M′ by matrices: an oracle that is independent of the layout of states.
Quaterniond mirrored(const Eigen::DiagonalMatrix<double, 3>& after, const Quaterniond& q) {
  return Quaterniond(Matrix3d(after * q.toRotationMatrix() * kBodyMirror));
}

/// Angular velocity as the vector of M [ω]× M.
Vector3d mirrored_spin(const Vector3d& omega) {
  Matrix3d cross;
  cross << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
  const Matrix3d image = kBodyMirror * cross * kBodyMirror;
  return {image(2, 1), image(0, 2), image(1, 0)};
}

motion::ReferenceFrame mirrored(const motion::ReferenceFrame& frame) {
  motion::ReferenceFrame image;
  image.p_root = kWorldMirror * frame.p_root;
  image.v_root = kWorldMirror * frame.v_root;
  image.q[0] = mirrored(kWorldMirror, frame.q[0]);
  for (int body = 1; body < kBodies; ++body)
    image.q[body] = mirrored(kBodyMirror, frame.q[counterpart(body)]);
  for (int body = 0; body < kBodies; ++body)
    image.omega[body] = mirrored_spin(frame.omega[counterpart(body)]);
  return image;
}

std::vector<float> state_values(const Pose& reference, const Pose& simulated) {
  std::vector<float> state(kStateSize);
  tracking_state(reference, joint_features(reference.frame), {0.3, -0.2}, simulated, state.data());
  return state;
}

std::vector<float> reflected(const MirrorMap& map, const std::vector<float>& in) {
  std::vector<float> out(in.size());
  reflect(map, in.data(), out.data());
  return out;
}

TEST(Mirror, StateOfMirroredPosesIsTheMirroredState) {
  const Character character = make_character();
  const MirrorMap map = mirror_of_state();
  ASSERT_EQ(map.size(), kStateSize);
  Random random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const motion::ReferenceFrame a = random_frame(random, 0.5), b = random_frame(random, 0.5);
    const std::vector<float> image =
        reflected(map, state_values(pose_of(character, a), pose_of(character, b)));
    const std::vector<float> expected =
        state_values(pose_of(character, mirrored(a)), pose_of(character, mirrored(b)));
    for (int k = 0; k < kStateSize; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      ASSERT_NEAR(image[entry], expected[entry], 2e-5) << "entry " << k;
    }
  }
}

TEST(Mirror, AppliedTwiceIsTheIdentity) {
  for (const MirrorMap& map : {mirror_of_state(), mirror_of_action()}) {
    std::vector<float> in(static_cast<std::size_t>(map.size()));
    std::iota(in.begin(), in.end(), 1.0F);
    EXPECT_EQ(reflected(map, reflected(map, in)), in);
    EXPECT_NE(reflected(map, in), in);
  }
}

motion::Reference mirrored(motion::Reference reference) {
  for (int t = 0; t < reference.size(); ++t) {
    motion::ReferenceFrame& frame = reference.frames[t];
    frame = mirrored(frame);
    reference.poses[t] = forward_kinematics(reference.character, frame.p_root, frame.q);
  }
  return reference;
}

TEST(Mirror, MirroredActionsLeadToMirroredStates) {
  const motion::Reference reference = swaying_reference(30);
  const TrackingConfig config;
  TrackingPack pack(make_tracking_clip(reference, config), config);
  TrackingPack image(make_tracking_clip(mirrored(reference), config), config);
  const auto scratch = std::make_unique<physics::Data<TrackingPack::P>>();
  for (int lane = 0; lane < physics::kLanes; ++lane) {
    pack.reset(lane, 3);
    image.reset(lane, 3);
  }
  Random random(9);
  std::vector<float> action(kDofs), state(kStateSize), of_image(kStateSize);
  for (int step = 0; step < 8; ++step) {
    for (int lane = 0; lane < physics::kLanes; ++lane) {
      for (float& a : action) a = static_cast<float>(0.2 * random.normal());
      pack.act(lane, action.data());
      image.act(lane, reflected(mirror_of_action(), action).data());
    }
    pack.advance(*scratch);
    image.advance(*scratch);
  }
  float moved = 0.0F;
  for (int lane = 0; lane < physics::kLanes; ++lane) {
    pack.observe(lane, state.data());
    image.observe(lane, of_image.data());
    const std::vector<float> expected = reflected(mirror_of_state(), state);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      // Rounding grows over 8 control steps; entries of 0.1 to 10 agree to a thousandth.
      ASSERT_NEAR(of_image[k], expected[k], 2e-3F * std::max(1.0F, std::abs(expected[k])))
          << "lane " << lane << ", entry " << k;
      moved = std::max(moved, std::abs(expected[k] - state[k]));
    }
  }
  EXPECT_GT(moved, 0.5F) << "the motion is its own mirror image and shows nothing";
}

}  // namespace
}  // namespace mimicx::rl::tracking
