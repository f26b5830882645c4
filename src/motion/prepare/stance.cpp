#include "motion/prepare/stance.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace mimicx::motion {
namespace {

constexpr double kLow = 0.025, kHigh = 0.035;     ///< m
constexpr double kSlow = 0.10, kFast = 0.15;      ///< m/s, over the floor
constexpr double kLevel = 0.04, kRising = 0.06;   ///< m/s, up or down
constexpr double kSkating = 1.0, kLeaving = 0.3;  ///< m/s: a part that carries the body is no faster
constexpr double kFlight = 0.6;    ///< downward acceleration of a body that nothing carries, in g
constexpr double kParabola = 0.1;  ///< s
constexpr int kShortestStance = 3;
constexpr double kJumpDistance = 0.1, kJumpHeight = 0.05;  ///< m
constexpr int kJumpFrames = 3;                             ///< two steps make three frames fast
constexpr double kInstant = 1.0 / 30.0;                    ///< s
constexpr double kAtOnce = 0.03, kMostOfTheWay = 0.6;      ///< m; share of the whole way
constexpr int kPointsPerPart = 2;                          ///< inner and outer

/// Height over the ground (m), speed over it and vertical speed (m/s) of a part of a foot: of the middle of
/// its points.
struct PartMotion {
  PerFrame<double> height, speed, rise;
};

PartMotion motion_of(const PerFrame<SolePositions>& p, int first, double fps, const Scene& scene) {
  const auto middle = [&](int t) { return Vector3d(0.5 * (p[t][first] + p[t][first + 1])); };
  PartMotion out;
  for (int t = 0; t < p.count(); ++t) {
    const int before = std::max(t - 1, 0), after = std::min(t + 1, p.count() - 1);
    const double seconds = std::max(after - before, 1) / fps;
    out.height.push_back(scene.clearance(middle(t)));
    const Vector3d moved = middle(after) - middle(before);
    out.speed.push_back(moved.head<2>().norm() / seconds);
    out.rise.push_back(std::abs(moved.z()) / seconds);
  }
  return out;
}

PerFrame<bool> standing(const PartMotion& part) {
  const int frames = part.height.count();
  PerFrame<bool> stands(frames, false);
  for (int t = 0; t < frames;) {
    if (!(part.height[t] < kLow && part.speed[t] < kSlow && part.rise[t] < kLevel)) {
      ++t;
      continue;
    }
    const auto goes_on = [&](int k) {
      return part.height[k] < kHigh && part.speed[k] < kFast && part.rise[k] < kRising;
    };
    int first = t, last = t;
    while (first > 0 && !stands[first - 1] && goes_on(first - 1)) --first;
    while (last + 1 < frames && goes_on(last + 1)) ++last;
    if (last - first + 1 >= kShortestStance)
      std::fill(stands.begin() + first, stands.begin() + last + 1, true);
    t = last + 1;
  }
  return stands;
}

/// @param first  the foot's first point
bool foot_stands(const Stance& stance, int first) {
  return std::any_of(stance.begin() + first, stance.begin() + first + kPointsPerFoot,
                     [](bool stands) { return stands; });
}

/// Frames in which the floor carries a share of the weight: by the acceleration of the centre of mass, that
/// of the least-squares parabola over 2m + 1 frames (audit/pose_needs.h says why).
PerFrame<bool> carried(const Character& character, const PerFrame<BodyPoses>& poses, double fps) {
  const int frames = poses.count(), m = std::max(2, static_cast<int>(kParabola * fps));
  PerFrame<double> z;
  for (const BodyPoses& frame : poses) z.push_back(center_of_mass(character, frame).z());
  PerFrame<bool> out(frames, true);
  double norm = 0.0;
  const double mean = m * (m + 1) / 3.0;
  for (int j = -m; j <= m; ++j) norm += j * j * (j * j - mean);
  for (int t = 0; t < frames; ++t) {
    double second = 0.0;
    const int middle = frames > 2 * m ? std::clamp(t, m, frames - 1 - m) : (frames - 1) / 2;
    for (int j = -m; j <= m; ++j) second += (j * j - mean) * z[std::clamp(middle + j, 0, frames - 1)];
    const double acceleration = 2.0 * second / norm * fps * fps;
    out[t] = acceleration > -kFlight * kGravity;
  }
  return out;
}

}  // namespace

SolePositions sole_positions(const Character& character, const BodyPoses& poses) {
  SolePositions p;
  for (int k = 0; k < kFootPoints; ++k) {
    const ContactPoint& point = character.contact_points[k];
    p[k] = poses.p_WB[point.body] + poses.q_WB[point.body] * sole_point(point);
  }
  return p;
}

PerFrame<Stance> find_stance(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                             const Scene& scene) {
  PerFrame<SolePositions> p;
  for (const BodyPoses& frame : poses) p.push_back(sole_positions(character, frame));
  PerFrame<Stance> stance(poses.size());
  List<PartMotion> parts;
  for (int first = 0; first < kFootPoints; first += kPointsPerPart) {
    parts.push_back(motion_of(p, first, fps, scene));
    const PerFrame<bool> stands = standing(parts.back());
    for (int t = 0; t < stands.count(); ++t)
      for (int k = first; k < first + kPointsPerPart; ++k) stance[t][k] = stands[t];
  }
  const PerFrame<bool> is_carried = carried(character, poses, fps);
  stand_through_jumps(p, is_carried, fps, kJumpFrames, scene, stance);
  for (int t = 0; t < stance.count(); ++t) {
    if (!is_carried[t] || std::find(stance[t].begin(), stance[t].end(), true) != stance[t].end()) continue;
    const auto unlikely = [&](const PartMotion& part) {
      return part.height[t] / kLow + part.speed[t] / kSlow + part.rise[t] / kLevel;
    };
    int best = 0;
    for (int k = 1; k < parts.count(); ++k)
      if (unlikely(parts[k]) < unlikely(parts[best])) best = k;
    if (parts[best].height[t] > kHigh || parts[best].speed[t] > kSkating || parts[best].rise[t] > kLeaving)
      continue;
    for (int k = 0; k < kPointsPerPart; ++k) stance[t][kPointsPerPart * best + k] = true;
  }
  return stance;
}

void stand_through_jumps(const PerFrame<SolePositions>& points, const PerFrame<bool>& carried, double fps,
                         int longest, const Scene& scene, PerFrame<Stance>& stance) {
  const int frames = stance.count(), instant = std::max(1, static_cast<int>(std::lround(kInstant * fps)));
  for (int k = 0; k < kFootPoints; ++k) {
    const int other_foot = k < kPointsPerFoot ? kPointsPerFoot : 0;
    const auto way = [&](int from, int to) { return (points[to][k] - points[from][k]).norm(); };
    int before = -1;  // last frame in which the point stands
    for (int after = 0; after < frames; ++after) {
      if (!stance[after][k]) continue;
      const int gap = after - before - 1;
      bool stays = before >= 0 && gap > 0 && gap <= longest && way(before, after) < kJumpDistance;
      bool alone = true, at_once = false;
      for (int t = before; stays && t <= after; ++t) {
        stays = carried[t] && scene.clearance(points[t][k]) < kJumpHeight;
        alone = alone && !foot_stands(stance[t], other_foot);
        const double step = way(t, std::min(t + instant, after));
        at_once = at_once || (step > kAtOnce && step > kMostOfTheWay * way(before, after));
      }
      for (int t = before + 1; stays && (alone || at_once) && t < after; ++t) stance[t][k] = true;
      before = after;
    }
  }
}

}  // namespace mimicx::motion
