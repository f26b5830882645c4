#include "motion/published_protocols.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/units.h"
#include "motion/procrustes.h"
#include "motion/surface_points.h"

namespace mimicx::motion {
namespace {

constexpr double kMaxMeanDistance = 0.5;  ///< m; phc: a frame beyond it is the end of a success
constexpr int kFirstJudged = 2;           ///< frame; phc: after the start and the first simulated frame
constexpr double kTolerance = 0.005;      ///< m; pmr: of geometry, up and down
constexpr int kSegment = 100;             ///< frames; emdb

using JointPaths = PerFrame<PerBody<Vector3d>>;

MetricValue mean_of(double sum, std::size_t count, double factor) {
  if (count == 0) return {};
  return {factor * sum / static_cast<double>(count), count};
}

/// Mean distance of all joints except the toes.
double mean_distance(const PerBody<Vector3d>& p, const PerBody<Vector3d>& g) {
  double sum = 0.0;
  for (int j = 0; j < kBodies; ++j) sum += j == kLeftFoot || j == kRightFoot ? 0.0 : (p[j] - g[j]).norm();
  return sum / (kBodies - 2);
}

/// Success in percent: 100 or 0.
MetricValue success(const JointPaths& p, const JointPaths& g) {
  bool near = true;
  for (int t = kFirstJudged; t < p.count(); ++t) near = near && mean_distance(p[t], g[t]) <= kMaxMeanDistance;
  return {near ? 100.0 : 0.0, 1};
}

/// Depth of the lowest point where it is deeper than the tolerance, else 0.
MetricValue penetration(const MotionSamples& motion) {
  double sum = 0.0;
  for (const auto& points : motion.surface) {
    const double depth = -lowest_height(points, motion.scene);
    sum += depth > kTolerance ? depth : 0.0;
  }
  return mean_of(sum, motion.surface.size(), kMm);
}

/// Horizontal path of the foot points that touch the floor in two successive frames; 0 for a pair without
/// any.
MetricValue skate(const MotionSamples& motion) {
  const auto& surface = motion.surface;
  const Scene& scene = motion.scene;
  double sum = 0.0;
  for (int t = 0; t + 1 < surface.count(); ++t) {
    double way = 0.0;
    int touching = 0;
    for (std::size_t i = 0; i < kFootPoints; ++i) {
      const Vector3d &now = surface[t][i], &next = surface[t + 1][i];
      if (scene.clearance(now) > kTolerance || scene.clearance(next) > kTolerance) continue;
      way += (next - now).head<2>().norm();
      ++touching;
    }
    sum += touching == 0 ? 0.0 : way / touching;
  }
  return mean_of(sum, surface.size() - 1, kMm);
}

/// The joints of the frames from `first` on, a column each.
Points joints_of(const JointPaths& joints, int first, int count) {
  Points points(3, kBodies * count);
  for (int t = 0; t < count; ++t)
    for (int j = 0; j < kBodies; ++j) points.col(kBodies * t + j) = joints[first + t][j];
  return points;
}

/// MPJPE in segments of 100 frames, each moved by the similarity that fits `aligned` of its frames best.
MetricValue segment_error(const JointPaths& p, const JointPaths& g, int aligned) {
  double sum = 0.0;
  for (int first = 0; first < p.count(); first += kSegment) {
    const int count = std::min(kSegment, p.count() - first), fitted = std::min(aligned, count);
    const Similarity s = nearest_similarity(joints_of(p, first, fitted), joints_of(g, first, fitted));
    sum += (s.of(joints_of(p, first, count)) - joints_of(g, first, count)).colwise().norm().sum();
  }
  return mean_of(sum, kBodies * p.size(), kMm);
}

/// Distance of the pelvis after the rigid transform that fits the whole path, in % of the length of the
/// truth's path.
MetricValue root_error(const JointPaths& p, const JointPaths& g) {
  Points way(3, p.count()), true_way(3, p.count());
  double length = 0.0;
  for (int t = 0; t < p.count(); ++t) {
    way.col(t) = p[t][kPelvis];
    true_way.col(t) = g[t][kPelvis];
    if (t > 0) length += (g[t][kPelvis] - g[t - 1][kPelvis]).norm();
  }
  if (!(length > 0.0)) return {};
  const Similarity s = nearest_similarity(way, true_way, true);
  return mean_of((s.of(way) - true_way).colwise().norm().sum(), p.size(), 100.0 / length);
}

void require_comparable(const MotionSamples& motion, const MotionSamples& truth) {
  if (motion.frames() != truth.frames() || motion.frames() < 2)
    throw std::invalid_argument("a protocol needs as many frames of motion (" +
                                std::to_string(motion.frames()) + ") as of truth (" +
                                std::to_string(truth.frames()) + "), at least 2");
  for (const MotionSamples* s : {&motion, &truth})
    if (std::abs(s->fps - kProtocolRate) > 1e-6 * kProtocolRate)
      throw std::invalid_argument("protocols are defined at 30 frames per second, not at " +
                                  std::to_string(s->fps) + " (`mimicx convert --rate 30`)");
}

}  // namespace

const std::vector<std::string>& protocol_names() {
  static const std::vector<std::string> names = {"phc", "pmr", "emdb"};
  return names;
}

const std::vector<ProtocolColumn>& protocol_columns(Protocol protocol) {
  constexpr const char* kSmplSim = "SMPLSim smpl_sim/smpllib/smpl_eval.py, compute_metrics_lite";
  constexpr const char* kRestoration = "arXiv 2412.17377, read as PhysDiff's, arXiv 2212.02500";
  constexpr const char* kWham = "WHAM lib/eval/evaluate_emdb.py, GVHMR hmr4d/utils/eval/eval_utils.py";
  static const std::vector<ProtocolColumn> phc = {
      {"Succ", "%",
       "motions of which no frame from the third on has a mean distance of the joints, toes left out, over "
       "0.5 m, no alignment",
       "PHC phc/env/tasks/humanoid_im.py, phc/learning/im_amp.py"},
      {"E_g-mpjpe", "mm", "mean distance of the joints from the truth's, no alignment", kSmplSim},
      {"E_mpjpe", "mm", "the same after moving both pelvises to the origin", kSmplSim},
      {"E_pa-mpjpe", "mm", "the same after a similarity Procrustes per frame", kSmplSim},
      {"E_acc", "mm/frame^2", "mean norm of the difference of the joints' second differences", kSmplSim},
      {"E_vel", "mm/frame", "mean norm of the difference of the joints' first differences", kSmplSim}};
  static const std::vector<ProtocolColumn> pmr = {
      {"GP", "mm", "depth of the lowest surface point where it is deeper than 5 mm, else 0", kRestoration},
      {"Float", "mm", "height of the lowest surface point where it is higher than 5 mm, else 0",
       kRestoration},
      {"FS", "mm/frame", "horizontal way of foot points at z <= 5 mm in both frames, 0 without any",
       "the same; 0 without any: SMPLSim smpl_sim/smpllib/smpl_eval.py, compute_skate"},
      {"Accel", "mm/frame^2", "mean norm of the difference of the joints' second differences", kSmplSim}};
  static const std::vector<ProtocolColumn> emdb = {
      {"WA-MPJPE", "mm", "segments of 100 frames, each moved by the similarity that fits all of it", kWham},
      {"W-MPJPE", "mm", "segments of 100 frames, each moved by the similarity that fits its first two",
       kWham},
      {"RTE", "%", "distance of the pelvis over the truth's whole way, after a rigid fit of the way", kWham},
      {"Jitter", "10 m/s^3", "mean norm of the joints' third derivative", kWham},
      {"FS", "mm/frame", "way of the foot points where the truth's move less than 10 mm per frame", kWham}};
  return protocol == Protocol::kPhc ? phc : protocol == Protocol::kPmr ? pmr : emdb;
}

std::vector<MetricValue> evaluate_by(Protocol protocol, const MotionSamples& motion,
                                     const MotionSamples& truth) {
  require_comparable(motion, truth);
  const Metrics m = evaluate_motion(motion, &truth);
  switch (protocol) {
    case Protocol::kPhc:
      return {success(motion.joints, truth.joints), m.gmpjpe, m.mpjpe, m.pa_mpjpe, m.accel, m.vel};
    case Protocol::kPmr:
      return {penetration(motion), m.floating, skate(motion), m.accel};
    default:
      return {segment_error(motion.joints, truth.joints, kSegment),
              segment_error(motion.joints, truth.joints, 2), root_error(motion.joints, truth.joints),
              m.jitter, m.fs_gt};
  }
}

MetricValue pooled(const std::vector<MetricValue>& values) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const MetricValue& v : values) {
    if (v.count == 0) continue;
    sum += v.value * static_cast<double>(v.count);
    count += v.count;
  }
  return mean_of(sum, count, 1.0);
}

}  // namespace mimicx::motion
