#include "physics/inverse_dynamics.h"

namespace mimicx::physics {
namespace {

Vector6d spatial(const Vector3d& angular, const Vector3d& linear) {
  Vector6d v;
  v << angular, linear;
  return v;
}
Vector3d angular(const Vector6d& v) { return v.head<3>(); }
Vector3d linear(const Vector6d& v) { return v.tail<3>(); }

/// v × m of two motions.                                                                  RBDA eq. 2.31
Vector6d cross_motion(const Vector6d& v, const Vector6d& m) {
  return spatial(angular(v).cross(angular(m)), angular(v).cross(linear(m)) + linear(v).cross(angular(m)));
}
/// v ×* f of a motion and a force.                                                        RBDA eq. 2.32
Vector6d cross_force(const Vector6d& v, const Vector6d& f) {
  return spatial(angular(v).cross(angular(f)) + linear(v).cross(linear(f)), angular(v).cross(linear(f)));
}

/// X of a motion from the parent's to the child's frame: the child's origin stands at r, q turns child →
/// parent.                                                                                RBDA table 2.2
Vector6d to_child(const Quaterniond& q, const Vector3d& r, const Vector6d& m) {
  return spatial(q.conjugate() * angular(m), q.conjugate() * (linear(m) - r.cross(angular(m))));
}
/// Xᵀ of a force from the child's to the parent's frame.
Vector6d to_parent(const Quaterniond& q, const Vector3d& r, const Vector6d& f) {
  const Vector3d force = q * linear(f);
  return spatial(q * angular(f) + r.cross(force), force);
}

/// I v of a body whose frame's origin is its joint centre.                                RBDA eq. 2.63
Vector6d times_inertia(const Character& c, int i, const Vector6d& v) {
  const Vector3d& d = c.com_B[i];
  const Vector3d force = c.mass[i] * (linear(v) + angular(v).cross(d));
  return spatial(c.inertia_B[i] * angular(v) + d.cross(force), force);
}

/// A wrench about the joint centre in world axes, in body axes.
Vector6d to_body(const Quaterniond& q_WB, const Vector6d& f_W) {
  return spatial(q_WB.conjugate() * angular(f_W), q_WB.conjugate() * linear(f_W));
}

}  // namespace

RequiredForces inverse_dynamics(const Character& c, double gravity, const MotionState& s,
                                const BodyWrenches& external) {
  PerBody<Quaterniond> q_WB;
  PerBody<Vector6d> v, a, f;
  // Root to tip. The pelvis is a joint of six degrees of freedom; gravity enters as a fictitious acceleration
  // of the world, and the spatial acceleration of the pelvis differs from the derivative of v_root by ω × v.
  q_WB[0] = s.q[0];
  const Quaterniond to_pelvis = s.q[0].conjugate();
  v[0] = spatial(s.omega[0], to_pelvis * s.v_root);
  a[0] = spatial(s.omega_d[0],
                 to_pelvis * (s.a_root + gravity * Vector3d::UnitZ()) - s.omega[0].cross(linear(v[0])));
  for (int i = 0; i < kBodies; ++i) {
    if (i > 0) {
      const int lambda = kParents[i];
      q_WB[i] = q_WB[lambda] * s.q[i];
      const Vector6d v_J = spatial(s.omega[i], Vector3d::Zero());
      v[i] = to_child(s.q[i], c.joint_offset[i], v[lambda]) + v_J;
      a[i] = to_child(s.q[i], c.joint_offset[i], a[lambda]) + spatial(s.omega_d[i], Vector3d::Zero()) +
             cross_motion(v[i], v_J);
    }
    f[i] = times_inertia(c, i, a[i]) + cross_force(v[i], times_inertia(c, i, v[i])) -
           to_body(q_WB[i], external[i]);
  }
  // Tip to root.
  RequiredForces forces;
  forces.joint[0].setZero();
  for (int i = kBodies - 1; i > 0; --i) {
    forces.joint[i] = angular(f[i]) + c.joint[i].armature * s.omega_d[i];  // Sᵀf
    if (is_hinge(i)) {
      const Vector3d axis = hinge_axis(i);
      forces.joint[i] = axis * axis.dot(forces.joint[i]);
    }
    f[kParents[i]] += to_parent(s.q[i], c.joint_offset[i], f[i]);
  }
  forces.root = spatial(q_WB[0] * angular(f[0]), q_WB[0] * linear(f[0]));
  return forces;
}

}  // namespace mimicx::physics
