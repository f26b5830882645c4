#include "import/plausibility.h"

#include <Eigen/LU>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/elementary.h"
#include "core/quantile.h"
#include "core/units.h"
#include "import/world_transform.h"
#include "motion/surface_points.h"

namespace mimicx::import {
namespace {

// Unit of length.
constexpr double kFastSupport = 3.0;   ///< m/s; a supporting joint is slower in half of the frames
constexpr double kFarHeight = 20.0;    ///< m of the pelvis over or under z = 0, in the median
constexpr double kCalmer = 1.0 / 3.0;  ///< how much calmer the support must be in the other unit

// Up axis.
constexpr double kSteadier = 0.5;  ///< how much steadier the floor must be along it than along z
constexpr double kStands = 0.6;    ///< mean component of feet → neck along the axis

// Frame rate.
constexpr double kClear = 0.03;              ///< m over the floor; nothing supports the body there
constexpr double kFootTravel = 0.08;         ///< m of either foot in a flight
constexpr double kLargestFactor = 4.2;       ///< between frame rates: 120 labelled 30, a little noise
constexpr int kShortestFlight = 5;           ///< frames
constexpr double kParabolaResidual = 0.012;  ///< m, root mean square, of a clean flight
constexpr int kSeveralFlights = 3;           ///< flights that must agree to change the frame rate
constexpr double kSameRate = 0.1;            ///< relative difference of the rates of flights that agree

// Floor and speeds.
constexpr double kFloorShare = 0.05;
constexpr double kFastPelvis = 8.0;     ///< m/s in the median: a sprinter's pace
constexpr double kSuspectJoint = 30.0;  ///< m/s, exceeded in 1 % of the frames: a pitcher's hand reaches 25

/// Quantile of the finite values; 0 without any. Absurd input can give values that are not finite.
double finite_quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  return values.empty() ? 0.0 : quantile(std::move(values), share);
}

/// Speed of a joint from the frame before, m/s.
double speed_of(const PerFrame<BodyPoses>& poses, int t, int joint, double fps) {
  return fps * (poses[t].p_WB[joint] - poses[t - 1].p_WB[joint]).norm();
}

/// Distance of the pelvis from zero along the axis that is up, m.
double median_height(const motion::Clip& clip) {
  const char axis = static_cast<char>(std::tolower(detect_up(clip).axis));
  std::vector<double> heights;
  for (const Vector3d& trans : clip.trans) heights.push_back(std::abs(trans[axis - 'x']));
  return finite_quantile(heights, 0.5);
}

PerFrame<double> lowest_heights(const Character& character, const PerFrame<BodyPoses>& poses) {
  const std::vector<motion::SurfacePoint> points = motion::surface_points(character);
  PerFrame<double> lowest;
  for (const BodyPoses& pose : poses) lowest.push_back(motion::lowest_height(points, pose));
  return lowest;
}

/// How much the farthest point of the body in a direction moves in that direction, m. It is small where the
/// direction is down, because the floor stops the body.
double support_spread(const motion::Clip& clip, const PerFrame<BodyPoses>& poses, const Vector3d& down) {
  const std::vector<motion::SurfacePoint> points = motion::surface_points(motion::character_of(clip));
  std::vector<double> deepest;
  for (const BodyPoses& pose : poses) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3d& p : motion::surface_positions(points, pose)) most = std::max(most, p.dot(down));
    deepest.push_back(most);
  }
  return finite_quantile(deepest, 0.9) - finite_quantile(deepest, 0.1);
}

/// Length of a joint's path, m.
double path_of(const PerFrame<BodyPoses>& poses, int joint) {
  double length = 0.0;
  for (int t = 1; t < poses.count(); ++t) length += (poses[t].p_WB[joint] - poses[t - 1].p_WB[joint]).norm();
  return length;
}

/// Largest extent of a joint's path in frames first … last, m.
double travel_of(const PerFrame<BodyPoses>& poses, int joint, int first, int last) {
  Vector3d low = poses[first].p_WB[joint], high = low;
  for (int t = first; t <= last; ++t) {
    low = low.cwiseMin(poses[t].p_WB[joint]);
    high = high.cwiseMax(poses[t].p_WB[joint]);
  }
  return (high - low).norm();
}

/// Least squares of a parabola to z[first..last] over the frame number.
struct Parabola {
  double acceleration = 0;  ///< m per frame²
  double residual = 0;      ///< m, root mean square
};
Parabola fit_parabola(const PerFrame<double>& z, int first, int last) {
  const int n = last - first + 1;
  Eigen::MatrixX3d powers(n, 3);
  Eigen::VectorXd values(n);
  for (int i = 0; i < n; ++i) {
    const double s = i - 0.5 * (n - 1);
    powers.row(i) << 1.0, s, 0.5 * s * s;
    values[i] = z[first + i];
  }
  const Matrix3d normal = powers.transpose() * powers;
  const Vector3d c = normal.inverse() * (powers.transpose() * values);
  return {c[2], (powers * c - values).norm() / std::sqrt(n)};
}

/// Successive frames in which nothing supports the body.
struct Flight {
  int frames = 0;
  double acceleration = 0;  ///< downward, m per frame²
};

List<Flight> flights_of(const motion::Clip& clip) {
  const Character character = motion::character_of(clip);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const PerFrame<double> lowest = lowest_heights(character, poses);
  const double floor = finite_quantile(lowest, kFloorShare);
  PerFrame<double> height;
  for (const BodyPoses& pose : poses) height.push_back(center_of_mass(character, pose).z());
  List<Flight> flights;
  for (int first = 0; first < lowest.count();) {
    int end = first;
    while (end < lowest.count() && lowest[end] > floor + kClear) ++end;
    const int length = end - first;
    if (length >= kShortestFlight) {
      const Parabola p = fit_parabola(height, first, end - 1);
      // A foot that does not move supports the body at any height.
      const bool free = travel_of(poses, kLeftFoot, first, end - 1) > kFootTravel &&
                        travel_of(poses, kRightFoot, first, end - 1) > kFootTravel;
      if (free && p.residual < kParabolaResidual && p.acceleration < 0.0)
        flights.push_back({length, -p.acceleration});
    }
    first = std::max(end, first + 1);
  }
  return flights;
}

}  // namespace

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

double support_speed(const motion::Clip& clip) {
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  std::vector<double> stillest;
  for (int t = 1; t < poses.count(); ++t)
    stillest.push_back(
        std::min(speed_of(poses, t, kLeftFoot, clip.fps), speed_of(poses, t, kRightFoot, clip.fps)));
  return finite_quantile(stillest, 0.5);
}

bool is_wrong_scale(const motion::Clip& clip, double speed, double speed_scaled) {
  return (speed > kFastSupport || median_height(clip) > kFarHeight) && speed_scaled < kCalmer * speed;
}

double detect_scale(const motion::Clip& clip) {
  const double speed = support_speed(clip);
  for (const double scale : {0.01, 0.001}) {
    motion::Clip scaled = clip;
    for (Vector3d& trans : scaled.trans) trans *= scale;
    const double speed_scaled = support_speed(scaled);
    if (!is_wrong_scale(clip, speed, speed_scaled)) return 1.0;
    if (!is_wrong_scale(scaled, speed_scaled, 0.0)) return scale;
  }
  return 1.0;
}

UpAxis detect_up(const motion::Clip& clip) {
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  Vector3d mean = Vector3d::Zero();
  for (const BodyPoses& pose : poses)
    mean += (pose.p_WB[kNeck] - 0.5 * (pose.p_WB[kLeftAnkle] + pose.p_WB[kRightAnkle])).normalized();
  mean /= static_cast<double>(clip.frames());
  int axis = 0;
  mean.cwiseAbs().maxCoeff(&axis);
  UpAxis up;
  up.along = std::abs(mean[axis]);
  const Vector3d down = mean[axis] > 0 ? Vector3d(-Vector3d::Unit(axis)) : Vector3d(Vector3d::Unit(axis));
  up.sure = up.along > kStands &&
            (axis == 2 ||
             support_spread(clip, poses, down) < kSteadier * support_spread(clip, poses, -Vector3d::UnitZ()));
  // Head down: the file is upside down, unless the hands support the body.
  if (axis == 2 && mean.z() < 0.0)
    up.sure = up.sure && path_of(poses, kLeftFoot) < path_of(poses, kLeftWrist);
  if (up.sure) up.axis = axis_letter(mean);
  return up;
}

std::optional<FallRate> rate_from_flights(const motion::Clip& clip) {
  const List<Flight> flights = flights_of(clip);
  if (flights.empty()) return std::nullopt;
  double sum = 0.0, weights = 0.0;
  for (const Flight& flight : flights) {
    // The uncertainty of the curvature falls with the fifth power of the length.
    const double weight = pow(flight.frames, 5);
    sum += weight * flight.acceleration;
    weights += weight;
  }
  const double per_frame = sum / weights;
  FallRate fall;
  fall.flights = flights.count();
  fall.acceleration = per_frame * clip.fps * clip.fps;
  fall.fps = std::sqrt(kGravity / per_frame);
  const double factor = fall.fps / clip.fps;
  if (std::max(factor, 1.0 / factor) > kLargestFactor) return std::nullopt;
  fall.agreed = flights.count() >= kSeveralFlights &&
                std::all_of(flights.begin(), flights.end(), [&](const Flight& flight) {
                  return std::abs(std::sqrt(kGravity / flight.acceleration) / fall.fps - 1.0) < kSameRate;
                });
  return fall;
}

double detect_floor(const motion::Clip& clip) {
  return finite_quantile(lowest_heights(motion::character_of(clip), motion::poses_of(clip)), kFloorShare);
}

std::vector<std::string> implausible_speeds(const motion::Clip& clip) {
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  std::vector<double> pelvis, fastest;
  for (int t = 1; t < poses.count(); ++t) {
    pelvis.push_back(speed_of(poses, t, kPelvis, clip.fps));
    double most = 0.0;
    for (int j = 0; j < kBodies; ++j) most = std::max(most, speed_of(poses, t, j, clip.fps));
    fastest.push_back(most);
  }
  std::vector<std::string> said;
  if (const double speed = finite_quantile(pelvis, 0.5); speed > kFastPelvis)
    said.push_back("the pelvis moves at " + short_number(speed) +
                   " m/s in the median: are scale and frame rate right? (--scale, --fps)");
  if (const double speed = finite_quantile(fastest, 0.99); speed > kSuspectJoint)
    said.push_back("a joint reaches " + short_number(speed) +
                   " m/s: are scale and frame rate right? (--scale, --fps)");
  return said;
}

}  // namespace mimicx::import
