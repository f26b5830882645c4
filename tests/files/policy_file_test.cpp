// A policy on disk: complete enough to be run again to the bit, and refused where it is damaged.
#include "files/policy_file.h"

#include <gtest/gtest.h>

#include "core/npz/npz.h"
#include "core/setting.h"
#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "motion/prepare/prepare.h"
#include "physics/lanes.h"
#include "rl/tracking/tracking_rollout.h"
#include "synth/synthesize.h"

namespace mimicx::files {
namespace {

struct PolicyFile : testing::Test {
  PolicyFile() {
    synth::SynthConfig config;
    config.kind = "squat";
    clip = synth::synthesize(config);
    motion::Reference reference = motion::prepare_reference(clip, {}, nullptr);
    reference.frames.resize(20);
    for (const physics::State<double>& x : rl::tracking::simulator_states(reference)) {
      physics::State<double> held = physics::lane_of(physics::in_all_lanes<physics::Pack<4>>(x), 0);
      stored.states.push_back(held);
    }
    stored.motion = rl::tracking::reference_of_states(reference, stored.states);
    stored.simulation.friction = 0.7;
    rl::AgentShape shape;
    shape.observation_dim = rl::tracking::kStateSize;
    shape.action_dim = kDofs;
    shape.hidden = {16};
    shape.last_scale = 0.3f;
    stored.agent = rl::make_agent(shape, 4);
    write_policy(file, clip, stored);
  }
  static PerBody<Vector3d> end_of(const StoredPolicy& policy) {
    const rl::tracking::TrackingConfig task = policy.task();
    return rl::tracking::roll_out(rl::tracking::make_tracking_clip(policy.motion, task), task,
                                  rl::tracking::mean_action({policy.agent}))
        .poses.back()
        .p_WB;
  }
  TemporaryFolder folder;
  std::filesystem::path file = folder.path / "squat.npz";
  motion::Clip clip;
  StoredPolicy stored;
};

TEST_F(PolicyFile, RoundTripGivesTheSameActions) {
  const StoredPolicy read = read_policy(file);
  EXPECT_EQ(read.simulation.friction, 0.7);
  EXPECT_EQ(read.motion.fps, stored.motion.fps);
  EXPECT_EQ(end_of(read), end_of(stored));
}

TEST_F(PolicyFile, HasTheSettingsOfActionsThatAreNotTheDefault) {
  const NamedValues usual = settings_of(stored.actions);
  for (const auto& [name, value] : usual) EXPECT_FALSE(read_npz(file).has(name)) << name;
  stored.actions.max_action = 0.01;
  stored.actions.ramp = false;
  write_policy(file, clip, stored);
  const StoredPolicy read = read_policy(file);
  EXPECT_EQ(read.actions, stored.actions);
  EXPECT_FALSE(read_npz(file).has("residual_actions"));
  EXPECT_EQ(end_of(read), end_of(stored));
  stored.actions = {};
  EXPECT_NE(end_of(read), end_of(stored));
  Npz damaged = read_npz(file);
  const double impossible = -1.0;
  damaged.set("max_action", NpyArray::from_double({1}, &impossible));
  EXPECT_THROW(policy_from(damaged), DataError);
}

TEST_F(PolicyFile, KnowsTheSceneItActsOn) {
  EXPECT_TRUE(read_policy(file).motion.scene.flat());
  stored.motion.scene.plates.push_back({{0.0, 0.0}, 0.3, {1.0, 1.0}, 0.2});
  write_policy(file, clip, stored);
  EXPECT_EQ(read_policy(file).motion.scene, stored.motion.scene);
}

TEST_F(PolicyFile, IsAlsoAMotionFile) {
  const motion::Clip read = motion::read_clip(file);
  EXPECT_EQ(read.frames(), 20);
  EXPECT_EQ(read.betas, clip.betas);
}

TEST_F(PolicyFile, RejectsAFileWithoutItsNetworkByName) {
  motion::write_clip(file, clip);
  try {
    read_policy(file);
    FAIL() << "a plain motion is no policy";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("state_q"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace mimicx::files
