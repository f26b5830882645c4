#include "motion/prepare/feet.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "core/quantile.h"
#include "core/units.h"
#include "motion/prepare/sliding_window.h"

namespace mimicx::motion {
namespace {

constexpr double kStandingSpeed = 0.4;    // m/s
constexpr double kStandingHeight = 0.06;  // m over the low percentile
constexpr double kLowShare = 0.1;
constexpr std::size_t kFewestFrames = 10;
constexpr double kSmallest = 10.0 * kDegree, kLargest = 30.0 * kDegree;
constexpr double kLevelTilt = 5.0 * kDegree;  // a smaller tilt
constexpr double kLevelShare = 0.25;  // of the standing frames: who is level in more has no constant error
constexpr double kRollReach = 0.3;    // s before and after a frame
constexpr double kRollSigma = 0.1;    // s
constexpr double kLargestBend = 60.0 * kDegree;

/// Speed of a joint at a frame, m/s, by central differences.
double speed(const PerFrame<BodyPoses>& poses, int t, int body, double fps) {
  const int before = std::max(t - 1, 0), after = std::min(t + 1, poses.count() - 1);
  if (after == before) return 0.0;
  return fps / (after - before) * (poses[after].p_WB[body] - poses[before].p_WB[body]).norm();
}

/// World's up in a body's frame, whose own up is y.
Vector3d up_in(const Quaterniond& q_WB) { return q_WB.conjugate() * Vector3d::UnitZ(); }

/// Body-fixed rotation that levels a body in the given frames, as far as its tilt there is the same.
Quaterniond constant_levelling(const PerFrame<BodyPoses>& poses, const PerFrame<bool>& standing, int body) {
  Array<std::vector<double>, 3> up;
  double level = 0.0;
  for (int t = 0; t < poses.count(); ++t) {
    if (!standing[t]) continue;
    const Vector3d u = up_in(poses[t].q_WB[body]);
    level += u.y() > cos(kLevelTilt);
    for (int k = 0; k < 3; ++k) up[k].push_back(u[k]);
  }
  const std::size_t frames = up[0].size();
  if (frames < kFewestFrames || level > kLevelShare * static_cast<double>(frames))
    return Quaterniond::Identity();
  const Vector3d median(quantile(up[0], 0.5), quantile(up[1], 0.5), quantile(up[2], 0.5));
  if (median.norm() < 0.5) return Quaterniond::Identity();  // no common direction
  const Vector3d rotation = log_map(rotation_between(Vector3d::UnitY(), median));
  const double angle = rotation.norm();
  if (angle < kSmallest || angle > 1.5 * kLargest) return Quaterniond::Identity();
  return exp_map(std::min(1.0, kLargest / angle) * rotation);
}

/// Turns about a body's long axis (z), rad, that level it from side to side where it stands.
/// @param levelled  constant rotation of the body that comes before
PerFrame<double> rolls(const PerFrame<BodyPoses>& poses, const PerFrame<bool>& standing, int body,
                       const Quaterniond& levelled, double fps) {
  const int reach = static_cast<int>(std::lround(kRollReach * fps));
  PerFrame<double> tilts(poses.size(), std::numeric_limits<double>::quiet_NaN());  // NaN: it does not stand
  for (int t = 0; t < poses.count(); ++t) {
    if (!standing[t]) continue;
    const Vector3d u = up_in(poses[t].q_WB[body] * levelled);
    tilts[t] = atan2(-u.x(), u.y());
  }
  const auto roll = [&](std::vector<double> near) {
    std::erase_if(near, [](double tilt) { return std::isnan(tilt); });
    if (static_cast<int>(near.size()) <= reach) return 0.0;  // it hardly stands
    const double tilt = quantile(near, 0.5), size = std::abs(tilt);
    if (size > 1.5 * kLargest) return 0.0;
    return tilt * std::clamp((size - kLevelTilt) / (kSmallest - kLevelTilt), 0.0, 1.0);
  };
  return smoothed(sliding(tilts, reach, roll), kRollSigma * fps);
}

/// Body-fixed rotations that level a body, frame by frame.
PerFrame<Quaterniond> levelling(const PerFrame<BodyPoses>& poses, const PerFrame<bool>& standing, int body,
                                double fps) {
  const Quaterniond constant = constant_levelling(poses, standing, body);
  PerFrame<Quaterniond> turns;
  for (const double roll : rolls(poses, standing, body, constant, fps))
    turns.push_back(constant * exp_map(Vector3d(0.0, 0.0, roll)));
  return turns;
}

}  // namespace

PerFrame<bool> standing_frames(const PerFrame<BodyPoses>& poses, int ankle, double fps, const Scene& scene) {
  const int ball = ankle == kLeftAnkle ? kLeftFoot : kRightFoot;
  const auto slow = [&](int t) {
    return speed(poses, t, ankle, fps) < kStandingSpeed && speed(poses, t, ball, fps) < kStandingSpeed;
  };
  const auto height = [&](int t) { return scene.clearance(poses[t].p_WB[ankle]); };
  PerFrame<double> heights;  // beside plates not of a foot that passes their edges
  for (int t = 0; t < poses.count(); ++t)
    if (scene.flat() || slow(t)) heights.push_back(height(t));
  PerFrame<bool> standing(poses.size(), false);
  if (heights.empty()) return standing;
  const double low = quantile(heights, kLowShare);
  for (int t = 0; t < poses.count(); ++t) standing[t] = height(t) < low + kStandingHeight && slow(t);
  return standing;
}

double level_feet(Reference& reference) {
  double largest = 0.0;
  for (int ankle : {kLeftAnkle, kRightAnkle}) {
    const int ball = ankle == kLeftAnkle ? kLeftFoot : kRightFoot;
    const PerFrame<bool> standing = standing_frames(reference.poses, ankle, reference.fps, reference.scene);
    const PerFrame<Quaterniond> soles = levelling(reference.poses, standing, ankle, reference.fps),
                                toes = levelling(reference.poses, standing, ball, reference.fps);
    for (int t = 0; t < reference.size(); ++t) {
      Quaterniond &q_ankle = reference.frames[t].q[ankle], &q_ball = reference.frames[t].q[ball];
      q_ankle = (q_ankle * soles[t]).normalized();
      q_ball = (soles[t].conjugate() * q_ball * toes[t]).normalized();
      for (const Quaterniond& q : {soles[t], toes[t]})
        largest = std::max(largest, log_map(q).norm() / kDegree);
    }
  }
  return largest;
}

PerFrame<double> standing_heights(const std::vector<SurfacePoint>& points, const PerFrame<BodyPoses>& poses,
                                  double fps, const Scene& scene, bool swinging_toes) {
  if (scene.flat() && swinging_toes) return lowest_resting_heights(points, poses);
  const auto left = standing_frames(poses, kLeftAnkle, fps, scene),
             right = standing_frames(poses, kRightAnkle, fps, scene);
  const auto height = [&](int body, const Vector3d& p, bool swings) {
    const double z = resting_height(body, p, scene);
    return swings && scene.height_under(p) > 0.0 ? std::max(z, 0.0) : z;
  };
  PerFrame<double> heights;
  for (int t = 0; t < poses.count(); ++t) {
    const std::vector<Vector3d> places = surface_positions(points, poses[t]);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const int body = points[k].body;
      const bool toes = body == kLeftFoot || body == kRightFoot;
      const bool swings = ((body == kLeftAnkle || body == kLeftFoot) && !left[t]) ||
                          ((body == kRightAnkle || body == kRightFoot) && !right[t]);
      if (swinging_toes || !toes || !swings) lowest = std::min(lowest, height(body, places[k], swings));
    }
    heights.push_back(lowest);
  }
  return heights;
}

PerFrame<double> support_heights(const Reference& reference) {
  return standing_heights(surface_points(reference.character), reference.poses, reference.fps,
                          reference.scene, false);
}

double toe_extension(const Character& character, const BodyPoses& pose, int ball, const Scene& scene) {
  const Vector3d& p = pose.p_WB[ball];
  const auto lowest = [&](double angle) {  // of the toe points, extended by that angle
    const Quaterniond bent = pose.q_WB[ball] * exp_map(Vector3d(-angle, 0, 0));
    double z = scene.clearance(p);
    for (const ContactPoint& point : character.contact_points)
      if (point.body == ball) z = std::min(z, scene.clearance(p + bent * point.p_B));
    return z;
  };
  if (lowest(0.0) >= 0.0) return 0.0;
  double low = 0.0, high = kLargestBend;
  for (int halving = 0; halving < 30; ++halving) {
    const double middle = 0.5 * (low + high);
    (lowest(middle) < 0.0 ? low : high) = middle;
  }
  return high;
}

void bend_toes(Reference& reference) {
  for (int t = 0; t < reference.size(); ++t)
    for (int ball : {kLeftFoot, kRightFoot}) {
      const double angle = toe_extension(reference.character, reference.poses[t], ball, reference.scene);
      if (angle == 0.0) continue;
      Quaterniond& joint = reference.frames[t].q[ball];
      joint = (joint * exp_map(Vector3d(-angle, 0, 0))).normalized();
    }
}

}  // namespace mimicx::motion
