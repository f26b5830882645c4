#include "motion/feet.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "motion/surface.h"

namespace mimicx {
namespace {

constexpr double kStandingSpeed = 0.4;    // m/s
constexpr double kStandingHeight = 0.06;  // m over the low percentile
constexpr double kLowShare = 0.1;
constexpr int kFewestFrames = 10;
constexpr double kSmallest = 10.0 * kDegree, kLargest = 30.0 * kDegree;
constexpr double kLargestBend = 60.0 * kDegree;

double quantile(std::vector<double> values, double share) {
  const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return values[static_cast<std::size_t>(n)];
}

/// Speed of a joint at a frame, m/s, by central differences.
double speed(const std::vector<BodyPoses>& poses, std::size_t t, int body, double fps) {
  const std::size_t before = t > 0 ? t - 1 : 0, after = std::min(t + 1, poses.size() - 1);
  if (after == before) return 0.0;
  const auto i = static_cast<std::size_t>(body);
  return fps / static_cast<double>(after - before) * (poses[after].p_WB[i] - poses[before].p_WB[i]).norm();
}

/// Body-fixed rotation that levels a body whose up axis (y) should point up in the given frames.
Quaterniond levelling(const std::vector<BodyPoses>& poses, const std::vector<bool>& standing, int body) {
  std::array<std::vector<double>, 3> up;  // world's up in the body's frame
  for (std::size_t t = 0; t < poses.size(); ++t) {
    if (!standing[t]) continue;
    const Vector3d u = poses[t].q_WB[static_cast<std::size_t>(body)].conjugate() * Vector3d::UnitZ();
    for (std::size_t k = 0; k < 3; ++k) up[k].push_back(u[static_cast<int>(k)]);
  }
  if (static_cast<int>(up[0].size()) < kFewestFrames) return Quaterniond::Identity();
  const Vector3d median(quantile(up[0], 0.5), quantile(up[1], 0.5), quantile(up[2], 0.5));
  if (median.norm() < 0.5) return Quaterniond::Identity();  // no common direction
  const Vector3d rotation = log_map(rotation_between(Vector3d::UnitY(), median));
  const double angle = rotation.norm();
  if (angle < kSmallest || angle > 1.5 * kLargest) return Quaterniond::Identity();
  return exp_map(std::min(1.0, kLargest / angle) * rotation);
}

}  // namespace

std::vector<bool> standing_frames(const std::vector<BodyPoses>& poses, int ankle, double fps) {
  const int ball = ankle == kLeftAnkle ? kLeftFoot : kRightFoot;
  std::vector<double> heights;
  for (const BodyPoses& pose : poses) heights.push_back(pose.p_WB[static_cast<std::size_t>(ankle)].z());
  const double low = quantile(heights, kLowShare);
  std::vector<bool> standing(poses.size());
  for (std::size_t t = 0; t < poses.size(); ++t)
    standing[t] = heights[t] < low + kStandingHeight && speed(poses, t, ankle, fps) < kStandingSpeed &&
                  speed(poses, t, ball, fps) < kStandingSpeed;
  return standing;
}

double level_feet(Reference& reference) {
  double largest = 0.0;
  for (int ankle : {kLeftAnkle, kRightAnkle}) {
    const int ball = ankle == kLeftAnkle ? kLeftFoot : kRightFoot;
    const std::vector<bool> standing = standing_frames(reference.poses, ankle, reference.fps);
    const Quaterniond sole = levelling(reference.poses, standing, ankle);
    const Quaterniond toes = levelling(reference.poses, standing, ball);
    for (ReferenceFrame& frame : reference.frames) {
      Quaterniond &q_ankle = frame.q[static_cast<std::size_t>(ankle)],
                  &q_ball = frame.q[static_cast<std::size_t>(ball)];
      q_ankle = (q_ankle * sole).normalized();
      q_ball = (sole.conjugate() * q_ball * toes).normalized();
    }
    for (const Quaterniond& q : {sole, toes}) largest = std::max(largest, log_map(q).norm() / kDegree);
  }
  return largest;
}

std::vector<double> support_heights(const Reference& reference) {
  const std::vector<SurfacePoint> points = surface_points(reference.character);
  const auto left = standing_frames(reference.poses, kLeftAnkle, reference.fps);
  const auto right = standing_frames(reference.poses, kRightAnkle, reference.fps);
  std::vector<double> heights;
  for (std::size_t t = 0; t < reference.poses.size(); ++t) {
    std::vector<SurfacePoint> support;
    for (const SurfacePoint& point : points)
      if ((point.body != kLeftFoot || left[t]) && (point.body != kRightFoot || right[t]))
        support.push_back(point);
    heights.push_back(lowest_height(support, reference.poses[t]));
  }
  return heights;
}

void bend_toes(Reference& reference) {
  for (std::size_t t = 0; t < reference.frames.size(); ++t)
    for (int ball : {kLeftFoot, kRightFoot}) {
      const auto i = static_cast<std::size_t>(ball);
      const Vector3d& p = reference.poses[t].p_WB[i];
      const Quaterniond& q = reference.poses[t].q_WB[i];
      const auto lowest = [&](double angle) {  // of the toe points, extended by that angle
        const Quaterniond bent = q * exp_map(Vector3d(-angle, 0, 0));
        double z = p.z();
        for (const ContactPoint& point : reference.character.contact_points)
          if (point.body == ball) z = std::min(z, (p + bent * point.p_B).z());
        return z;
      };
      if (lowest(0.0) >= 0.0) continue;
      double low = 0.0, high = kLargestBend;
      for (int halving = 0; halving < 30; ++halving) {
        const double middle = 0.5 * (low + high);
        (lowest(middle) < 0.0 ? low : high) = middle;
      }
      Quaterniond& joint = reference.frames[t].q[i];
      joint = (joint * exp_map(Vector3d(-high, 0, 0))).normalized();
    }
}

}  // namespace mimicx
