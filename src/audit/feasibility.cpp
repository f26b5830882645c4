#include "audit/feasibility.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "audit/body_loads.h"
#include "audit/friction_cones.h"
#include "core/units.h"

namespace mimicx::audit {
namespace {

/// Four edges; the weight of the forces leaves less than 1e-4 of the body's weight.
constexpr Floor kFloor{1.0, 4, 1e-4};

List<Push> touching_points(const Character& c, const BodyPoses& poses, const Touching& touching,
                           const Scene& scene) {
  const std::size_t count = touching.whole_body ? c.contact_points.size() : kFootPoints;
  List<Push> touches;
  for (std::size_t i = 0; i < count; ++i) {
    const ContactPoint& point = c.contact_points[i];
    const Vector3d p = lowest_position(point, poses);
    const double z = scene.clearance(p);
    if (z <= touching.height && z >= -touching.depth) touches.push_back({point.body, p, Vector3d::Zero()});
  }
  return touches;
}

FrameDemand demand_of(const Character& c, const PerFrame<BodyPoses>& poses, int t, double fps,
                      const Touching& touching, const Scene& scene) {
  const PerBody<BodyLoad> loads = body_loads(c, poses, t, fps);
  const Vector3d center = center_of_mass(c, poses[t]);
  List<Push> touches = touching_points(c, poses[t], touching, scene);
  const Vector6d left = fit_cone_forces(kFloor, center, wrench_of(loads, center), touches);
  FrameDemand demand;
  demand.residual_moment = left.head<3>();
  demand.residual_force = left.tail<3>();
  demand.torque = joint_moments(loads, poses[t]);
  for (const Push& touch : touches) subtract_push(touch, poses[t], demand.torque);
  demand.torque[kPelvis].setZero();  // no joint: what is left there is the residual
  return demand;
}

}  // namespace

std::vector<FrameDemand> motion_demands(const motion::Clip& clip, const Touching& touching) {
  if (clip.frames() < 3) throw std::invalid_argument("motion_demands: at least 3 frames are needed");
  const Character character = motion::character_of(clip);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  std::vector<FrameDemand> demands;
  for (int t = 1; t + 1 < poses.count(); ++t)
    demands.push_back(demand_of(character, poses, t, clip.fps, touching, clip.scene));
  return demands;
}

PerBody<double> torque_ratios(const Character& character, const BodyPoses& poses, const FrameDemand& demand) {
  PerBody<double> ratios{};
  for (int b = 1; b < kBodies; ++b) {
    const double torque =
        is_hinge(b) ? std::abs(demand.torque[b].dot(poses.q_WB[b] * hinge_axis(b))) : demand.torque[b].norm();
    ratios[b] = torque / character.joint[b].torque_limit;
  }
  return ratios;
}

Feasibility feasibility(const motion::Clip& clip) {
  const std::vector<FrameDemand> demands = motion_demands(clip);
  const Character character = motion::character_of(clip);
  const std::vector<BodyPoses> poses = motion::poses_of(clip);
  const double weight = kGravity * character.total_mass(), n = static_cast<double>(demands.size());
  Feasibility summary;
  for (std::size_t i = 0; i < demands.size(); ++i) {
    const double force = demands[i].residual_force.norm() / weight,
                 moment = demands[i].residual_moment.norm() / weight;
    summary.mean_force += force / n;
    summary.mean_moment += moment / n;
    summary.max_force = std::max(summary.max_force, force);
    summary.max_moment = std::max(summary.max_moment, moment);
    const PerBody<double> ratios = torque_ratios(character, poses[i + 1], demands[i]);
    const auto worst = std::max_element(ratios.begin(), ratios.end());
    if (*worst > 1.0) ++summary.frames_over_limit;
    if (*worst <= summary.worst_torque) continue;
    summary.worst_torque = *worst;
    summary.worst_joint = static_cast<int>(worst - ratios.begin());
  }
  return summary;
}

}  // namespace mimicx::audit
