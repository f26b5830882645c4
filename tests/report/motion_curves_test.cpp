#include "report/motion_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace mimicx::report {
namespace {

constexpr int kCurveFrames = 12;
constexpr double kFps = 30.0;

/// The standard body, stiff, with its soles on the floor, moved by a way that depends on the frame.
motion::MotionSamples moved(const std::function<Vector3d(int)>& way, int frames = kCurveFrames) {
  const Character character = make_character();
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  q[kPelvis] = exp_map(Vector3d(std::numbers::pi / 2, 0.0, 0.0));
  const BodyPoses hung = forward_kinematics(character, Vector3d::Zero(), q);
  const double floor = motion::lowest_height(motion::surface_points(character), hung);
  PerFrame<BodyPoses> poses;
  for (int t = 0; t < frames; ++t)
    poses.push_back(forward_kinematics(character, Vector3d(0.0, 0.0, -floor) + way(t), q));
  return motion::sample_motion(character, poses, kFps);
}

Vector3d nowhere(int) { return Vector3d::Zero(); }

int count_true(const std::vector<bool>& frames) {
  int n = 0;
  for (const bool yes : frames) n += yes;
  return n;
}

TEST(MotionCurves, FallingBodyHasParabolicCurves) {
  const double g = 9.81;
  const MotionCurves curves =
      curves_of(moved([g](int t) { return Vector3d(0.0, 0.0, 1.0 - 0.5 * g * t * t / (kFps * kFps)); }, 8));
  EXPECT_TRUE(std::isnan(curves.acceleration.front()));
  EXPECT_TRUE(std::isnan(curves.acceleration.back()));
  for (std::size_t t = 1; t < 7; ++t) EXPECT_NEAR(curves.acceleration[t], g, 1e-9);
  for (std::size_t t = 0; t < 8; ++t) {
    const double height = 1.0 - 0.5 * g * static_cast<double>(t * t) / (kFps * kFps);
    EXPECT_NEAR(curves.lowest[t], 1000.0 * height, 1e-9);
    EXPECT_NEAR(curves.pelvis_height[t] - curves.pelvis_height[0], height - 1.0, 1e-12);
  }
}

std::vector<double> no_slip(const motion::MotionSamples& motion) {
  return std::vector<double>(motion.surface.size(), 0.0);
}

Flaws flaws(const motion::MotionSamples& input, const motion::MotionSamples& cleaned) {
  return flaws_of(measured(input, no_slip(input)), measured(cleaned, no_slip(cleaned)));
}

TEST(Flaws, CleanedMotionHasNone) {
  const motion::MotionSamples still = moved(nowhere);
  const Flaws none = flaws(still, still);
  for (const auto* frames : {&none.sinks, &none.floats, &none.slides, &none.shakes}) {
    EXPECT_EQ(frames->size(), static_cast<std::size_t>(kCurveFrames));
    EXPECT_EQ(count_true(*frames), 0);
  }
}

TEST(Flaws, EachIsFoundInItsFramesOnly) {
  const motion::MotionSamples still = moved(nowhere);
  const auto third = [](int t) { return t >= 4 && t < 8; };
  const Flaws sunk = flaws(moved([](int) { return Vector3d(0.0, 0.0, -0.02); }), still);
  EXPECT_EQ(count_true(sunk.sinks), kCurveFrames);
  EXPECT_EQ(count_true(sunk.floats), 0);
  const Flaws afloat = flaws(moved([](int) { return Vector3d(0.0, 0.0, 0.02); }), still);
  EXPECT_EQ(count_true(afloat.floats), kCurveFrames);
  EXPECT_EQ(count_true(afloat.sinks), 0);
  std::vector<double> slip = no_slip(still);
  for (std::size_t t = 4; t < 8; ++t) slip[t] = 3.1;
  slip[8] = 3.0;
  slip[9] = std::nan("");
  const Flaws slid = flaws_of(measured(still, slip), measured(still, no_slip(still)));
  for (int t = 0; t < kCurveFrames; ++t) EXPECT_EQ(slid.slides[static_cast<std::size_t>(t)], third(t)) << t;
  // 6 mm to the next frame during frames 4 … 7, at one speed: accelerations at the two ends alone, 5.4 m/s².
  const Flaws glided =
      flaws(moved([](int t) { return Vector3d(0.006 * std::clamp(t - 4, 0, 4), 0.0, 0.0); }), still);
  EXPECT_EQ(count_true(glided.shakes), 2);
  const Flaws shaken =
      flaws(moved([&](int t) { return Vector3d(third(t) && t % 2 == 0 ? 0.004 : 0.0, 0.0, 0.0); }), still);
  EXPECT_EQ(spans_of(shaken.shakes).size(), 1u);
  EXPECT_EQ(count_true(shaken.slides), 0);
}

// A true jump is in the air where the cleaned one is, too.
TEST(Flaws, JumpIsNotFloating) {
  const auto jump = [](int t) { return Vector3d(0.0, 0.0, t > 3 && t < 9 ? 0.3 : 0.0); };
  EXPECT_EQ(count_true(flaws(moved(jump), moved(jump)).floats), 0);
  EXPECT_EQ(count_true(flaws(moved(jump), moved(nowhere)).floats), 5);
}

TEST(Flaws, EndWithTheShorterMotion) {
  EXPECT_EQ(flaws(moved(nowhere), moved(nowhere, 5)).sinks.size(), 5u);
  EXPECT_EQ(flaws(moved(nowhere, 5), moved(nowhere)).slides.size(), 5u);
}

TEST(Spans, AreTheStretchesOfTrueFrames) {
  const std::vector<Span> spans = spans_of({true, true, false, false, true, false, true});
  ASSERT_EQ(spans.size(), 3u);
  EXPECT_EQ((std::array{spans[0].first, spans[0].last}), (std::array{0, 1}));
  EXPECT_EQ((std::array{spans[1].first, spans[1].last}), (std::array{4, 4}));
  EXPECT_EQ((std::array{spans[2].first, spans[2].last}), (std::array{6, 6}));
  EXPECT_TRUE(spans_of({}).empty());
}

TEST(JointDistances, EqualTheShift) {
  const std::vector<double> mm =
      joint_distances(moved(nowhere), moved([](int t) { return Vector3d(0.0, 0.01 * t, 0.0); }, 4));
  ASSERT_EQ(mm.size(), 4u);
  for (std::size_t t = 0; t < 4; ++t) EXPECT_NEAR(mm[t], 10.0 * static_cast<double>(t), 1e-9);
}

}  // namespace
}  // namespace mimicx::report
