#include "synth/noise/random_processes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"

namespace mimicx::synth {

std::vector<Interval> poisson_intervals(Random& random, double rate, double shortest, double longest,
                                        int frames, double fps) {
  std::vector<Interval> intervals;
  double time = 0.0;
  while (rate > 0.0) {
    time -= log(1.0 - random.uniform()) / rate;  // waiting times are exponential
    const int first = static_cast<int>(time * fps);
    if (!(time * fps < frames)) break;
    const auto lengths = static_cast<std::uint32_t>(longest - shortest) + 1;
    const int length = static_cast<int>(shortest) + static_cast<int>(random.below(lengths));
    intervals.push_back({first, std::min(length, frames - first)});
  }
  return intervals;
}

PerFrame<double> smooth_noise(Random& random, int count, double frames) {
  const int radius = static_cast<int>(std::ceil(4.0 * frames));
  std::vector<double> kernel;
  double squares = 0.0;
  for (int k = -radius; k <= radius; ++k) {
    kernel.push_back(exp(-0.5 * k * k / (frames * frames)));
    squares += kernel.back() * kernel.back();
  }
  PerFrame<double> out(count);
  std::vector<double> white(out.size() + kernel.size() - 1);
  for (double& value : white) value = random.normal();
  for (std::size_t i = 0; i < out.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * white[i + k];
    out[i] = sum / std::sqrt(squares);
  }
  return out;
}

PerFrame<double> smooth_error(Random& random, int count, double size, double frames) {
  if (size == 0.0) return PerFrame<double>(count, 0.0);
  PerFrame<double> error = smooth_noise(random, count, frames);
  for (double& value : error) value *= size;
  return error;
}

PerFrame<Vector3d> smooth_errors(Random& random, int count, double size, double frames) {
  PerFrame<Vector3d> errors(count, Vector3d::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const PerFrame<double> error = smooth_error(random, count, size, frames);
    for (int t = 0; t < count; ++t) errors[t][axis] = error[t];
  }
  return errors;
}

double student_t(Random& random, int freedom) {
  const double normal = random.normal();
  double squares = 0.0;
  for (int i = 0; i < freedom; ++i) {
    const double one = random.normal();
    squares += one * one;
  }
  return normal / std::sqrt(squares / freedom);
}

PerFrame<double> smooth_walk(Random& random, int count, double tau, double fps) {
  const PerFrame<double> velocity = smooth_noise(random, count, tau * fps);
  const double size = 1.0 / std::sqrt(2.0 * std::sqrt(std::numbers::pi) * tau);
  PerFrame<double> walk(count, 0.0);
  for (int t = 1; t < count; ++t) walk[t] = walk[t - 1] + size * velocity[t - 1] / fps;
  return walk;
}

}  // namespace mimicx::synth
