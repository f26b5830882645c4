#include "audit/slip.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "audit/audit_result.h"
#include "audit/friction_cones.h"
#include "audit/pose_needs.h"
#include "core/units.h"
#include "motion/surface_points.h"

namespace mimicx::audit {
namespace {

constexpr double kSlipRate = 30.0;  ///< mm in 1/30 s: mm a frame of a motion of 30 fps
constexpr Array<int, 4> kFeet = {kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot};
/// Largest price of a moving point, (4): the forces stay far cheaper than any wrench left unexplained.
constexpr double kLargestPrice = 1e3;
/// Time around a frame in which its lowest point reaches the floor, s: a step or a landing takes no longer.
constexpr double kFloorTime = 0.25;

/// Where a body of `now` has the world's point p, at the earlier pose.
Vector3d material_point(const BodyPoses& now, const BodyPoses& before, int body, const Vector3d& p) {
  return before.p_WB[body] + before.q_WB[body] * (now.q_WB[body].conjugate() * (p - now.p_WB[body]));
}

/// Horizontal way of a body's point since the frame before, mm in 1/30 s.
double way_of(const BodyPoses& now, const BodyPoses& before, int body, const Vector3d& p, double fps) {
  return kMm * fps / kSlipRate * (p - material_point(now, before, body, p)).head<2>().norm();
}

/// Point of the ground under a foot about which the wrench has no horizontal moment, m.
/// @param wrench  about `joint`, pressing
Vector3d pressure_point(const Vector6d& wrench, const Vector3d& joint, const Scene& scene) {
  const Vector3d n = wrench.head<3>(), f = wrench.tail<3>();
  const double ground = scene.height_under(joint), z = joint.z() - ground;
  return {joint.x() + (-n.y() - z * f.x()) / f.z(), joint.y() + (n.x() - z * f.y()) / f.z(), ground};
}

/// Lowest points of the character's contact points, world, m.
List<Vector3d> contact_positions(const Character& c, const BodyPoses& poses) {
  List<Vector3d> points;
  for (const ContactPoint& point : c.contact_points) points.push_back(lowest_position(point, poses));
  return points;
}

/// The height of the lowest point over the ground within kFloorTime of each frame, m.
PerFrame<double> floor_heights(const PerFrame<List<Vector3d>>& points, double fps, const Scene& scene) {
  PerFrame<double> lowest, floor;
  for (const List<Vector3d>& frame : points) lowest.push_back(motion::lowest_height(frame, scene));
  const int reach = static_cast<int>(std::lround(kFloorTime * fps));
  for (int t = 0; t < lowest.count(); ++t)
    floor.push_back(*std::min_element(lowest.begin() + std::max(0, t - reach),
                                      lowest.begin() + std::min(lowest.count(), t + reach + 1)));
  return floor;
}

}  // namespace

Slip slip_of(const PerFrame<BodyPoses>& poses, const FloorWrenches& ground, double weight, double fps,
             const Scene& scene) {
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
      const double way = way_of(poses[t], poses[t - 1], foot,
                                pressure_point(ground[t][foot], poses[t].p_WB[foot], scene), fps);
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

FloorWrenches best_floor_forces(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                                const Scene& scene) {
  FloorWrenches ground(poses.count());
  for (PerBody<Vector6d>& frame : ground) frame.fill(Vector6d::Zero());
  if (poses.count() < 3) return ground;
  const PoseNeedsConfig config{.reach = kFloorReach};
  const PerFrame<Vector6d> wanted = wanted_wrenches(character, poses, fps, config);
  PerFrame<List<Vector3d>> points;
  for (const BodyPoses& frame : poses) points.push_back(contact_positions(character, frame));
  const PerFrame<double> floor = floor_heights(points, fps, scene);
  for (int t = 1; t < poses.count(); ++t) {
    List<Push> pushes;
    List<double> prices;
    for (int i = 0; i < points[t].count(); ++i) {
      const Vector3d& p = points[t][i];
      if (std::max(scene.clearance(p), scene.clearance(points[t - 1][i])) > floor[t] + config.reach) continue;
      const int body = character.contact_points[i].body;
      const double way = way_of(poses[t], poses[t - 1], body, p, fps) / kVisibleSlip;
      pushes.push_back({body, p, Vector3d::Zero()});
      prices.push_back(std::min(1.0 + way * way, kLargestPrice));
    }
    fit_cone_forces({.friction = config.friction}, center_of_mass(character, poses[t]), wanted[t], pushes,
                    prices);
    for (const Push& push : pushes) {
      ground[t][push.body].head<3>() += (push.p - poses[t].p_WB[push.body]).cross(push.force);
      ground[t][push.body].tail<3>() += push.force;
    }
  }
  return ground;
}

}  // namespace mimicx::audit
