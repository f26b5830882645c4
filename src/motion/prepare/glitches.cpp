#include "motion/prepare/glitches.h"

#include <algorithm>

#include "motion/prepare/sliding_window.h"

namespace mimicx::motion {
namespace {

constexpr double kMaxJointSpeed = 12.0;      ///< m/s
constexpr double kMaxPelvisStep = 5.0;       ///< m/s, of the pelvis in a jump
constexpr double kMaxJointRate = 25.0;       ///< rad/s
constexpr double kOverNeighbours = 3.0;      ///< a jump is this much faster than the motion around it
constexpr int kNeighbours = 3;               ///< steps on either side that count as around
constexpr double kMaxGlitch = 1.0 / 3.0;     ///< s
constexpr double kMaxEndGlitch = 1.0 / 6.0;  ///< s, at either end of the clip

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

}  // namespace

PerFrame<bool> find_glitches(const Clip& clip) {
  const int frames = clip.frames();
  PerFrame<bool> flagged(clip.rotations.size(), false);
  const auto poses = poses_of(clip);
  const auto q = joint_rotations(clip);
  PerFrame<double> step;  // t → t + 1
  for (int t = 0; t + 1 < frames; ++t) {
    const double pelvis = (poses[t + 1].p_WB[kPelvis] - poses[t].p_WB[kPelvis]).norm() * clip.fps;
    step.push_back(std::max(implausibility(poses, q, t, t + 1, clip.fps), pelvis / kMaxPelvisStep));
  }
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

}  // namespace mimicx::motion
