#include "import/retarget/retarget_floor.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/elementary.h"
#include "core/number_text.h"
#include "core/quantile.h"
#include "core/units.h"
#include "motion/prepare/feet.h"
#include "motion/surface_points.h"

namespace mimicx::import {
namespace {

constexpr std::size_t kEnough = 10;  ///< standing frames

/// The third of the frames in which a foot stands with the lowest ankle: the heel rises while the ball still
/// stands. Empty where it hardly stands.
std::vector<int> flat_frames(const PerFrame<BodyPoses>& poses, int ankle, double fps) {
  const PerFrame<bool> stands = motion::standing_frames(poses, ankle, fps);
  std::vector<std::pair<double, int>> order;  // height of the ankle, frame
  for (int t = 0; t < poses.count(); ++t)
    if (stands[t]) order.emplace_back(poses[t].p_WB[ankle].z(), t);
  if (order.size() < kEnough) return {};
  std::sort(order.begin(), order.end());
  order.resize((order.size() + 2) / 3);
  std::vector<int> frames;
  for (const auto& [height, t] : order) frames.push_back(t);
  return frames;
}

/// Median of "up" in the ankle's frame while the foot is flat; none where it hardly stands.
std::optional<Vector3d> standing_up(const PerFrame<BodyPoses>& poses, int ankle, double fps) {
  const std::vector<int> flat = flat_frames(poses, ankle, fps);
  if (flat.empty()) return std::nullopt;
  Vector3d up;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const int t : flat) values.push_back((poses[t].q_WB[ankle].conjugate() * Vector3d::UnitZ())[axis]);
    up[axis] = median(values);
  }
  return up.normalized();
}

bool never_turns(const motion::Clip& clip, int body) {
  constexpr double kNever = 0.5 * kDegree;
  return std::all_of(clip.rotations.begin(), clip.rotations.end(), [&](const auto& frame) {
    return (frame[body] - clip.rotations[0][body]).norm() < kNever;
  });
}

/// The smallest bend of a hand about the axis of its extension that keeps its points above the floor.
/// @param points  of the hand, in its frame
double least_bend(const std::vector<Vector3d>& points, const Vector3d& wrist, const Quaterniond& hand,
                  const Vector3d& axis) {
  constexpr double kMost = 90.0 * kDegree;
  constexpr int kSteps = 90;
  const auto lowest = [&](double angle) {
    const Quaterniond bent = hand * exp_map(angle * axis);
    double z = wrist.z();
    for (const Vector3d& p : points) z = std::min(z, (wrist + bent * p).z());
    return z;
  };
  double best = 0.0, highest = lowest(0.0);
  for (int step = 1; step <= kSteps && highest < 0.0; ++step)
    for (const double angle : {step * kMost / kSteps, -step * kMost / kSteps})
      if (const double z = lowest(angle); highest < 0.0 && z > highest) best = angle, highest = z;
  return best;
}

/// Turns a joint further, in its own frame. @param turn, rotation  rotation vectors
void turn_by(const Vector3d& turn, Vector3d& rotation) {
  rotation = log_map(exp_map(rotation) * exp_map(turn));
}

Vector3d mirrored(const Vector3d& v) { return {-v.x(), v.y(), v.z()}; }

}  // namespace

void level_soles(bool neutral_stands, double least, Calibration& calibration, motion::Clip& clip) {
  constexpr double kAlike = 15.0 * kDegree;
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
    if (angle < least || angle > most) return;
    const Quaterniond turn = rotation_between(Vector3d::UnitY(), *up);
    for (const int body : {ankle, toes}) {
      Quaterniond& q_JB = calibration.q_JB[body];
      q_JB = (q_JB * turn).normalized();
    }
    clip.decisions.push_back(formatted(
        "the %s sole is turned by %.0f degrees, so that it is level where it stands", side, angle / kDegree));
  };
  level(left, kLeftAnkle, kLeftFoot, "left");
  level(right, kRightAnkle, kRightFoot, "right");
}

void level_rolls(const Character& character, motion::Clip& clip) {
  constexpr double kMost = 30.0 * kDegree, kEase = 0.15;  // s
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const int reach = static_cast<int>(std::lround(kEase * clip.fps));
  for (const auto& [ankle, toes] : {std::pair{kLeftAnkle, kLeftFoot}, {kRightAnkle, kRightFoot}}) {
    const PerFrame<bool> stands = motion::standing_frames(poses, ankle, clip.fps);
    const Vector3d along_B = character.joint_offset[toes].normalized();
    const Vector3d across_B = Vector3d::UnitY().cross(along_B).normalized();
    const auto stands_at = [&](int t) { return t >= 0 && t < poses.count() && stands[t]; };
    for (int t = 0; t < poses.count(); ++t) {
      int far = 0;  // frames to the nearest in which the foot stands
      while (far <= reach && !stands_at(t - far) && !stands_at(t + far)) ++far;
      if (far > reach) continue;
      const Vector3d along = poses[t].q_WB[ankle] * along_B, across = poses[t].q_WB[ankle] * across_B;
      const double level = std::clamp(-atan2(across.z(), along.cross(across).z()), -kMost, kMost);
      const double share = 1.0 - static_cast<double>(far) / (reach + 1);
      turn_by(share * level * along_B, clip.rotations[t][ankle]);
    }
  }
}

double put_on_floor(bool rigid_toes, motion::Clip& clip) {
  const auto points = motion::surface_points(make_character(clip.usable_betas()));
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  std::vector<double> all;  // heights of the lowest points
  PerFrame<Array<double, 2>> of_foot(poses.size());
  for (int t = 0; t < poses.count(); ++t) {
    const std::vector<Vector3d> p = motion::surface_positions(points, poses[t]);
    const auto lowest = [&](std::size_t first, std::size_t count) {  // points of the feet stand in front
      double z = p[first].z();
      for (const Vector3d& point : std::span(p).subspan(first, count)) z = std::min(z, point.z());
      return z;
    };
    of_foot[t] = {lowest(0, kPointsPerFoot), lowest(kPointsPerFoot, kPointsPerFoot)};
    all.push_back(lowest(0, p.size()));
  }
  std::vector<double> feet;  // of standing feet
  if (rigid_toes) {
    for (const int foot : {0, 1})
      for (const int t : flat_frames(poses, foot == 0 ? kLeftAnkle : kRightAnkle, clip.fps))
        feet.push_back(of_foot[t][foot]);
  } else {
    const PerFrame<bool> left = motion::standing_frames(poses, kLeftAnkle, clip.fps);
    const PerFrame<bool> right = motion::standing_frames(poses, kRightAnkle, clip.fps);
    for (int t = 0; t < poses.count(); ++t)
      if (left[t] || right[t]) feet.push_back(std::min(of_foot[t][0], of_foot[t][1]));
  }
  const bool stands = feet.size() >= kEnough;
  const std::vector<double>& heights = stands ? feet : all;
  const double lift = -ranked(heights, static_cast<int>(heights.size() / (stands ? 2 : 20)));
  for (Vector3d& trans : clip.trans) trans.z() += lift;
  clip.decisions.push_back(formatted("floor: moved %.3f m %s", std::abs(lift), lift < 0.0 ? "down" : "up"));
  return lift;
}

void extend_toes(motion::Clip& clip) {
  const Character character = make_character(clip.usable_betas());
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  for (int t = 0; t < poses.count(); ++t)
    for (const int ball : {kLeftFoot, kRightFoot}) {
      const double angle = motion::toe_extension(character, poses[t], ball);
      if (angle > 0.0) turn_by(Vector3d(-angle, 0.0, 0.0), clip.rotations[t][ball]);
    }
}

void bend_hands(motion::Clip& clip) {
  const auto surface = motion::surface_points(make_character(clip.usable_betas()));
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  double most = 0.0;
  for (const int wrist : {kLeftWrist, kRightWrist}) {
    if (!never_turns(clip, wrist)) continue;
    std::vector<Vector3d> hand;
    for (const motion::SurfacePoint& point : surface)
      if (point.body == wrist) hand.push_back(point.p_B);
    // The back of the hand is +y in the T-pose: extension is positive about +z on the left.
    const Vector3d axis = (is_right(wrist) ? -1.0 : 1.0) * Vector3d::UnitZ();
    for (int t = 0; t < poses.count(); ++t) {
      const double bend = least_bend(hand, poses[t].p_WB[wrist], poses[t].q_WB[wrist], axis);
      if (bend != 0.0) turn_by(bend * axis, clip.rotations[t][wrist]);
      most = std::max(most, std::abs(bend));
    }
  }
  if (most == 0.0) return;
  clip.decisions.push_back(
      formatted("hands bent by up to %.0f degrees, so that they lie on the floor", most / kDegree));
}

}  // namespace mimicx::import
