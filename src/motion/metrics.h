/// How close a motion is to the truth and how physical it is by itself.                docs/metrics.md
///
/// Positions go in in metres, at the frame rate given; values come out in the unit of `metric_definitions`
/// (mm, mm/frame, …). Every value is a mean and says of how many samples; it is NaN where there is none
/// (no truth, too few frames). The floor is z = 0. Truth and motion are compared frame by frame: nothing is
/// resampled or shifted in time here.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "motion/surface_points.h"

namespace mimicx::motion {

/// A body that is ever farther than this from its reference is no success, m.
inline constexpr double kMaxBodyDistance = 0.5;

/// A point at this height or under it touches the floor, m.
inline constexpr double kContactHeight = 0.005;

/// What the metrics look at; one entry per frame.
struct MotionSamples {
  PerFrame<PerBody<Vector3d>> joints;       ///< world positions, m
  PerFrame<std::vector<Vector3d>> surface;  ///< of `surface_points`, feet first, m
  std::vector<double> self_depth;           ///< mean depth of the overlapping self pairs, m; 0 without any
  double fps = 30.0;

  int frames() const { return joints.count(); }
};

MotionSamples sample_motion(const Character& character, const PerFrame<BodyPoses>& poses, double fps);

struct MetricValue {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::size_t count = 0;  ///< samples it is a mean of
};

struct Metrics {
  MetricValue mrpe, gmpjpe, mpjpe, pa_mpjpe, vel, accel;         // against the truth
  MetricValue fs, fs_0, gp, gp_max, floating, jitter, self_pen;  // of the motion alone
  MetricValue fs_gt, float_gt;                                   // of the motion, where the truth has contact
};

struct MetricDefinition {
  const char* name;  ///< as in the tables, e.g. "PA-MPJPE"
  const char* unit;
  const char* definition;
  MetricValue Metrics::*value;
};
/// All metrics in the order of the tables, with the definition to print beside the numbers.
const std::vector<MetricDefinition>& metric_definitions();

/// @param truth  null where there is none: the metrics that need it are NaN
/// @throws std::invalid_argument when truth and motion differ in length, frame rate or number of points
Metrics evaluate_motion(const MotionSamples& motion, const MotionSamples* truth);

/// docs/metrics.md, "Success": the whole length was simulated, no body was ever farther than 0.5 m from the
/// prepared reference, and MPJPE to it is at most 60 mm.
struct Success {
  bool success = false;
  std::string reason;         ///< why not; empty for a success
  double max_distance_m = 0;  ///< farthest any body ever was from its reference
  double mpjpe_mm = 0;
};
/// @param simulated  may be shorter than the reference (a fall): then it is no success
Success judge_success(const MotionSamples& simulated, const MotionSamples& reference);

}  // namespace mimicx::motion
