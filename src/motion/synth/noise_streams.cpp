#include "motion/synth/noise_streams.h"

#include <algorithm>
#include <cmath>

namespace mimicx::motion::synth {

std::vector<Interval> poisson_intervals(Random& random, double rate, double shortest, double longest,
                                        int frames, double fps) {
  std::vector<Interval> intervals;
  double time = 0.0;
  while (rate > 0.0) {
    time -= std::log(1.0 - random.uniform()) / rate;  // waiting times are exponential
    const int first = static_cast<int>(time * fps);
    if (!(time * fps < frames)) break;
    const auto lengths = static_cast<std::uint32_t>(longest - shortest) + 1;
    const int length = static_cast<int>(shortest) + static_cast<int>(random.below(lengths));
    intervals.push_back({first, std::min(length, frames - first)});
  }
  return intervals;
}

}  // namespace mimicx::motion::synth
