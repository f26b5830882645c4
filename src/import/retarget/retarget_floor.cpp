#include "import/retarget/retarget_floor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>

#include "core/quantile.h"
#include "core/units.h"
#include "motion/prepare/feet.h"
#include "motion/surface_points.h"

namespace mimicx::import {
namespace {

constexpr std::size_t kEnough = 10;  ///< standing frames

/// Median of "up" in the ankle's frame while the foot stands; none where it hardly does.
std::optional<Vector3d> standing_up(const PerFrame<BodyPoses>& poses, int ankle, double fps) {
  const PerFrame<bool> stands = motion::standing_frames(poses, ankle, fps);
  std::vector<std::pair<double, int>> order;  // height of the ankle, frame
  for (int t = 0; t < poses.count(); ++t)
    if (stands[t]) order.emplace_back(poses[t].p_WB[ankle].z(), t);
  if (order.size() < kEnough) return std::nullopt;
  std::sort(order.begin(), order.end());
  order.resize((order.size() + 2) / 3);
  Vector3d up;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& [height, t] : order)
      values.push_back((poses[t].q_WB[ankle].conjugate() * Vector3d::UnitZ())[axis]);
    up[axis] = median(values);
  }
  return up.normalized();
}

Vector3d mirrored(const Vector3d& v) { return {-v.x(), v.y(), v.z()}; }

}  // namespace

void level_soles(bool neutral_stands, Calibration& calibration, motion::Clip& clip) {
  constexpr double kLeast = 5.0 * kDegree, kAlike = 15.0 * kDegree;
  const double most = (neutral_stands ? 30.0 : 60.0) * kDegree;
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  std::optional<Vector3d> left = standing_up(poses, kLeftAnkle, clip.fps);
  std::optional<Vector3d> right = standing_up(poses, kRightAnkle, clip.fps);
  if (neutral_stands) {
    if (!left || !right || angle_between(*left, mirrored(*right)) > kAlike) return;
    left = (*left + mirrored(*right)).normalized();
    right = mirrored(*left);
  }
  const auto level = [&](const std::optional<Vector3d>& up, int ankle, int toes, const char* side) {
    if (!up) return;
    const double angle = angle_between(*up, Vector3d::UnitY());
    if (angle < kLeast || angle > most) return;
    const Quaterniond turn = rotation_between(Vector3d::UnitY(), *up);
    for (const int body : {ankle, toes}) {
      Quaterniond& q_JB = calibration.q_JB[body];
      q_JB = (q_JB * turn).normalized();
    }
    char text[96];
    std::snprintf(text, sizeof text,
                  "the %s sole is turned by %.0f degrees, so that it is level where it stands", side,
                  angle / kDegree);
    clip.decisions.emplace_back(text);
  };
  level(left, kLeftAnkle, kLeftFoot, "left");
  level(right, kRightAnkle, kRightFoot, "right");
}

double put_on_floor(motion::Clip& clip) {
  const auto points = motion::surface_points(make_character(clip.usable_betas()));
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const PerFrame<bool> left = motion::standing_frames(poses, kLeftAnkle, clip.fps);
  const PerFrame<bool> right = motion::standing_frames(poses, kRightAnkle, clip.fps);
  std::vector<double> feet, all;  // heights of the lowest points
  for (int t = 0; t < poses.count(); ++t) {
    const std::vector<Vector3d> p = motion::surface_positions(points, poses[t]);
    const auto lowest = [&](std::size_t count) {  // of the first points: those of the feet stand in front
      double z = p[0].z();
      for (const Vector3d& point : std::span(p).first(count)) z = std::min(z, point.z());
      return z;
    };
    if (left[t] || right[t]) feet.push_back(lowest(kFootPoints));
    all.push_back(lowest(p.size()));
  }
  const bool stands = feet.size() >= kEnough;
  const std::vector<double>& heights = stands ? feet : all;
  const double lift = -ranked(heights, static_cast<int>(heights.size() / (stands ? 2 : 20)));
  for (Vector3d& trans : clip.trans) trans.z() += lift;
  char text[64];
  std::snprintf(text, sizeof text, "floor: moved %.3f m %s", std::abs(lift), lift < 0.0 ? "down" : "up");
  clip.decisions.emplace_back(text);
  return lift;
}

}  // namespace mimicx::import
