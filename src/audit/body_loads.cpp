#include "audit/body_loads.h"

#include "core/units.h"

namespace mimicx::audit {

PerBody<BodyLoad> body_loads(const Character& c, const PerFrame<BodyPoses>& poses, int t, double fps,
                             double gravity) {
  PerBody<BodyLoad> loads;
  for (int b = 0; b < kBodies; ++b) {
    const auto center = [&](int i) { return Vector3d(poses[i].p_WB[b] + poses[i].q_WB[b] * c.com_B[b]); };
    const auto spin = [&](int i, int j) {  // angular momentum between two frames
      const Quaterniond &q_i = poses[i].q_WB[b], &q_j = poses[j].q_WB[b];
      const Vector3d turn_B = log_map(q_i.conjugate() * q_j);
      return Vector3d(q_i * (exp_map(0.5 * turn_B) * (c.inertia_B[b] * (fps * turn_B))));
    };
    const Vector3d acceleration = fps * fps * (center(t + 1) - 2.0 * center(t) + center(t - 1));
    loads[b].p_com = center(t);
    loads[b].force = c.mass[b] * (acceleration + gravity * Vector3d::UnitZ());
    loads[b].moment = fps * (spin(t, t + 1) - spin(t - 1, t));
  }
  return loads;
}

Vector6d wrench_of(const PerBody<BodyLoad>& loads, const Vector3d& center) {
  Vector6d wrench = Vector6d::Zero();
  for (const BodyLoad& load : loads) {
    wrench.head<3>() += load.moment + (load.p_com - center).cross(load.force);
    wrench.tail<3>() += load.force;
  }
  return wrench;
}

PerBody<Vector3d> joint_moments(const PerBody<BodyLoad>& loads, const BodyPoses& poses) {
  PerBody<Vector3d> force, moment;
  for (int b = 0; b < kBodies; ++b) {
    force[b] = loads[b].force;
    moment[b] = loads[b].moment + (loads[b].p_com - poses.p_WB[b]).cross(loads[b].force);
  }
  for (int b = kBodies - 1; b > 0; --b) {
    const int parent = kParents[b];
    force[parent] += force[b];
    moment[parent] += moment[b] + (poses.p_WB[b] - poses.p_WB[parent]).cross(force[b]);
  }
  return moment;
}

void subtract_push(const Push& push, const BodyPoses& poses, PerBody<Vector3d>& moments) {
  for (int b = push.body;; b = kParents[b]) {
    moments[b] -= (push.p - poses.p_WB[b]).cross(push.force);
    if (b == kPelvis) return;
  }
}

PerBody<double> torque_shares(const Character& c, const PerBody<Vector3d>& torque) {
  PerBody<double> shares{};
  for (int b = 1; b < kBodies; ++b)
    shares[b] =
        (is_hinge(b) ? std::abs(torque[b].dot(hinge_axis(b))) : torque[b].norm()) / c.joint[b].torque_limit;
  return shares;
}

}  // namespace mimicx::audit
