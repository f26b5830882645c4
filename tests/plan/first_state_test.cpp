// A plan starts at rest with the ranges of its joints and with its self contacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "audit/audit.h"
#include "control/plan.h"
#include "core/units.h"
#include "motion/passing_hand.h"
#include "motion/prepare/prepare.h"
#include "rl/tracking/tracking_rollout.h"
#include "synth/synthesize.h"

namespace mimicx::plan {
namespace {

constexpr int kFrames = 30;

motion::Clip standing() {
  synth::SynthConfig config;
  config.kind = "stand";
  config.seed = 501;
  motion::Clip clip = synth::synthesize(config);
  clip.rotations.resize(kFrames);
  clip.trans.resize(kFrames);
  return clip;
}

/// The thigh is turned outwards, farther than a hip can, as noise may leave it.
motion::Clip with_a_hip_past_its_range() {
  motion::Clip clip = standing();
  for (auto& frame : clip.rotations)
    frame[kLeftHip] = log_map(exp_map(frame[kLeftHip]) * exp_map(Vector3d(0.0, 1.6, 0.0)));
  return clip;
}

/// What acted in the first frames of the plan of a clip.
struct Start {
  bool followed = false;
  double from_nowhere = 0;             ///< N, force that nothing explains
  double power = 0;                    ///< W, of all joints
  double range = 0;                    ///< N·m, torque of a range
  double self_contact = 0;             ///< N, in the first frame
  double hardest = 0;                  ///< N, self contact in any frame
  double lightest = 10, heaviest = 0;  ///< vertical force of the floor, body weights
};

Start start_of(const motion::Clip& clip, const motion::PreparationConfig& preparation, int first = 5) {
  const motion::Reference reference = motion::prepare_reference(clip, preparation, nullptr);
  control::PlanConfig config;
  config.assisted_stages = false;
  config.horizon.backtracks = 1;
  const control::Plan plan = control::make_plan(
      control::make_system(reference.character, {}, rl::tracking::simulator_states(reference), reference.fps),
      config, {.threads = 2});
  Start start;
  start.followed = plan.ending == control::Ending::kFollowed;
  const rl::tracking::TrackingConfig tracking;
  std::size_t t = 0;
  const auto rollout = rl::tracking::roll_out(
      rl::tracking::make_tracking_clip(reference, tracking), tracking, [&](int, const float*, float* action) {
        if (t < plan.residuals.size())
          std::copy(plan.residuals[t].begin(), plan.residuals[t].end(), action);
        else
          std::fill(action, action + kDofs, 0.0f);
        ++t;
      });
  audit::SimulatedFrames simulated;
  simulated.character = reference.character;
  for (int k = 0; k <= first; ++k) {
    simulated.frames.push_back(rollout.poses[static_cast<std::size_t>(k)].frame);
    simulated.forces.push_back(rollout.forces[static_cast<std::size_t>(k)]);
    double floor = 0.0;
    for (int body = 0; body < kBodies; ++body) {
      floor += simulated.forces.back().ground[body][5] / (kGravity * reference.character.total_mass());
      start.range = std::max(start.range, simulated.forces.back().range_torque[body].norm());
      const double contact = simulated.forces.back().self_contact[body].tail<3>().norm();
      if (k == 1) start.self_contact = std::max(start.self_contact, contact);
      start.hardest = std::max(start.hardest, contact);
    }
    if (k == 0) continue;  // no force belongs to the first state
    start.lightest = std::min(start.lightest, floor);
    start.heaviest = std::max(start.heaviest, floor);
  }
  for (const audit::AuditRow& row : audit::audit_frames(simulated, {}).rows) {
    start.from_nowhere = std::max(start.from_nowhere, row.root.tail<3>().norm());
    start.power = std::max(start.power, std::abs(row.power));
  }
  std::printf(
      "  measured: %s, %.2f N from nowhere, %.0f W, %.1f N·m of ranges, %.1f N of self contact (later %.0f "
      "N), "
      "%.3f to %.3f of the weight\n",
      start.followed ? "followed" : "lost", start.from_nowhere, start.power, start.range, start.self_contact,
      start.hardest, start.lightest, start.heaviest);
  return start;
}

TEST(FirstState, RestsInTheRangesOfItsJoints) {
  motion::PreparationConfig without;
  without.ranges = without.plant = false;
  const Start thrown = start_of(with_a_hip_past_its_range(), without),
              rests = start_of(with_a_hip_past_its_range(), {});
  EXPECT_GT(thrown.range, 100.0);
  EXPECT_TRUE(rests.followed);
  EXPECT_LT(rests.from_nowhere, 1.0);
  EXPECT_LT(rests.power, 100.0);
  EXPECT_LT(rests.range, 1.0);
}

// The soles are at the height at which they carry the weight, to within a tenth of a millimetre.
TEST(FirstState, RestsOnTheFloor) {
  const Start start = start_of(standing(), {});
  EXPECT_GT(start.lightest, 0.97);
  EXPECT_LT(start.heaviest, 1.03);
}

// A forearm is in the pelvis, by as much as a reference may keep.
TEST(FirstState, RestsInItsSelfContacts) {
  motion::Clip clip = standing();
  for (auto& frame : clip.rotations) frame[kLeftShoulder] += 0.3 * Vector3d(0, -0.35, -1);
  motion::PreparationConfig without;
  without.separate = false;
  const Start pushed = start_of(clip, without), rests = start_of(clip, {});
  EXPECT_GT(pushed.self_contact, 100.0);
  EXPECT_LT(rests.self_contact, 0.5 * pushed.self_contact);
  EXPECT_LT(rests.power, 0.5 * pushed.power);
}

// The whole plan of a reference that was led around the head, and of one that goes through it.
TEST(PassingHand, IsNotPushedByTheHead) {
  const motion::Clip clip = test::clip_with_passing_hand();
  motion::PreparationConfig without;
  without.separate = false;
  const Start through = start_of(clip, without, 89), around = start_of(clip, {}, 89);
  EXPECT_GT(through.hardest, 100.0);
  EXPECT_TRUE(around.followed);
  EXPECT_LT(around.hardest, 0.4 * through.hardest);
}

}  // namespace
}  // namespace mimicx::plan
