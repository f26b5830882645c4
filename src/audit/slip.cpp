#include "audit/slip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "audit/audit_result.h"
#include "audit/friction_cones.h"
#include "audit/pose_needs.h"
#include "core/quantile.h"
#include "core/units.h"
#include "motion/metrics.h"
#include "motion/resample.h"
#include "motion/surface_points.h"

namespace mimicx::audit {
namespace {

constexpr double kSlipRate = 30.0;  ///< mm in 1/30 s: mm a frame of a motion of 30 fps
constexpr Array<int, 4> kFeet = {kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot};
/// Largest price of a moving point, (4): the forces stay far cheaper than any wrench left unexplained.
constexpr double kLargestPrice = 1e3;
/// Half of the time over which the floor of a frame is found, s: a step or a landing takes no longer.
constexpr double kFloorTime = 0.25;
/// Share of these frames whose lowest point may be lower.
constexpr double kLowerFrames = 0.25;
/// A point that moves faster does not stand, mm in 1/30 s: half of the speed of a walking pelvis.
constexpr double kStandingWay = 20.0;

/// Where a body of `now` has the world's point p, at the earlier pose.
Vector3d material_point(const BodyPoses& now, const BodyPoses& before, int body, const Vector3d& p) {
  return before.p_WB[body] + before.q_WB[body] * (now.q_WB[body].conjugate() * (p - now.p_WB[body]));
}

/// Horizontal way of a body's point since the frame before, mm in 1/30 s.
double way_of(const BodyPoses& now, const BodyPoses& before, int body, const Vector3d& p, double fps) {
  return kMm * fps / kSlipRate * (p - material_point(now, before, body, p)).head<2>().norm();
}

/// Point of the floor under a foot about which the wrench has no horizontal moment, m.
/// @param wrench  about `joint`, pressing
/// @param floor   its height, m
Vector3d pressure_point(const Vector6d& wrench, const Vector3d& joint, double floor) {
  const Vector3d n = wrench.head<3>(), f = wrench.tail<3>();
  const double z = joint.z() - floor;
  return {joint.x() + (-n.y() - z * f.x()) / f.z(), joint.y() + (n.x() - z * f.y()) / f.z(), floor};
}

/// Lowest points of the character's contact points, world, m.
List<Vector3d> contact_positions(const Character& c, const BodyPoses& poses) {
  List<Vector3d> points;
  for (const ContactPoint& point : c.contact_points) points.push_back(lowest_position(point, poses));
  return points;
}

/// The way of each point since the frame before, mm in 1/30 s; those of frame 0 are frame 1's.
PerFrame<List<double>> ways_of(const Character& c, const PerFrame<BodyPoses>& poses,
                               const PerFrame<List<Vector3d>>& points, double fps) {
  PerFrame<List<double>> ways(poses.count());
  for (int t = 1; t < poses.count(); ++t)
    for (int i = 0; i < points[t].count(); ++i)
      ways[t].push_back(way_of(poses[t], poses[t - 1], c.contact_points[i].body, points[t][i], fps));
  ways[0] = ways[1];
  return ways;
}

/// The height over the ground of the lowest point that stands, in the lower quartile of the frames within
/// kFloorTime of each frame, m; where none stands, of the lowest point.
PerFrame<double> floor_heights(const PerFrame<List<Vector3d>>& points, const PerFrame<List<double>>& ways,
                               double fps, const Scene& scene) {
  const int reach = static_cast<int>(std::lround(kFloorTime * fps)), frames = points.count();
  PerFrame<double> lowest, lowest_standing;
  for (int t = 0; t < frames; ++t) {
    List<Vector3d> standing;
    for (int i = 0; i < points[t].count(); ++i)
      if (ways[t][i] <= kStandingWay) standing.push_back(points[t][i]);
    lowest.push_back(motion::lowest_height(points[t], scene));
    lowest_standing.push_back(motion::lowest_height(standing, scene));
  }
  PerFrame<double> floor;
  for (int t = 0; t < frames; ++t) {
    std::vector<double> near, any;
    for (int k = std::max(0, t - reach); k < std::min(frames, t + reach + 1); ++k) {
      any.push_back(lowest[k]);
      if (std::isfinite(lowest_standing[k])) near.push_back(lowest_standing[k]);
    }
    floor.push_back(quantile(near.empty() ? any : near, kLowerFrames));
  }
  return floor;
}

/// `slip_of` on a floor at these heights over the ground of the scene; without heights, on that ground.
Slip slip_on_floor(const PerFrame<BodyPoses>& poses, const FloorWrenches& ground,
                   const PerFrame<double>& height, double weight, double fps, const Scene& scene) {
  if (poses.size() != ground.size())
    throw std::invalid_argument("slip_of: poses and forces differ in length");
  Slip slip;
  slip.speed.assign(poses.count(), std::numeric_limits<double>::quiet_NaN());
  double ways = 0.0, loads = 0.0;
  int visible = 0;
  for (int t = 1; t < poses.count(); ++t) {
    double frame_ways = 0.0, frame_loads = 0.0;
    for (const int foot : kFeet) {
      const double load = ground[t][foot][5];
      if (!(load >= kLeastFootLoad * weight)) continue;
      const Vector3d& joint = poses[t].p_WB[foot];
      const double floor = scene.height_under(joint) + (height.empty() ? 0.0 : height[t]);
      const double way =
          way_of(poses[t], poses[t - 1], foot, pressure_point(ground[t][foot], joint, floor), fps);
      frame_ways += load * way;
      frame_loads += load;
      ++slip.loaded;
      visible += way > kVisibleSlip;
    }
    if (frame_loads > 0.0) slip.speed[t] = frame_ways / frame_loads;
    ways += frame_ways;
    loads += frame_loads;
  }
  if (slip.loaded == 0) return slip;
  slip.mean = ways / loads;
  slip.share = 100.0 * visible / slip.loaded;
  return slip;
}

}  // namespace

Slip slip_of(const PerFrame<BodyPoses>& poses, const FloorWrenches& ground, double weight, double fps,
             const Scene& scene) {
  return slip_on_floor(poses, ground, {}, weight, fps, scene);
}

FloorForces best_floor_forces(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                              const Scene& scene, double gravity) {
  FloorForces out{FloorWrenches(poses.count()), {}};
  for (PerBody<Vector6d>& frame : out.ground) frame.fill(Vector6d::Zero());
  if (poses.count() < 3) return out;
  const PoseNeedsConfig config{.reach = kFloorReach, .gravity = gravity};
  const PerFrame<Vector6d> wanted = wanted_wrenches(character, poses, fps, config);
  PerFrame<List<Vector3d>> points;
  for (const BodyPoses& frame : poses) points.push_back(contact_positions(character, frame));
  const PerFrame<List<double>> ways = ways_of(character, poses, points, fps);
  out.height = floor_heights(points, ways, fps, scene);
  for (int t = 1; t < poses.count(); ++t) {
    List<Push> pushes;
    List<double> prices;
    for (int i = 0; i < points[t].count(); ++i) {
      const Vector3d& p = points[t][i];
      if (std::max(scene.clearance(p), scene.clearance(points[t - 1][i])) > out.height[t] + config.reach)
        continue;
      const double way = ways[t][i] / kVisibleSlip;
      pushes.push_back({character.contact_points[i].body, p, Vector3d::Zero()});
      prices.push_back(std::min(1.0 + way * way, kLargestPrice));
    }
    fit_cone_forces({.friction = config.friction}, center_of_mass(character, poses[t]), wanted[t], pushes,
                    prices);
    for (const Push& push : pushes) {
      out.ground[t][push.body].head<3>() += (push.p - poses[t].p_WB[push.body]).cross(push.force);
      out.ground[t][push.body].tail<3>() += push.force;
    }
  }
  return out;
}

Slip slip_of_poses(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                   const Scene& scene, double gravity) {
  const FloorForces forces = best_floor_forces(character, poses, fps, scene, gravity);
  return slip_on_floor(poses, forces.ground, forces.height, gravity * character.total_mass(), fps, scene);
}

Slip slip_of_clip(const motion::Clip& clip, double gravity) {
  const motion::Clip sampled = motion::resampled(clip, motion::kMetricRate);
  return slip_of_poses(motion::character_of(sampled), motion::poses_of(sampled), sampled.fps, sampled.scene,
                       gravity);
}

}  // namespace mimicx::audit
