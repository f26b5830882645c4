#include "audit/chatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mimicx::audit {
namespace {

constexpr double kPi = std::numbers::pi;

List<double> wave(int n, double fps, double hertz, double amplitude, double mean = 0.0) {
  List<double> signal;
  for (int t = 0; t < n; ++t)
    signal.push_back(mean + amplitude * std::sin(2.0 * kPi * hertz * t / fps + 0.3));
  return signal;
}

/// The amplitude that passes a Butterworth filter of second order twice: 1/(1 + r⁴) for a sine.
double passed(double hertz, double cutoff, double fps) {
  return 1.0 / (1.0 + std::pow(std::tan(kPi * hertz / fps) / std::tan(kPi * cutoff / fps), 4.0));
}

TEST(LowPass, LeavesTheClosedFormsShareOfASineInPhase) {
  for (const double fps : {30.0, 120.0})
    for (const double hertz : {1.0, 4.0, 6.0, 9.0, 13.0}) {
      const List<double> signal = wave(1200, fps, hertz, 5.0), low = low_passed(signal, fps, 6.0);
      for (int t = 300; t < 900; ++t)
        EXPECT_NEAR(low[t], passed(hertz, 6.0, fps) * signal[t], 1e-6) << hertz << " Hz, frame " << t;
    }
}

TEST(LowPass, KeepsConstantsAndRamps) {
  List<double> ramp;
  for (int t = 0; t < 60; ++t) ramp.push_back(3.0 + 2.0 * t);
  const List<double> constant(60, 7.0), low = low_passed(ramp, 30.0, 6.0);
  for (int t = 0; t < 60; ++t) {
    EXPECT_NEAR(low_passed(constant, 30.0, 6.0)[t], 7.0, 1e-12);
    EXPECT_NEAR(low[t], ramp[t], 1e-3) << t;
  }
}

TEST(LowPass, IsTheSameBackwards) {
  List<double> signal;
  for (int t = 0; t < 50; ++t) signal.push_back(t * t % 17);
  List<double> turned = signal;
  std::reverse(turned.begin(), turned.end());
  List<double> low = low_passed(turned, 30.0, 6.0);
  std::reverse(low.begin(), low.end());
  const List<double> expected = low_passed(signal, 30.0, 6.0);
  for (int t = 20; t < 30; ++t) EXPECT_NEAR(low[t], expected[t], 1e-2) << t;
}

TEST(Chatter, OfASineIsWhatTheFilterTakesAway) {
  const double amplitude = 90.0, weight = 800.0, fps = 30.0, hertz = 10.0;
  const double expected = 100.0 / weight * amplitude / std::numbers::sqrt2 * (1.0 - passed(hertz, 6.0, fps));
  EXPECT_NEAR(chatter_of(wave(3000, fps, hertz, amplitude, weight), weight, fps), expected, 0.01 * expected);
}

TEST(Chatter, SlowForcesHaveNone) {
  EXPECT_NEAR(chatter_of(List<double>(90, 800.0), 800.0, 30.0), 0.0, 1e-9);
  EXPECT_LT(chatter_of(wave(300, 30.0, 1.0, 400.0, 800.0), 800.0, 30.0), 0.1);
}

TEST(Chatter, NeedsATwelfthOfASecondPerSampleAtMostAndAThirdOfASecond) {
  EXPECT_TRUE(std::isnan(chatter_of(List<double>(100, 1.0), 1.0, 12.0)));
  EXPECT_TRUE(std::isnan(chatter_of(List<double>(9, 1.0), 1.0, 30.0)));
  EXPECT_EQ(chatter_of(List<double>(10, 1.0), 1.0, 30.0), 0.0);
  EXPECT_THROW(low_passed(List<double>(9, 1.0), 30.0, 15.0), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::audit
