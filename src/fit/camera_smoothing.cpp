#include "fit/camera_smoothing.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/so3.h"
#include "core/units.h"
#include "fit/jitter.h"

namespace mimicx::fit {
namespace {

constexpr double kWidth = 0.1;  ///< s, σ of the Gaussian
constexpr double kReach = 3.0;  ///< in its σ

Quaterniond camera_turn(const Eigen::Matrix4d& E) { return Quaterniond(Matrix3d(E.topLeftCorner<3, 3>())); }

/// Mean rotation and position around a frame, over equally many frames before and after it, so that a steady
/// pan does not change.
Eigen::Matrix4d mean_around(const PerFrame<Eigen::Matrix4d>& path, int t, double sigma) {
  const int reach = std::min({static_cast<int>(kReach * sigma), t, path.count() - 1 - t});
  const Quaterniond middle = camera_turn(path[t]);
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  Vector3d eye = Vector3d::Zero();
  double sum = 0.0;
  for (int i = t - reach; i <= t + reach; ++i) {
    const double w = exp(-0.5 * pow((i - t) / sigma, 2));
    const Eigen::Vector4d q = camera_turn(path[i]).coeffs();
    turn += w * (q.dot(middle.coeffs()) < 0.0 ? Eigen::Vector4d(-q) : q);
    eye += w * motion::eye_of(path[i]);
    sum += w;
  }
  Eigen::Matrix4d E = Eigen::Matrix4d::Identity();
  E.topLeftCorner<3, 3>() = Quaterniond(Eigen::Vector4d(turn.normalized())).toRotationMatrix();
  E.topRightCorner<3, 1>() = -E.topLeftCorner<3, 3>() * eye / sum;
  return E;
}

}  // namespace

CameraJitter jitter_of_camera(const PerFrame<Eigen::Matrix4d>& path) {
  std::vector<double> turns, places;
  for (int t = 0; t + 3 < path.count(); ++t) {
    Array<Vector3d, 3> step;
    for (int i = 0; i < 3; ++i)
      step[i] = log_map(camera_turn(path[t + i + 1]) * camera_turn(path[t + i]).conjugate());
    const Vector3d turn = step[0] - 2.0 * step[1] + step[2];
    const Vector3d place = motion::eye_of(path[t + 3]) - 3.0 * motion::eye_of(path[t + 2]) +
                           3.0 * motion::eye_of(path[t + 1]) - motion::eye_of(path[t]);
    for (int i = 0; i < 3; ++i) turns.push_back(std::abs(turn[i])), places.push_back(std::abs(place[i]));
  }
  return {jitter_of(turns), jitter_of(places)};
}

PerFrame<Eigen::Matrix4d> smoothed_path(const PerFrame<Eigen::Matrix4d>& path, double fps) {
  const CameraJitter jitter = jitter_of_camera(path);
  if (jitter.turn < kCameraTurn * kDegree && jitter.place < kCameraPlace) return path;
  PerFrame<Eigen::Matrix4d> calm;
  for (int t = 0; t < path.count(); ++t) calm.push_back(mean_around(path, t, kWidth * fps));
  return calm;
}

}  // namespace mimicx::fit
