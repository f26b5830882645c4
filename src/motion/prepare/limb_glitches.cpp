#include "motion/prepare/limb_glitches.h"

#include <algorithm>

namespace mimicx::motion {
namespace {

constexpr double kMaxAcceleration = 200.0;  ///< m/s²
constexpr double kLongest = 1.0 / 6.0;      ///< s
constexpr double kOverBridged = 3.0;        ///< smallest ratio of accelerations without and with the bridge

/// m/s².
double largest_acceleration(const PerFrame<BodyPoses>& poses, int limb, int first, int last, double fps) {
  double largest = 0.0;
  for (int t = std::max(first, 1); t <= std::min(last, poses.count() - 2); ++t)
    largest = std::max(largest, fps * fps * limb_acceleration(poses, limb, t));
  return largest;
}

/// Whether the limb goes on smoothly without the glitch.
bool is_calm_without(const Clip& clip, const PerFrame<BodyPoses>& poses, const LimbGlitch& glitch) {
  const int first = std::max(0, glitch.first - 3), end = std::min(clip.frames(), glitch.last + 4);
  Clip part = clip;
  part.rotations.assign(clip.rotations.begin() + first, clip.rotations.begin() + end);
  part.trans.assign(clip.trans.begin() + first, clip.trans.begin() + end);
  bridge_limb_glitches(part, {LimbGlitch{glitch.limb, glitch.first - first, glitch.last - first}});
  const double before = largest_acceleration(poses, glitch.limb, glitch.first - 1, glitch.last + 1, clip.fps);
  return kOverBridged * largest_acceleration(poses_of(part), glitch.limb, 1, part.frames(), clip.fps) <=
         before;
}

}  // namespace

double limb_acceleration(const PerFrame<BodyPoses>& poses, int limb, int t) {
  double largest = 0.0;
  for (int body = 0; body < kBodies; ++body) {
    if (kLimbOf[body] != limb) continue;
    const auto position = [&](int frame) -> Vector3d {
      const PerBody<Vector3d>& p = poses[frame].p_WB;
      return limb == 0 ? p[body] : Vector3d(p[body] - p[kLimbRoot[limb]]);
    };
    const Vector3d second = position(t + 1) - 2.0 * position(t) + position(t - 1);
    largest = std::max(largest, second.norm());
  }
  return largest;
}

List<LimbGlitch> find_limb_glitches(const Clip& clip) {
  const PerFrame<BodyPoses> poses = poses_of(clip);
  const int longest = static_cast<int>(kLongest * clip.fps);
  List<LimbGlitch> glitches;
  for (int limb = 1; limb < kLimbs; ++limb) {
    PerFrame<bool> jumps(clip.rotations.size(), false);
    for (int t = 1; t + 1 < clip.frames(); ++t)
      jumps[t] = clip.fps * clip.fps * limb_acceleration(poses, limb, t) > kMaxAcceleration;
    // A glitch of frames first … last has its jumps at first − 1 and last + 1 at the latest.
    for (int before = 1; before + 1 < clip.frames(); ++before) {
      if (!jumps[before]) continue;
      for (int after = std::min(before + longest + 1, clip.frames() - 2); after >= before + 2; --after) {
        const LimbGlitch glitch{limb, before + 1, after - 1};
        if (!jumps[after] || !is_calm_without(clip, poses, glitch)) continue;
        glitches.push_back(glitch);
        before = after;
        break;
      }
    }
  }
  return glitches;
}

void bridge_limb_glitches(Clip& clip, const List<LimbGlitch>& glitches) {
  for (const LimbGlitch& glitch : glitches) {
    const int before = glitch.first - 1, after = glitch.last + 1;
    for (int body = 0; body < kBodies; ++body) {
      if (kLimbOf[body] != glitch.limb) continue;
      const Quaterniond a = exp_map(clip.rotations[before][body]), b = exp_map(clip.rotations[after][body]);
      for (int t = glitch.first; t <= glitch.last; ++t)
        clip.rotations[t][body] = log_map(slerp(a, static_cast<double>(t - before) / (after - before), b));
    }
  }
}

}  // namespace mimicx::motion
