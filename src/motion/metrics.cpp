#include "motion/metrics.h"

#include <algorithm>
#include <stdexcept>

#include "character/body_words.h"
#include "core/elementary.h"
#include "core/number_text.h"
#include "core/units.h"
#include "motion/closest_points.h"
#include "motion/procrustes.h"

namespace mimicx::motion {
namespace {

constexpr double kStaticMotion = 0.010;  ///< m/frame; a slower foot point of the truth stands

using Joints = PerBody<Vector3d>;

/// Running mean.
struct Mean {
  double sum = 0.0;
  std::size_t count = 0;
  void add(double sample) {
    sum += sample;
    ++count;
  }
  MetricValue times(double factor) const {
    return count == 0 ? MetricValue{} : MetricValue{factor * sum / static_cast<double>(count), count};
  }
};

/// Order 1: Δp, 2: Δ²p, 3: Δ³p of joint j, at frames t .. t + order.
Vector3d difference(const PerFrame<Joints>& p, int t, int j, int order) {
  switch (order) {
    case 1:
      return p[t + 1][j] - p[t][j];
    case 2:
      return p[t + 2][j] - 2.0 * p[t + 1][j] + p[t][j];
    default:
      return p[t + 3][j] - 3.0 * p[t + 2][j] + 3.0 * p[t + 1][j] - p[t][j];
  }
}

/// Mean distance of the joints after the similarity transform that brings p closest to g.
double procrustes_error(const Joints& p, const Joints& g) {
  Points P(3, kBodies), G(3, kBodies);
  for (int j = 0; j < kBodies; ++j) {
    P.col(j) = p[j];
    G.col(j) = g[j];
  }
  return (nearest_similarity(P, G).of(P) - G).colwise().norm().mean();
}

void compare_with_truth(const MotionSamples& motion, const MotionSamples& truth, Metrics& m) {
  const auto &p = motion.joints, &g = truth.joints;
  Mean root, global, local, procrustes, vel, accel;
  for (int t = 0; t < p.count(); ++t) {
    root.add((p[t][0] - g[t][0]).norm());
    for (int j = 0; j < kBodies; ++j) {
      global.add((p[t][j] - g[t][j]).norm());
      local.add(((p[t][j] - p[t][0]) - (g[t][j] - g[t][0])).norm());
      if (t + 1 < p.count()) vel.add((difference(p, t, j, 1) - difference(g, t, j, 1)).norm());
      if (t + 2 < p.count()) accel.add((difference(p, t, j, 2) - difference(g, t, j, 2)).norm());
    }
    procrustes.add(procrustes_error(p[t], g[t]));
  }
  m.mrpe = root.times(kMm);
  m.gmpjpe = global.times(kMm);
  m.mpjpe = local.times(kMm);
  m.pa_mpjpe = procrustes.times(kMm);
  m.vel = vel.times(kMm);
  m.accel = accel.times(kMm);
}

/// Mean horizontal displacement of the points at or under `height` in both frames; 0 without any.
double slide(const std::vector<Vector3d>& now, const std::vector<Vector3d>& next, double height,
             const Scene& scene) {
  Mean displacement;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (scene.clearance(now[i]) <= height && scene.clearance(next[i]) <= height)
      displacement.add((next[i] - now[i]).head<2>().norm());
  return displacement.count == 0 ? 0.0 : displacement.times(1.0).value;
}

double mean_depth(const std::vector<Vector3d>& points, const Scene& scene) {
  Mean depth;
  for (const Vector3d& p : points)
    if (const double z = scene.clearance(p); z < 0.0) depth.add(-z);
  return depth.count == 0 ? 0.0 : depth.times(1.0).value;
}

double floating_height(const std::vector<Vector3d>& points, const Scene& scene) {
  const double z = lowest_height(points, scene);
  return z > kContactHeight ? z : 0.0;
}

void judge_physics(const MotionSamples& motion, Metrics& m) {
  const auto& surface = motion.surface;
  Mean fs, fs_0, gp, gp_max, floating, jitter, self_pen;
  for (int t = 0; t < surface.count(); ++t) {
    if (t + 1 < surface.count()) {
      fs.add(slide(surface[t], surface[t + 1], kContactHeight, motion.scene));
      fs_0.add(slide(surface[t], surface[t + 1], 0.0, motion.scene));
    }
    gp.add(mean_depth(surface[t], motion.scene));
    gp_max.add(std::max(0.0, -lowest_height(surface[t], motion.scene)));
    floating.add(floating_height(surface[t], motion.scene));
  }
  for (const double depth : motion.self_depth) self_pen.add(depth);
  for (int t = 0; t + 3 < motion.frames(); ++t)
    for (int j = 0; j < kBodies; ++j) jitter.add(difference(motion.joints, t, j, 3).norm());
  m.fs = fs.times(kMm);
  m.fs_0 = fs_0.times(kMm);
  m.gp = gp.times(kMm);
  m.gp_max = gp_max.times(kMm);
  m.floating = floating.times(kMm);
  m.self_pen = self_pen.times(kMm);
  m.jitter = jitter.times(pow(motion.fps, 3) / 10.0);  // jerk, m/s³, in the published unit of 10 m/s³
}

void judge_where_truth_stands(const MotionSamples& motion, const MotionSamples& truth, Metrics& m) {
  const auto &p = motion.surface, &g = truth.surface;
  Mean slide, floating;
  for (int t = 0; t < p.count(); ++t) {
    if (lowest_height(g[t], truth.scene) <= kContactHeight) floating.add(floating_height(p[t], motion.scene));
    for (std::size_t i = 0; i < kFootPoints && t + 1 < p.count(); ++i)
      if ((g[t + 1][i] - g[t][i]).norm() < kStaticMotion) slide.add((p[t + 1][i] - p[t][i]).norm());
  }
  m.fs_gt = slide.times(kMm);
  m.float_gt = floating.times(kMm);
}

double self_depth(const Character& character, const BodyPoses& poses) {
  Mean depth;
  for (const auto& [a, b] : character.self_pairs) {
    const SegmentPair near = closest_points(character, poses, a, b);
    const double gap = (near.a - near.b).norm() - character.capsule[a].radius - character.capsule[b].radius;
    if (gap < 0.0) depth.add(-gap);
  }
  return depth.count == 0 ? 0.0 : depth.times(1.0).value;
}

std::string rounded(double value, int digits) { return formatted("%.*f", digits, value); }

/// "300 frames at 30 fps"
std::string lasting(const MotionSamples& samples) {
  return formatted("%d frames at %.4g fps", samples.frames(), samples.fps);
}

}  // namespace

MotionSamples sample_motion(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                            const Scene& scene) {
  const std::vector<SurfacePoint> points = surface_points(character);
  MotionSamples samples;
  samples.fps = fps;
  samples.scene = scene;
  for (const BodyPoses& pose : poses) {
    samples.joints.push_back(pose.p_WB);
    samples.surface.push_back(surface_positions(points, pose));
    samples.self_depth.push_back(self_depth(character, pose));
  }
  return samples;
}

MotionSamples head_of(MotionSamples samples, int frames) {
  samples.joints.resize(frames);
  samples.surface.resize(frames);
  samples.self_depth.resize(static_cast<std::size_t>(frames));
  return samples;
}

const std::vector<MetricDefinition>& metric_definitions() {
  static const std::vector<MetricDefinition> definitions = {
      {"MRPE", "mm", "mean distance of the pelvis from the truth's, no alignment", &Metrics::mrpe},
      {"gMPJPE", "mm", "mean distance of the 22 joints from the truth's, no alignment", &Metrics::gmpjpe},
      {"MPJPE", "mm", "the same after moving both pelvises to the origin", &Metrics::mpjpe},
      {"PA-MPJPE", "mm", "the same after a similarity Procrustes per frame", &Metrics::pa_mpjpe},
      {"Vel", "mm/frame", "mean norm of the difference of joint velocities", &Metrics::vel},
      {"Accel", "mm/frame^2", "mean norm of the difference of joint accelerations", &Metrics::accel},
      {"FS", "mm/frame", "horizontal displacement of surface points at z <= 5 mm in both frames",
       &Metrics::fs},
      {"GP", "mm", "mean depth of the surface points below the floor, per frame", &Metrics::gp},
      {"Float", "mm", "height of the lowest surface point where it exceeds 5 mm, else 0", &Metrics::floating},
      {"FS_0", "mm/frame", "FS of the points at z <= 0", &Metrics::fs_0},
      {"FS_gt", "mm/frame", "displacement of foot points where the truth's move less than 10 mm/frame",
       &Metrics::fs_gt},
      {"GP_max", "mm", "depth of the lowest surface point, mean over frames", &Metrics::gp_max},
      {"Float_gt", "mm", "Float over the frames where the truth's lowest point is at z <= 5 mm",
       &Metrics::float_gt},
      {"Jitter", "10 m/s^3", "mean norm of the third difference of joint positions", &Metrics::jitter},
      {"SelfPen", "mm", "mean overlap of the capsule pairs that collide, per frame", &Metrics::self_pen},
      {"slip", "mm/frame", "speed of the soles' material point at the centre of pressure, by its load",
       &Metrics::slip},
      {"slip_share", "%", "share of the loaded feet and frames that slip by more than 3 mm/frame",
       &Metrics::slip_share},
      {"chatter", "% BW", "RMS of the floor's vertical force beyond its low-pass of 6 Hz", &Metrics::chatter},
  };
  return definitions;
}

Metrics evaluate_motion(const MotionSamples& motion, const MotionSamples* truth) {
  const auto complete = [](const MotionSamples& s) { return s.surface.size() == s.joints.size(); };
  if (!complete(motion) || (truth && !complete(*truth)))
    throw std::invalid_argument("evaluate_motion: joints and surface differ in length");
  Metrics m;
  judge_physics(motion, m);
  if (!truth) return m;
  if (truth->frames() != motion.frames() || truth->fps != motion.fps)
    throw std::invalid_argument("the truth has " + lasting(*truth) + ", the motion " + lasting(motion));
  for (const MotionSamples* s : {&motion, truth})
    for (const auto& points : s->surface)
      if (points.size() < kFootPoints) throw std::invalid_argument("evaluate_motion: a surface without feet");
  compare_with_truth(motion, *truth, m);
  judge_where_truth_stands(motion, *truth, m);
  return m;
}

Success success_of(const MotionSamples& simulated, const MotionSamples& reference) {
  Success s;
  const int frames = std::min(simulated.frames(), reference.frames());
  Mean mpjpe;
  int worst_frame = 0, worst_body = 0;
  for (int t = 0; t < frames; ++t)
    for (int j = 0; j < kBodies; ++j) {
      const Vector3d &p = simulated.joints[t][j], &g = reference.joints[t][j];
      if (const double distance = (p - g).norm(); distance > s.max_distance_m) {
        s.max_distance_m = distance;
        worst_frame = t, worst_body = j;
      }
      mpjpe.add(((p - simulated.joints[t][0]) - (g - reference.joints[t][0])).norm());
    }
  s.mpjpe_mm = mpjpe.times(kMm).value;
  if (simulated.frames() != reference.frames() || frames == 0)
    s.reason = "only " + std::to_string(frames) + " of " + std::to_string(reference.frames()) +
               " frames were simulated";
  else if (!(s.max_distance_m <= kMaxBodyDistance))
    s.reason = "the " + body_in_words(worst_body) + " was " + rounded(s.max_distance_m, 2) +
               " m from its reference at frame " + std::to_string(worst_frame) + " (limit 0.5 m)";
  else if (!(s.mpjpe_mm <= kMm * kMaxMeanDistance))
    s.reason = "the joints are " + rounded(s.mpjpe_mm, 1) +
               " mm from the reference's on average (MPJPE, limit 60 mm)";
  s.success = s.reason.empty();
  return s;
}

}  // namespace mimicx::motion
