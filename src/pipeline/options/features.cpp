#include "pipeline/options/features.h"

#include <algorithm>
#include <cmath>

namespace mimicx::pipeline::options {
namespace {

constexpr double kSmoothing = 0.1334;  ///< s to either side of a frame: 4 frames at 30 fps

/// Typical spread of each kind of feature over 19 real clips (walks, kicks, squats, jumps, dances, a crawl):
/// between the interquartile range and the standard deviation, rounded.
constexpr double kHeightUnit = 0.1;         ///< m
constexpr double kTurningUnit = 1.0;        ///< rad²/s²
constexpr double kPlanarUnit = 0.5;         ///< m²/s²
constexpr double kVerticalUnit = 0.2;       ///< m²/s²
constexpr double kAccelerationUnit = 25.0;  ///< m²/s⁴

/// Rows: weights of the frames of a window for value, first and second derivative at one of them.
using FitWeights = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Least-squares parabola through `frames` frames, evaluated at frame `at` of them.
FitWeights fit_weights(int frames, int at, double fps) {
  Eigen::MatrixX3d powers(frames, 3);
  for (int i = 0; i < frames; ++i) {
    const double s = (i - at) / fps;
    powers.row(i) << 1.0, s, s * s;
  }
  FitWeights weights = (powers.transpose() * powers).inverse() * powers.transpose();
  weights.row(2) *= 2.0;  // second derivative of c₂s²
  return weights;
}

/// Where the window of a frame starts, and its weights.
struct Window {
  int first;
  FitWeights weights;
};

Window window_of(int frame, int frames, double fps) {
  const int half = std::max(1, static_cast<int>(std::floor(kSmoothing * fps)));
  const int width = std::min(2 * half + 1, frames);
  const int first = std::clamp(frame - half, 0, frames - width);
  return {first, fit_weights(width, frame - first, fps)};
}

double vertical_turning(const motion::ReferenceFrame& frame) { return (frame.q[0] * frame.omega[0]).z(); }

}  // namespace

const Array<std::string, kFeatures>& feature_names() {
  static const Array<std::string, kFeatures> names = [] {
    Array<std::string, kFeatures> out;
    out[kRootHeight] = "root_height";
    out[kRootTurning] = "root_turning";
    for (int j = 0; j < kBodies; ++j) {
      out[kPlanarVelocity + j] = "planar_velocity." + std::string(kBodyNames[j]);
      out[kVerticalVelocity + j] = "vertical_velocity." + std::string(kBodyNames[j]);
      out[kAcceleration + j] = "acceleration." + std::string(kBodyNames[j]);
    }
    return out;
  }();
  return names;
}

MotionFeatures motion_features(const motion::Reference& reference) {
  const int frames = reference.size();
  if (frames < 3) throw DataError(reference.name, "", "at least 3 frames", std::to_string(frames));
  MotionFeatures sum{};
  for (int t = 0; t < frames; ++t) {
    const Window window = window_of(t, frames, reference.fps);
    double turning = 0.0;
    PerBody<Vector3d> velocity, acceleration;
    velocity.fill(Vector3d::Zero());
    acceleration.fill(Vector3d::Zero());
    for (int i = 0; i < window.weights.cols(); ++i) {
      const int frame = window.first + i;
      turning += window.weights(0, i) * vertical_turning(reference.frames[frame]);
      for (int j = 0; j < kBodies; ++j) {
        velocity[j] += window.weights(1, i) * reference.poses[frame].p_WB[j];
        acceleration[j] += window.weights(2, i) * reference.poses[frame].p_WB[j];
      }
    }
    sum[kRootHeight] += reference.poses[t].p_WB[0].z();
    sum[kRootTurning] += turning * turning;
    for (int j = 0; j < kBodies; ++j) {
      sum[kPlanarVelocity + j] += velocity[j].head<2>().squaredNorm();
      sum[kVerticalVelocity + j] += velocity[j].z() * velocity[j].z();
      sum[kAcceleration + j] += acceleration[j].squaredNorm();
    }
  }
  for (double& f : sum) f /= frames;
  return sum;
}

const MotionFeatures& feature_units() {
  static const MotionFeatures units = [] {
    // √22: the 22 joints together weigh as much as one entry, else the root's two would drown.
    const double joints = std::sqrt(static_cast<double>(kBodies));
    MotionFeatures out;
    out[kRootHeight] = kHeightUnit;
    out[kRootTurning] = kTurningUnit;
    for (int j = 0; j < kBodies; ++j) {
      out[kPlanarVelocity + j] = joints * kPlanarUnit;
      out[kVerticalVelocity + j] = joints * kVerticalUnit;
      out[kAcceleration + j] = joints * kAccelerationUnit;
    }
    return out;
  }();
  return units;
}

MotionFeatures scaled_features(const MotionFeatures& features) {
  MotionFeatures scaled;
  for (int k = 0; k < kFeatures; ++k) scaled[k] = features[k] / feature_units()[k];
  return scaled;
}

}  // namespace mimicx::pipeline::options
