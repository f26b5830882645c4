// The header computes what the program computes: equal bits where neither fuses operations.
#include "policy_export/runtime.h"

#include <gtest/gtest.h>

#include "core/so3.h"
#include "policy_export/small_policy.h"

namespace mimicx::policy_export {
namespace {

#ifdef MIMICX_FUSED
constexpr float kRounding = 2e-5F;  // the program's products are fused here
#else
constexpr float kRounding = 0.0F;
#endif

struct Largest {
  float observation = 0.0F, action = 0.0F, target = 0.0F, velocity = 0.0F;
};

void compare(float a, float b, float& largest) { largest = std::max(largest, std::abs(a - b)); }

/// The simulator's state as the runtime has it.
State from_physics(const physics::State<double>& state) {
  State out;
  const auto put = [](const physics::Vec3<double>& v, float* to) {
    to[0] = static_cast<float>(v.x);
    to[1] = static_cast<float>(v.y);
    to[2] = static_cast<float>(v.z);
  };
  put(state.p_root, out.p_root);
  put(state.v_root, out.v_root);
  for (int i = 0; i < kBodies; ++i) {
    const physics::Quat<double>& q = state.q[i];
    const double values[4] = {q.w, q.x, q.y, q.z};
    for (int k = 0; k < 4; ++k) out.q[i][k] = static_cast<float>(values[k]);
    put(state.omega[i], out.omega[i]);
  }
  return out;
}

/// Differences between the program's pack and the runtime over a roll-out, from the first frame that is
/// simulated.
Largest differences(const ExportedPolicy& exported) {
  using rl::tracking::TrackingPack;
  rl::tracking::TrackingConfig task;
  task.actions = exported.meant.actions;
  TrackingPack pack(rl::tracking::make_tracking_clip(exported.meant.motion, task), task);
  const auto act = rl::tracking::mean_action({exported.meant.agent});
  physics::Data<TrackingPack::P> scratch;
  Largest largest;
  for (int t = 0; t + 1 < exported.meant.motion.size(); ++t) {
    std::array<float, kStateCount> observation;
    std::array<float, kActionCount> action;
    pack.observe(0, observation.data());
    act(0, observation.data(), action.data());
    for (int lane = 0; lane < physics::kLanes; ++lane) pack.act(lane, action.data());
    if (t > 0) {
      const Record answered = answer(exported, t, from_physics(physics::lane_of(pack.state(), 0)));
      for (std::size_t k = 0; k < kStateCount; ++k)
        compare(answered.observation[k], observation[k], largest.observation);
      for (std::size_t k = 0; k < kActionCount; ++k) compare(answered.action[k], action[k], largest.action);
      const std::vector<float> saved = pack.save();  // p_root, v_root, q, omega; then the targets' q, omega
      const auto value = [&](int k) { return saved[static_cast<std::size_t>(k * physics::kLanes)]; };
      constexpr int kTargets = 6 + 7 * kBodies, kVelocities = kTargets + 4 * kBodies;
      for (int body = 1; body < kBodies; ++body) {
        for (int k = 0; k < 4; ++k)
          compare(answered.targets.q[body][k], value(kTargets + 4 * body + k), largest.target);
        for (int k = 0; k < 3; ++k)
          compare(answered.targets.omega[body][k], value(kVelocities + 3 * body + k), largest.velocity);
      }
    }
    pack.advance(scratch);
  }
  return largest;
}

TEST(PolicyRuntime, PoliciesOnScenesAreRefused) {
  files::StoredPolicy on_a_step = small_policy();
  on_a_step.motion.scene.plates.push_back({{0.0, 0.0}, 0.0, {1.0, 1.0}, 0.2});
  EXPECT_THROW(export_policy(on_a_step, false), std::invalid_argument);
}

TEST(PolicyRuntime, MatchesTheProgram) {
  for (const ExportedPolicy* exported : {&exported_in_float(), &exported_in_8_bits()}) {
    const Largest largest = differences(*exported);
    EXPECT_LE(largest.observation, kRounding) << "in 8 bits: " << exported->in_8_bits;
    EXPECT_LE(largest.action, kRounding) << "in 8 bits: " << exported->in_8_bits;
    EXPECT_LE(largest.target, kRounding) << "in 8 bits: " << exported->in_8_bits;
    EXPECT_EQ(largest.velocity, 0.0F) << "in 8 bits: " << exported->in_8_bits;
  }
}

/// The reference as an option with this encoder sees it.
std::shared_ptr<const rl::tracking::TrackingClip> coded(const motion::Reference& motion,
                                                        const nn::AutoEncoder& coder) {
  auto clip = std::make_shared<rl::tracking::TrackingClip>(*rl::tracking::make_tracking_clip(motion, {}));
  rl::tracking::EncodedReference& encoded = clip->encoded.emplace_back();
  encoded.code_size = coder.code_size();
  for (const rl::tracking::Pose& pose : clip->poses) {
    nn::Matrix<float> features(1, kPoseCount), code, decoded;
    rl::tracking::own_pose_features(pose, features.data());
    nn::encode(coder, features, code, decoded);
    encoded.codes.insert(encoded.codes.end(), code.data(), code.data() + code.size());
    std::copy_n(decoded.data(), kPoseCount, encoded.decoded.emplace_back().begin());
  }
  return clip;
}

TEST(PolicyRuntime, SeesAndDecidesAsAnOptionWithItsEncoder) {
  const ExportedPolicy& exported = exported_option();
  rl::tracking::TrackingPack pack(coded(exported.meant.motion, *exported.coder), {});
  const auto act = rl::tracking::mean_action({exported.meant.agent});
  physics::Data<rl::tracking::TrackingPack::P> scratch;
  Largest largest;
  for (int t = 0; t + 1 < exported.meant.motion.size(); ++t) {
    std::array<float, kStateCount> observation{};
    std::array<float, kActionCount> action{};
    pack.observe(0, observation.data());
    act(0, observation.data(), action.data());
    for (int lane = 0; lane < physics::kLanes; ++lane) pack.act(lane, action.data());
    if (t > 0) {
      const Record answered = answer(exported, t, from_physics(physics::lane_of(pack.state(), 0)));
      for (int k = 0; k < exported.meant.agent.actor.inputs(); ++k)
        compare(answered.observation[static_cast<std::size_t>(k)], observation[static_cast<std::size_t>(k)],
                largest.observation);
      for (std::size_t k = 0; k < kActionCount; ++k) compare(answered.action[k], action[k], largest.action);
    }
    pack.advance(scratch);
  }
  EXPECT_LE(largest.observation, kRounding);
  EXPECT_LE(largest.action, kRounding);
}

TEST(PolicyRuntime, RotationsAreThoseOfTheCore) {
  Random random(3, {});
  for (int trial = 0; trial < 2000; ++trial) {
    const double size = trial % 2 == 0 ? 4.3 : 1e-5;
    const Vector3d r(size * (random.uniform() - 0.5), size * (random.uniform() - 0.5),
                     size * (random.uniform() - 0.5));
    const Quaterniond expected = mimicx::exp_map(r);
    const Quaternion q = exponential({r.x(), r.y(), r.z()});
    EXPECT_NEAR(q.w, expected.w(), 4e-16);
    EXPECT_NEAR(q.x, expected.x(), 4e-16);
    EXPECT_NEAR(q.y, expected.y(), 4e-16);
    EXPECT_NEAR(q.z, expected.z(), 4e-16);
    const double y = random.uniform(), x = random.uniform();
    EXPECT_NEAR(arc(y, x), std::atan2(y, x), 1e-15);
  }
}

TEST(PolicyRuntime, KeepsTheBoundOfActionsOfThePolicy) {
  files::StoredPolicy policy = small_policy();
  policy.actions.max_action = 1.0 / 256.0;  // the runtime has it as a float
  const Largest largest = differences(export_policy(policy, false));
  EXPECT_LE(largest.observation, kRounding);
  EXPECT_LE(largest.target, kRounding);
}

TEST(PolicyRuntime, PoliciesWithOtherActionsAreRefused) {
  for (const auto& change :
       {+[](rl::tracking::ActionSettings& actions) { actions.ramp = false; },
        +[](rl::tracking::ActionSettings& actions) { actions.mode = rl::tracking::ActionMode::kAbsolute; }}) {
    files::StoredPolicy policy = small_policy();
    change(policy.actions);
    EXPECT_THROW(export_policy(policy, false), std::invalid_argument);
  }
}

TEST(PolicyRuntime, NonFiniteActionGivesTheReferencePose) {
  with_policy(exported_in_float(), [](const auto& policy) {
    const State next = motion_at(policy.motion, 5);
    std::array<float, kActionCount> action{};
    const Targets rest = targets_of(policy, next, action.data());
    action.fill(std::numeric_limits<float>::quiet_NaN());
    action[3] = std::numeric_limits<float>::infinity();
    const Targets targets = targets_of(policy, next, action.data());
    action.fill(1e9F);
    const Targets far = targets_of(policy, next, action.data());
    action.fill(policy.max_action);
    const Targets farthest = targets_of(policy, next, action.data());
    for (int body = 1; body < kBodies; ++body)
      for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(targets.q[body][k], rest.q[body][k]);
        EXPECT_EQ(far.q[body][k], farthest.q[body][k]);
      }
  });
}

TEST(PolicyRuntime, NonFiniteStateGivesTheReferencePose) {
  State lost = motion_at(exported_in_8_bits().motion.view(), 5);
  lost.v_root[0] = std::numeric_limits<float>::quiet_NaN();
  const Record answered = answer(exported_in_8_bits(), 5, lost);
  EXPECT_TRUE(std::isnan(answered.action[0]));
  with_policy(exported_in_8_bits(), [&](const auto& policy) {
    const std::array<float, kActionCount> none{};
    const Targets rest = targets_of(policy, motion_at(policy.motion, 6), none.data());
    for (int body = 1; body < kBodies; ++body)
      for (int k = 0; k < 4; ++k) EXPECT_EQ(answered.targets.q[body][k], rest.q[body][k]);
  });
}

TEST(PolicyRuntime, TheMotionEndsAtRest) {
  const Motion motion = exported_in_float().motion.view();
  const State last = motion_at(motion, motion.frames - 1), after = motion_at(motion, motion.frames);
  for (int body = 0; body < kBodies; ++body) {
    for (int k = 0; k < 4; ++k) EXPECT_EQ(after.q[body][k], last.q[body][k]);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(after.omega[body][k], 0.0F);
  }
  for (int k = 0; k < 3; ++k) EXPECT_EQ(after.v_root[k], 0.0F);
}

}  // namespace
}  // namespace mimicx::policy_export
