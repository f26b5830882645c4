// The controlled system: invalid arguments, and agreement of controls with actions of the tracking task.
#include "control/system.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "control/fixtures.h"
#include "control/tangent.h"
#include "rl/tracking/tracking_pack.h"

namespace mimicx::control {
namespace {

TEST(System, RejectsTooFewFramesAndMismatchedRates) {
  const Character character = make_character();
  const State<double> x = simulator_state(synthetic_reference("stand", 501, 2).frames[0]);
  EXPECT_THROW(make_system(character, {}, {x}, 30.0), std::invalid_argument);
  EXPECT_THROW(make_system(character, {}, {x, x}, 37.0), std::invalid_argument);
  EXPECT_EQ(make_system(character, {}, {x, x}, 60.0).substeps, 4);
}

// Some frames under random controls, simulated here and as actions of the tracking task.
TEST(System, ControlsGiveTheBytesOfTheTrackingTasksActions) {
  const motion::Reference walk = synthetic_reference("walk", 501, 20);
  const System system = system_of(walk);
  rl::tracking::TrackingConfig config;
  rl::tracking::TrackingPack pack(rl::tracking::make_tracking_clip(walk, config), config);
  const auto scratch = std::make_unique<Data<P>>();
  Random random(43);
  State<P> x = in_all_lanes<P>(system.at(0));
  Target<P> from = target_of(system, 0, Control{});
  for (int t = 0; t < 19; ++t) {
    Control u{};
    for (std::size_t k = 0; k < kDofs; ++k) u[k] = static_cast<float>(0.1 * random.normal());
    const Target<P> to = target_of(system, t + 1, u);
    advance(system, from, to, {}, x, *scratch);
    from = to;
    for (int lane = 0; lane < kLanes; ++lane) pack.act(lane, u.data());
    pack.advance(*scratch);
    const State<double> here = lane_of(x, 0);
    const motion::ReferenceFrame& there = pack.pose(0).frame;
    ASSERT_EQ(to_eigen(here.p_root), there.p_root) << "frame " << t + 1;
    ASSERT_EQ(to_eigen(here.v_root), there.v_root);
    for (std::size_t i = 0; i < kBodies; ++i) {
      ASSERT_EQ(to_eigen(here.q[i]).normalized().coeffs(), there.q[i].coeffs()) << kBodyNames[i];
      ASSERT_EQ(to_eigen(here.omega[i]), there.omega[i]) << kBodyNames[i];
    }
  }
}

TEST(System, AsFloatsRoundsEveryNumber) {
  const State<double> x = system_of(synthetic_reference("walk", 501, 3)).at(1);
  const State<double> rounded = as_floats(x);
  const auto expect_rounded = [](double found, double exact) {
    volatile float to_float = static_cast<float>(exact);  // volatile: the compiler must not skip the rounding
    EXPECT_EQ(found, static_cast<double>(to_float)) << exact;
  };
  const auto expect_vector = [&](const Vec3<double>& found, const Vec3<double>& exact) {
    expect_rounded(found.x, exact.x);
    expect_rounded(found.y, exact.y);
    expect_rounded(found.z, exact.z);
  };
  expect_vector(rounded.p_root, x.p_root);
  expect_vector(rounded.v_root, x.v_root);
  for (std::size_t i = 0; i < kBodies; ++i) {
    expect_vector(rounded.omega[i], x.omega[i]);
    expect_rounded(rounded.q[i].w, x.q[i].w);
    expect_rounded(rounded.q[i].x, x.q[i].x);
    expect_rounded(rounded.q[i].y, x.q[i].y);
    expect_rounded(rounded.q[i].z, x.q[i].z);
  }
}

TEST(System, AssistiveForceAcceleratesThePelvisOnlyInAnAssistedSystem) {
  System system = system_of(synthetic_reference("stand", 501, 5));
  const auto scratch = std::make_unique<Data<P>>();
  const auto after = [&](float push) {
    Control u{};
    u[kDofs] = push;
    State<P> x = in_all_lanes<P>(system.at(0));
    const Target<P> to = target_of(system, 1, u);
    advance(system, to, to, assistance_of(system, u), x, *scratch);
    return lane_of(x, 0);
  };
  EXPECT_EQ(after(0.0f).v_root.x, after(5.0f).v_root.x);
  system.assisted = true;
  // Both feet are on the floor, so the pelvis gains less than a free body would (5 m/s² · 1/30 s).
  const double gained = after(5.0f).v_root.x - after(0.0f).v_root.x;
  EXPECT_GT(gained, 0.05);
  EXPECT_LT(gained, 0.4);
}

}  // namespace
}  // namespace mimicx::control
