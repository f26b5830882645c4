#include "audit/pose_needs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "audit/body_loads.h"
#include "audit/friction_cones.h"
#include "core/units.h"
#include "motion/surface_points.h"

namespace mimicx::audit {
namespace {

/// The need of one frame before smoothing.
struct RawNeed {
  Vector6d wrench = Vector6d::Zero();  ///< moment about the centre of mass, N·m; force, N
  PerBody<Vector3d> moment;            ///< of the joints, child's frame, N·m, without the floor
};

/// A frame's contact points and its centre of mass.
struct FramePoints {
  List<Vector3d> p;     ///< lowest points of the character's contact points, m
  List<double> height;  ///< theirs over the ground, m
  double in_box = 0.0;  ///< as in `PoseNeed`
  Vector3d center;
};

RawNeed raw_need(const Character& c, const PerFrame<BodyPoses>& poses, int t, double fps, double gravity) {
  const PerBody<BodyLoad> loads = body_loads(c, poses, t, fps, gravity);
  RawNeed need;
  need.wrench = wrench_of(loads, center_of_mass(c, poses[t]));
  need.moment = joint_moments(loads, poses[t]);
  for (int b = 0; b < kBodies; ++b) need.moment[b] = poses[t].q_WB[b].conjugate() * need.moment[b];
  return need;
}

/// Of the frames 1 … n − 2; the first and the last have none.
PerFrame<RawNeed> raw_needs(const Character& c, const PerFrame<BodyPoses>& poses, double fps,
                            double gravity) {
  PerFrame<RawNeed> raw(poses.count());
  for (int t = 1; t + 1 < poses.count(); ++t) raw[t] = raw_need(c, poses, t, fps, gravity);
  return raw;
}

/// The m of the header.
int half_window(double fps, const PoseNeedsConfig& config) {
  return std::max(1, static_cast<int>(std::lround(config.window * fps)));
}

FramePoints frame_points(const Character& c, const BodyPoses& poses, const Scene& scene) {
  FramePoints points;
  points.center = center_of_mass(c, poses);
  for (const ContactPoint& point : c.contact_points) {
    points.p.push_back(lowest_position(point, poses));
    points.height.push_back(scene.clearance(points.p.back()));
    const Vector3d centre = points.p.back() + point.radius * Vector3d::UnitZ();
    points.in_box = std::max(points.in_box, scene.way_out(centre, point.radius).depth);
  }
  return points;
}

/// Weighted mean of the raw needs around a frame. @param t, m  as in the header; raw[t] exists
RawNeed smoothed(const PerFrame<RawNeed>& raw, int t, int m) {
  RawNeed mean;
  mean.moment.fill(Vector3d::Zero());
  double sum = 0.0;
  for (int j = 1 - m; j < m; ++j) {
    if (t + j < 1 || t + j > raw.count() - 2) continue;
    const double weight = static_cast<double>(m * m - j * j) * ((m + 1) * (m + 1) - j * j);
    sum += weight;
    mean.wrench += weight * raw[t + j].wrench;
    for (int b = 0; b < kBodies; ++b) mean.moment[b] += weight * raw[t + j].moment[b];
  }
  mean.wrench /= sum;
  for (Vector3d& moment : mean.moment) moment /= sum;
  return mean;
}

/// The frame nearest to t, at most m away, at which contact point i touches; −1: none. Of two the earlier.
int touching_frame(const PerFrame<FramePoints>& points, int i, int t, int m, double reach) {
  for (int away = 0; away <= m; ++away)
    for (const int frame : {t - away, t + away})
      if (frame >= 0 && frame < points.count() && points[frame].height[i] <= reach) return frame;
  return -1;
}

/// The points that may push at frame t, with their positions.
List<Push> possible_pushes(const Character& c, const PerFrame<FramePoints>& points, int t, int m,
                           double reach) {
  List<Push> pushes;
  for (int i = 0; i < c.contact_points.count(); ++i) {
    const int frame = touching_frame(points, i, t, m, reach);
    if (frame < 0) continue;
    const Vector3d p = points[frame].p[i] - points[frame].center + points[t].center;
    pushes.push_back({c.contact_points[i].body, p, Vector3d::Zero()});
  }
  return pushes;
}

PoseNeed need_at(const Character& c, const BodyPoses& poses, const RawNeed& wanted, double friction,
                 const Vector3d& center, List<Push> pushes) {
  const Vector6d left = fit_cone_forces({.friction = friction}, center, wanted.wrench, pushes);
  PoseNeed need;
  need.moment = left.head<3>();
  need.force = left.tail<3>();
  need.points = pushes.count();
  PerBody<Vector3d> from_floor;
  from_floor.fill(Vector3d::Zero());
  for (const Push& push : pushes) {
    need.floor += push.force.z();
    subtract_push(push, poses, from_floor);
  }
  PerBody<Vector3d> moment = wanted.moment;
  for (int b = 0; b < kBodies; ++b) moment[b] += poses.q_WB[b].conjugate() * from_floor[b];
  need.torque = torque_shares(c, moment);
  return need;
}

void require_usable(const PerFrame<BodyPoses>& poses, double fps, const PoseNeedsConfig& config) {
  if (poses.count() < 3) throw std::invalid_argument("needs_of_poses: at least 3 frames are needed");
  if (!(fps > 0.0 && config.window >= 0.0 && config.window * fps < 1e4))
    throw std::invalid_argument("needs_of_poses: frame rate and window must be positive and finite");
  if (!(config.friction >= 0.0)) throw std::invalid_argument("needs_of_poses: friction below 0");
}

}  // namespace

PerFrame<Vector6d> wanted_wrenches(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                                   const PoseNeedsConfig& config) {
  require_usable(poses, fps, config);
  const int n = poses.count(), m = half_window(fps, config);
  const PerFrame<RawNeed> raw = raw_needs(character, poses, fps, config.gravity);
  PerFrame<Vector6d> wanted(n);
  for (int t = 1; t + 1 < n; ++t) wanted[t] = smoothed(raw, t, m).wrench;
  wanted[0] = wanted[1];
  wanted[n - 1] = wanted[n - 2];
  return wanted;
}

PoseNeeds needs_of_poses(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                         const PoseNeedsConfig& config, const Scene& scene) {
  require_usable(poses, fps, config);
  const int n = poses.count(), m = half_window(fps, config);
  PoseNeeds needs;
  needs.mass = character.total_mass();
  needs.weight = config.gravity * needs.mass;
  needs.fps = fps;
  needs.frames.resize(n);
  const PerFrame<RawNeed> raw = raw_needs(character, poses, fps, config.gravity);
  PerFrame<FramePoints> points;
  for (const BodyPoses& frame : poses) points.push_back(frame_points(character, frame, scene));
  for (int t = 1; t + 1 < n; ++t)
    needs.frames[t] = need_at(character, poses[t], smoothed(raw, t, m), config.friction, points[t].center,
                              possible_pushes(character, points, t, m, config.reach));
  needs.frames[0] = needs.frames[1];
  needs.frames[n - 1] = needs.frames[n - 2];
  for (int t = 0; t < n; ++t) {
    needs.frames[t].lowest = motion::lowest_height(points[t].p, scene);
    needs.frames[t].in_box = points[t].in_box;
  }
  return needs;
}

}  // namespace mimicx::audit
