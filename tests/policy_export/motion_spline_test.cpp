// A motion as splines is near its states, however the body turns.
#include "policy_export/motion_spline.h"

#include <gtest/gtest.h>

#include <numbers>

#include "policy_export/small_policy.h"

namespace mimicx::policy_export {
namespace {

double angle_of(const physics::Quat<double>& a, const physics::Quat<double>& b) {
  return log_map(physics::to_eigen(a).normalized().conjugate() * physics::to_eigen(b).normalized()).norm();
}

/// A body that turns about the vertical at `speed`, rad/s, and swings a knee and a shoulder, 30 frames per
/// second.
List<physics::State<double>> turning(int frames, double speed) {
  List<physics::State<double>> states;
  for (int t = 0; t < frames; ++t) {
    const double s = t / 30.0;
    motion::ReferenceFrame frame;
    frame.p_root = Vector3d(std::sin(s), 0.2 * s, 0.9);
    frame.v_root = Vector3d(std::cos(s), 0.2, 0.0);
    frame.q.fill(Quaterniond::Identity());
    frame.omega.fill(Vector3d::Zero());
    frame.q[0] = rotation_z(speed * s) * mimicx::exp_map(Vector3d(0.5 * std::numbers::pi, 0.0, 0.0));
    frame.omega[0] = frame.q[0].conjugate() * Vector3d(0.0, 0.0, speed);
    frame.q[kLeftKnee] = mimicx::exp_map((1.0 + 0.5 * std::sin(3.0 * s)) * hinge_axis(kLeftKnee));
    frame.omega[kLeftKnee] = 1.5 * std::cos(3.0 * s) * hinge_axis(kLeftKnee);
    frame.q[kRightElbow] = mimicx::exp_map(0.3 * s * hinge_axis(kRightElbow));
    frame.omega[kRightElbow] = 0.3 * hinge_axis(kRightElbow);
    frame.q[kLeftShoulder] = mimicx::exp_map(Vector3d(0.0, 0.0, -2.5 + 1.2 * s));  // beyond half a circle
    frame.omega[kLeftShoulder] = Vector3d(0.0, 0.0, 1.2);
    states.push_back(rl::tracking::simulator_state(frame));
  }
  return states;
}

TEST(MotionSpline, ReproducesTheStates) {
  for (const int spacing : {1, 2, 3}) {
    const auto states = turning(120, 4.0);  // two and a half turns
    const auto back = states_of(fit_spline(states, 30.0, spacing));
    ASSERT_EQ(back.size(), states.size());
    for (int t = 0; t < states.count(); ++t) {
      EXPECT_LT((physics::to_eigen(back[t].p_root) - physics::to_eigen(states[t].p_root)).norm(), 1e-4);
      EXPECT_LT((physics::to_eigen(back[t].v_root) - physics::to_eigen(states[t].v_root)).norm(), 2e-3);
      for (int body = 0; body < kBodies; ++body) {
        EXPECT_LT(angle_of(back[t].q[body], states[t].q[body]), 1e-3) << t << ", " << kBodyNames[body];
        EXPECT_LT((physics::to_eigen(back[t].omega[body]) - physics::to_eigen(states[t].omega[body])).norm(),
                  5e-3)
            << "spacing " << spacing << ", frame " << t << ", " << kBodyNames[body];
      }
    }
  }
}

TEST(MotionSpline, HoldsVelocitiesThatAreNotDerivatives) {
  auto states = turning(60, 1.0);
  states[30].v_root.x += 0.5;
  states[31].omega[kLeftKnee].x += 2.0;
  const auto back = states_of(fit_spline(states, 30.0, 2));
  EXPECT_NEAR(back[30].v_root.x, states[30].v_root.x, 0.5 / 127.0);
  EXPECT_NEAR(back[31].omega[kLeftKnee].x, states[31].omega[kLeftKnee].x, 2.0 / 127.0);
}

TEST(MotionSpline, TwoFramesAreEnough) {
  const auto states = turning(2, 1.0);
  for (const int spacing : {1, 5}) {
    const MotionSpline spline = fit_spline(states, 30.0, spacing);
    EXPECT_EQ(spline.knots.size(), 4U * kChannels);
    const auto back = states_of(spline);
    for (int t = 0; t < 2; ++t) EXPECT_LT(angle_of(back[t].q[0], states[t].q[0]), 1e-3);
  }
}

TEST(MotionSpline, RejectsWhatItCannotRepresent) {
  EXPECT_THROW(fit_spline(turning(1, 1.0), 30.0, 1), std::invalid_argument);
  EXPECT_THROW(fit_spline(turning(9, 1.0), 30.0, 0), std::invalid_argument);
  auto states = turning(300, 1.0);  // ten seconds, in which a shoulder turns about its own axis for ever
  for (int t = 0; t < states.count(); ++t)
    states[t].q[kLeftShoulder] = physics::from_eigen(mimicx::exp_map(Vector3d(0.0, 0.0, 0.05 * t)));
  EXPECT_THROW(fit_spline(states, 30.0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::policy_export
