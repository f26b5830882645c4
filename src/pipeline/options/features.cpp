#include "pipeline/options/features.h"

#include <algorithm>
#include <cmath>

namespace mimicx::pipeline::options {
namespace {

constexpr double kSmoothing = 0.1334;  ///< s to either side of a frame: 4 frames at 30 fps

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
    for (const FeatureKind& kind : kFeatureKinds)
      for (int k = 0; k < kind.entries; ++k)
        out[kind.first + k] =
            std::string(kind.name) + (kind.entries > 1 ? "." + std::string(kBodyNames[k]) : "");
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
    sum[kRootHeight] += reference.scene.clearance(reference.poses[t].p_WB[0]);
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
    MotionFeatures out;
    for (const FeatureKind& kind : kFeatureKinds)
      for (int k = 0; k < kind.entries; ++k)
        out[kind.first + k] = std::sqrt(static_cast<double>(kind.entries)) * kind.unit;
    return out;
  }();
  return units;
}

MotionFeatures scaled_features(const MotionFeatures& features) {
  MotionFeatures scaled;
  for (int k = 0; k < kFeatures; ++k) scaled[k] = features[k] / feature_units()[k];
  return scaled;
}

Array<double, kFeatureKindCount> kind_shares(const List<MotionFeatures>& motions) {
  Array<double, kFeatureKindCount> shares{};
  double all = 0.0;
  for (int i = 0; i < kFeatureKindCount; ++i) {
    const FeatureKind& kind = kFeatureKinds[i];
    for (int k = kind.first; k < kind.first + kind.entries; ++k) {
      double mean = 0.0;
      for (const MotionFeatures& motion : motions) mean += motion[k] / motions.count();
      for (const MotionFeatures& motion : motions) {
        const double off = (motion[k] - mean) / feature_units()[k];
        shares[i] += off * off;
      }
    }
    all += shares[i];
  }
  for (double& share : shares) share = all > 0.0 ? share / all : 0.0;
  return shares;
}

}  // namespace mimicx::pipeline::options
