#include "synth/noise/random_processes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mimicx::synth {
namespace {

TEST(SmoothNoise, HasUnitVarianceAndAGaussianAutocorrelation) {
  for (double frames : {0.45, 3.0, 12.0}) {
    Random random(11, {static_cast<std::uint64_t>(10.0 * frames)});
    const int lag = static_cast<int>(std::ceil(frames));
    double variance = 0.0, covariance = 0.0;
    constexpr int kTrials = 20000;
    for (int trial = 0; trial < kTrials; ++trial) {
      const std::vector<double> x = smooth_noise(random, lag + 1, frames);
      variance += x.front() * x.front() / kTrials;
      covariance += x.front() * x.back() / kTrials;
    }
    EXPECT_NEAR(variance, 1.0, 0.03);
    // Below a frame the filter is sampled too coarsely for the continuous formula: sum its taps instead.
    double expected = 0.0, squares = 0.0;
    for (int k = -200; k <= 200; ++k) {
      const double here = std::exp(-0.5 * k * k / (frames * frames));
      expected += here * std::exp(-0.5 * (k + lag) * (k + lag) / (frames * frames));
      squares += here * here;
    }
    EXPECT_NEAR(covariance, expected / squares, 0.03);
    if (frames < 3.0) continue;
    EXPECT_NEAR(covariance, std::exp(-lag * lag / (4.0 * frames * frames)), 0.03);
  }
}

}  // namespace
}  // namespace mimicx::synth
