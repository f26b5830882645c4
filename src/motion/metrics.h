/// Metrics of a motion: its distance from the truth, and its physical plausibility.       docs/metrics.md
///
/// Input positions are in metres; results are in the units of `metric_definitions` (mm, mm/frame, …). Every
/// result is a mean with its number of samples; it is NaN without samples (no truth, too few frames). The
/// floor is z = 0. Truth and motion are compared frame by frame, without resampling or shift in time.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "motion/surface_points.h"

namespace mimicx::motion {

/// Success requires that no body is ever farther than this from its reference, m.
inline constexpr double kMaxBodyDistance = 0.5;

/// Success requires an MPJPE of at most this, m.
inline constexpr double kMaxMeanDistance = 0.06;

/// Of motions that are scored, frames/s: distances and slides per frame depend on it.
inline constexpr double kMetricRate = 30.0;

/// A point at or below this height touches the floor, m.
inline constexpr double kContactHeight = 0.005;

/// The input of the metrics; one entry per frame.
struct MotionSamples {
  PerFrame<PerBody<Vector3d>> joints;       ///< world positions, m
  PerFrame<std::vector<Vector3d>> surface;  ///< of `surface_points`, feet first, m
  std::vector<double> self_depth;  ///< mean overlap of the body's own capsule pairs, m; 0 without any
  double fps = 30.0;
  Scene scene;  ///< heights are over its ground

  int frames() const { return joints.count(); }
};

MotionSamples sample_motion(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                            const Scene& scene = {});

/// The first `frames` frames.
MotionSamples head_of(MotionSamples samples, int frames);

struct MetricValue {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::size_t count = 0;  ///< samples it is a mean of
};

struct Metrics {
  MetricValue mrpe, gmpjpe, mpjpe, pa_mpjpe, vel, accel;         // against the truth
  MetricValue fs, fs_0, gp, gp_max, floating, jitter, self_pen;  // of the motion alone
  MetricValue fs_gt, float_gt;                                   // of the motion where the truth has contact
  MetricValue slip, slip_share, chatter;  // of the floor's forces: judge/force_metrics.h, else NaN
};

struct MetricDefinition {
  const char* name;  ///< as in the tables, e.g. "PA-MPJPE"
  const char* unit;
  const char* definition;
  MetricValue Metrics::*value;
};
/// All metrics in the order of the tables, with the definition that is printed beside the numbers.
const std::vector<MetricDefinition>& metric_definitions();

/// @param truth  may be null: the metrics that need it are NaN then
/// @throws std::invalid_argument when truth and motion differ in length, frame rate or number of points
Metrics evaluate_motion(const MotionSamples& motion, const MotionSamples* truth);

/// docs/metrics.md, "Success": the whole length was simulated, no body was ever farther than 0.5 m from the
/// prepared reference, and MPJPE to it is at most 60 mm.
struct Success {
  bool success = false;
  std::string reason;         ///< of a failure; empty for a success
  double max_distance_m = 0;  ///< largest distance of any body from its reference in any frame
  double mpjpe_mm = 0;
};
/// @param simulated  a motion shorter than the reference (a fall) is no success
Success success_of(const MotionSamples& simulated, const MotionSamples& reference);

}  // namespace mimicx::motion
