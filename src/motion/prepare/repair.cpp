#include "motion/prepare/repair.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/quantile.h"

namespace mimicx::motion {
namespace {

constexpr double kMaxJointSpeed = 12.0;      ///< m/s
constexpr double kMaxJointRate = 25.0;       ///< rad/s
constexpr double kOverNeighbours = 3.0;      ///< a jump is this much faster than the motion around it
constexpr int kNeighbours = 3;               ///< steps on either side that count as around
constexpr double kMaxGlitch = 1.0 / 3.0;     ///< s
constexpr double kMaxEndGlitch = 1.0 / 6.0;  ///< s, at either end of the clip

constexpr double kSupportShare =
    0.25;  ///< share of the heights of the lowest point that lies below the support
constexpr double kSupportWindow = 1.2;         ///< s
constexpr double kSupportSmoothing = 0.3;      ///< s, standard deviation
constexpr double kMaxDrift = 0.15;             ///< m
constexpr double kPenetrationAllowed = 0.010;  ///< m
constexpr int kLiftRadius = 2;                 ///< frames

/// How fast the motion goes from frame a to frame b at constant speed, in units of the limits.
double implausibility(const PerFrame<BodyPoses>& poses, const PerFrame<PerBody<Quaterniond>>& q, int a, int b,
                      double fps) {
  const double seconds = (b - a) / fps;
  double worst = 0.0;
  for (int j = 0; j < kBodies; ++j) {
    worst = std::max(worst, (poses[b].p_WB[j] - poses[a].p_WB[j]).norm() / seconds / kMaxJointSpeed);
    worst = std::max(worst, angle_between(q[a][j], q[b][j]) / seconds / kMaxJointRate);
  }
  return worst;
}

/// The value of the rank that is nearest to the given share.
double nearest_rank(const std::vector<double>& values, double share) {
  return ranked(values, static_cast<int>(share * static_cast<double>(values.size() - 1) + 0.5));
}

/// Elements i − radius … i + radius, clipped to the ends.
std::vector<double> window(const PerFrame<double>& x, int i, int radius) {
  return {x.begin() + std::max(i - radius, 0), x.begin() + std::min(i + radius + 1, x.count())};
}

template <class Reduce>
PerFrame<double> sliding(const PerFrame<double>& x, int radius, const Reduce& reduce) {
  PerFrame<double> out;
  for (int i = 0; i < x.count(); ++i) out.push_back(reduce(window(x, i, radius)));
  return out;
}

/// Gaussian of standard deviation `sigma` (frames), normalised where the ends cut it.
PerFrame<double> smoothed(const PerFrame<double>& x, double sigma) {
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  PerFrame<double> out(x.size());
  for (int i = 0; i < x.count(); ++i) {
    double sum = 0.0, weights = 0.0;
    for (int k = std::max(0, i - radius); k <= std::min(x.count() - 1, i + radius); ++k) {
      const double u = (k - i) / sigma, weight = exp(-0.5 * u * u);
      sum += weight * x[k];
      weights += weight;
    }
    out[i] = sum / weights;
  }
  return out;
}

/// A smooth curve nowhere under `need`: the maximum over twice the radius, averaged twice over the radius.
PerFrame<double> smooth_cover(const PerFrame<double>& need) {
  const auto highest = [](const std::vector<double>& w) { return *std::max_element(w.begin(), w.end()); };
  const auto mean = [](const std::vector<double>& w) {
    double sum = 0.0;
    for (const double v : w) sum += v;
    return sum / static_cast<double>(w.size());
  };
  return sliding(sliding(sliding(need, 2 * kLiftRadius, highest), kLiftRadius, mean), kLiftRadius, mean);
}

}  // namespace

PerFrame<bool> find_glitches(const Clip& clip) {
  const int frames = clip.frames();
  PerFrame<bool> flagged(clip.rotations.size(), false);
  const auto poses = poses_of(clip);
  const auto q = joint_rotations(clip);
  PerFrame<double> step;  // t → t + 1
  for (int t = 0; t + 1 < frames; ++t) step.push_back(implausibility(poses, q, t, t + 1, clip.fps));
  // A jump at t separates frames t and t + 1. Both ends of the clip count as jumps.
  PerFrame<int> jumps = {-1};
  for (int t = 0; t < step.count(); ++t) {
    const double around = nearest_rank(window(step, t, kNeighbours), 0.5);
    if (step[t] > 1.0 && step[t] > kOverNeighbours * around) jumps.push_back(t);
  }
  jumps.push_back(frames - 1);
  for (int i = 0; i + 1 < jumps.count(); ++i)
    for (int j = jumps.count() - 1; j > i; --j) {
      const int before = jumps[i], last = jumps[j];
      const bool at_start = before < 0, at_end = last == frames - 1;
      const double longest = (at_start || at_end ? kMaxEndGlitch : kMaxGlitch) * clip.fps;
      if ((at_start && at_end) || last - before > longest) continue;
      if (!at_start && !at_end && implausibility(poses, q, before, last + 1, clip.fps) > 1.0) continue;
      for (int t = before + 1; t <= last; ++t) flagged[t] = true;
      i = j;
      break;
    }
  return flagged;
}

void bridge_glitches(Clip& clip, const PerFrame<bool>& flagged) {
  const int frames = clip.frames();
  const auto q = joint_rotations(clip);
  for (int t = 0; t < frames; ++t) {
    if (!flagged[t]) continue;
    int before = t, after = t;
    while (before > 0 && flagged[before]) --before;
    while (after + 1 < frames && flagged[after]) ++after;
    if (flagged[before]) before = after;
    if (flagged[after]) after = before;
    if (flagged[before]) return;
    const double share = after == before ? 0.0 : static_cast<double>(t - before) / (after - before);
    for (int j = 0; j < kBodies; ++j) clip.rotations[t][j] = log_map(slerp(q[before][j], share, q[after][j]));
    clip.trans[t] = (1.0 - share) * clip.trans[before] + share * clip.trans[after];
  }
}

FloorCorrection floor_correction(const PerFrame<double>& lowest, double fps, bool known) {
  FloorCorrection out;
  out.shift = known ? 0.0 : -nearest_rank(lowest, kSupportShare);
  const int radius = static_cast<int>(0.5 * kSupportWindow * fps);
  PerFrame<double> drift = sliding(lowest, radius, [&](const std::vector<double>& w) {
    return std::clamp(-nearest_rank(w, kSupportShare) - out.shift, -kMaxDrift, kMaxDrift);
  });
  drift = smoothed(drift, kSupportSmoothing * fps);
  PerFrame<double> need(lowest.size());
  for (int t = 0; t < lowest.count(); ++t)
    need[t] = std::max(0.0, -(lowest[t] + out.shift + drift[t]) - kPenetrationAllowed);
  const PerFrame<double> lift = smooth_cover(need);
  for (int t = 0; t < lowest.count(); ++t) out.height.push_back(out.shift + drift[t] + lift[t]);
  return out;
}

}  // namespace mimicx::motion
