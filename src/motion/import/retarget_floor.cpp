#include "motion/import/retarget_floor.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "core/units.h"
#include "motion/feet.h"
#include "motion/surface.h"

namespace mimicx {
namespace {

constexpr std::size_t kEnough = 10;  ///< standing frames

/// Median of "up" in the ankle's frame while the foot stands; none where it hardly does.
std::optional<Vector3d> standing_up(const std::vector<BodyPoses>& poses, int ankle, double fps) {
  const auto body = static_cast<std::size_t>(ankle);
  const std::vector<bool> stands = standing_frames(poses, ankle, fps);
  std::vector<std::pair<double, std::size_t>> order;  // height of the ankle, frame
  for (std::size_t t = 0; t < poses.size(); ++t)
    if (stands[t]) order.emplace_back(poses[t].p_WB[body].z(), t);
  if (order.size() < kEnough) return std::nullopt;
  std::sort(order.begin(), order.end());
  order.resize((order.size() + 2) / 3);
  Vector3d median;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& [height, t] : order)
      values.push_back((poses[t].q_WB[body].conjugate() * Vector3d::UnitZ())[axis]);
    std::sort(values.begin(), values.end());
    median[axis] = values[values.size() / 2];
  }
  return median.normalized();
}

Vector3d mirrored(const Vector3d& v) { return {-v.x(), v.y(), v.z()}; }

}  // namespace

void level_soles(bool neutral_stands, Calibration& calibration, Clip& clip) {
  constexpr double kLeast = 5.0 * kDegree, kAlike = 15.0 * kDegree;
  const double most = (neutral_stands ? 30.0 : 60.0) * kDegree;
  const std::vector<BodyPoses> poses = poses_of(clip);
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
      Quaterniond& q_JB = calibration.q_JB[static_cast<std::size_t>(body)];
      q_JB = (q_JB * turn).normalized();
    }
    char text[96];
    std::snprintf(text, sizeof text, "the %s sole is level where it stands: turned by %.0f degrees", side,
                  angle / kDegree);
    clip.decisions.emplace_back(text);
  };
  level(left, kLeftAnkle, kLeftFoot, "left");
  level(right, kRightAnkle, kRightFoot, "right");
}

double put_on_floor(Clip& clip) {
  const auto points = surface_points(make_character(clip.usable_betas()));
  const std::vector<BodyPoses> poses = poses_of(clip);
  const std::vector<bool> left = standing_frames(poses, kLeftAnkle, clip.fps);
  const std::vector<bool> right = standing_frames(poses, kRightAnkle, clip.fps);
  std::vector<double> feet, all;  // heights of the lowest points
  for (std::size_t t = 0; t < poses.size(); ++t) {
    const std::vector<Vector3d> p = surface_positions(points, poses[t]);
    double lowest[2] = {p[0].z(), p[0].z()};  // of the feet, of all
    for (std::size_t i = 0; i < p.size(); ++i)
      for (int k = i < kFootPoints ? 0 : 1; k < 2; ++k) lowest[k] = std::min(lowest[k], p[i].z());
    if (left[t] || right[t]) feet.push_back(lowest[0]);
    all.push_back(lowest[1]);
  }
  const bool stands = feet.size() >= kEnough;
  std::vector<double>& heights = stands ? feet : all;
  const auto floor =
      heights.begin() + static_cast<std::ptrdiff_t>(stands ? heights.size() / 2 : heights.size() / 20);
  std::nth_element(heights.begin(), floor, heights.end());
  const double lift = -*floor;
  for (Vector3d& trans : clip.trans) trans.z() += lift;
  char text[64];
  std::snprintf(text, sizeof text, "floor: moved by %+.3f m", lift);
  clip.decisions.emplace_back(text);
  return lift;
}

}  // namespace mimicx
