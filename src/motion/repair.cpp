#include "motion/repair.h"

#include <algorithm>
#include <cmath>

namespace mimicx {
namespace {

constexpr double kMaxJointSpeed = 12.0;      ///< m/s
constexpr double kMaxJointRate = 25.0;       ///< rad/s
constexpr double kOverNeighbours = 3.0;      ///< a jump is this much faster than the motion around it
constexpr int kNeighbours = 3;               ///< steps on either side that count as around
constexpr double kMaxGlitch = 1.0 / 3.0;     ///< s
constexpr double kMaxEndGlitch = 1.0 / 6.0;  ///< s, at either end of the clip

constexpr double kSupportShare = 0.25;         ///< percentile of the lowest point that counts as support
constexpr double kSupportWindow = 1.2;         ///< s
constexpr double kSupportSmoothing = 0.3;      ///< s, standard deviation
constexpr double kMaxDrift = 0.15;             ///< m
constexpr double kPenetrationAllowed = 0.010;  ///< m
constexpr int kLiftRadius = 2;                 ///< frames

/// How fast the motion goes from frame a to frame b at constant speed, in units of the limits.
double implausibility(const std::vector<BodyPoses>& poses, const std::vector<PerBody<Quaterniond>>& q,
                      std::size_t a, std::size_t b, double fps) {
  const double seconds = static_cast<double>(b - a) / fps;
  double worst = 0.0;
  for (std::size_t j = 0; j < kBodies; ++j) {
    worst = std::max(worst, (poses[b].p_WB[j] - poses[a].p_WB[j]).norm() / seconds / kMaxJointSpeed);
    worst = std::max(worst, q[a][j].angularDistance(q[b][j]) / seconds / kMaxJointRate);
  }
  return worst;
}

/// Value below which the given share of the values lies.
double nearest_rank(std::vector<double> values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// Elements first .. last around i, clipped to the ends.
std::vector<double> window(const std::vector<double>& x, std::size_t i, std::size_t radius) {
  const std::size_t first = i > radius ? i - radius : 0, last = std::min(i + radius, x.size() - 1);
  return {x.begin() + static_cast<std::ptrdiff_t>(first), x.begin() + static_cast<std::ptrdiff_t>(last) + 1};
}

template <class Reduce>
std::vector<double> sliding(const std::vector<double>& x, std::size_t radius, const Reduce& reduce) {
  std::vector<double> out;
  for (std::size_t i = 0; i < x.size(); ++i) out.push_back(reduce(window(x, i, radius)));
  return out;
}

/// Gaussian of standard deviation `sigma` (frames), normalised where the ends cut it.
std::vector<double> smoothed(const std::vector<double>& x, double sigma) {
  const auto n = static_cast<std::ptrdiff_t>(x.size());
  const auto radius = static_cast<std::ptrdiff_t>(std::ceil(3.0 * sigma));
  std::vector<double> out(x.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double sum = 0.0, weights = 0.0;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - radius); k <= std::min(n - 1, i + radius); ++k) {
      const double u = static_cast<double>(k - i) / sigma, weight = std::exp(-0.5 * u * u);
      sum += weight * x[static_cast<std::size_t>(k)];
      weights += weight;
    }
    out[static_cast<std::size_t>(i)] = sum / weights;
  }
  return out;
}

/// A smooth curve nowhere under `need`: the maximum over twice the radius, averaged twice over the radius.
std::vector<double> smooth_cover(const std::vector<double>& need) {
  const auto highest = [](const std::vector<double>& w) { return *std::max_element(w.begin(), w.end()); };
  const auto mean = [](const std::vector<double>& w) {
    double sum = 0.0;
    for (const double v : w) sum += v;
    return sum / static_cast<double>(w.size());
  };
  return sliding(sliding(sliding(need, 2 * kLiftRadius, highest), kLiftRadius, mean), kLiftRadius, mean);
}

}  // namespace

std::vector<bool> find_glitches(const Clip& clip) {
  const auto frames = static_cast<std::ptrdiff_t>(clip.frames());
  std::vector<bool> flagged(clip.rotations.size(), false);
  const auto poses = poses_of(clip);
  const auto q = joint_rotations(clip);
  std::vector<double> step;  // t → t + 1
  for (std::size_t t = 0; t + 1 < poses.size(); ++t)
    step.push_back(implausibility(poses, q, t, t + 1, clip.fps));
  std::vector<std::ptrdiff_t> jumps = {
      -1};  // a jump at t separates frames t and t + 1; the clip's ends count as two
  for (std::size_t t = 0; t < step.size(); ++t) {
    const double around = nearest_rank(window(step, t, kNeighbours), 0.5);
    if (step[t] > 1.0 && step[t] > kOverNeighbours * around) jumps.push_back(static_cast<std::ptrdiff_t>(t));
  }
  jumps.push_back(frames - 1);
  for (std::size_t i = 0; i + 1 < jumps.size(); ++i)
    for (std::size_t j = jumps.size() - 1; j > i; --j) {
      const std::ptrdiff_t before = jumps[i], last = jumps[j];
      const bool at_start = before < 0, at_end = last == frames - 1;
      const double longest = (at_start || at_end ? kMaxEndGlitch : kMaxGlitch) * clip.fps;
      if ((at_start && at_end) || static_cast<double>(last - before) > longest) continue;
      if (!at_start && !at_end &&
          implausibility(poses, q, static_cast<std::size_t>(before), static_cast<std::size_t>(last + 1),
                         clip.fps) > 1.0)
        continue;
      for (std::ptrdiff_t t = before + 1; t <= last; ++t) flagged[static_cast<std::size_t>(t)] = true;
      i = j;
      break;
    }
  return flagged;
}

void bridge_glitches(Clip& clip, const std::vector<bool>& flagged) {
  const std::size_t frames = clip.rotations.size();
  const auto q = joint_rotations(clip);
  for (std::size_t t = 0; t < frames; ++t) {
    if (!flagged[t]) continue;
    std::size_t before = t, after = t;
    while (before > 0 && flagged[before]) --before;
    while (after + 1 < frames && flagged[after]) ++after;
    if (flagged[before]) before = after;
    if (flagged[after]) after = before;
    if (flagged[before]) return;
    const double share =
        after == before ? 0.0 : static_cast<double>(t - before) / static_cast<double>(after - before);
    for (std::size_t j = 0; j < kBodies; ++j)
      clip.rotations[t][j] = log_map(q[before][j].slerp(share, q[after][j]));
    clip.trans[t] = (1.0 - share) * clip.trans[before] + share * clip.trans[after];
  }
}

FloorCorrection floor_correction(const std::vector<double>& lowest, double fps, bool known) {
  FloorCorrection out;
  out.shift = known ? 0.0 : -nearest_rank(lowest, kSupportShare);
  const auto radius = static_cast<std::size_t>(0.5 * kSupportWindow * fps);
  std::vector<double> drift = sliding(lowest, radius, [&](const std::vector<double>& w) {
    return std::clamp(-nearest_rank(w, kSupportShare) - out.shift, -kMaxDrift, kMaxDrift);
  });
  drift = smoothed(drift, kSupportSmoothing * fps);
  std::vector<double> need(lowest.size());
  for (std::size_t t = 0; t < lowest.size(); ++t)
    need[t] = std::max(0.0, -(lowest[t] + out.shift + drift[t]) - kPenetrationAllowed);
  const std::vector<double> lift = smooth_cover(need);
  for (std::size_t t = 0; t < lowest.size(); ++t) out.height.push_back(out.shift + drift[t] + lift[t]);
  return out;
}

}  // namespace mimicx
