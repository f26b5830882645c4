#include "control/sole_slip.h"

namespace mimicx::control {
namespace {

/// A point that is fixed to a body.
struct MovingPoint {
  int body;
  Vector3d p, v;  ///< world, m, m/s
};

Vector3d spin(const Data<double>& d, int body) { return body < 0 ? Vector3d::Zero() : to_eigen(d.w[body]); }

/// Derivatives of a point's velocity when the joint of `body` turns about the world axis a: the part of the
/// velocity that is relative to the parent turns with it, and the parent's rotation moves the point
/// elsewhere.
Vector3d by_angle(const Data<double>& d, int body, const MovingPoint& point, const Vector3d& a) {
  const Vector3d w = spin(d, kParents[body]), arm = point.p - to_eigen(d.p_WB[body]);
  const Vector3d relative = point.v - to_eigen(d.v[body]) - w.cross(arm);
  return a.cross(relative) + w.cross(a.cross(arm));
}

}  // namespace

template <class T>
Array<Vec3<T>, kFootPoints> sole_velocities(const System& system, const Data<T>& d) {
  Array<Vec3<T>, kFootPoints> v;
  for (int k = 0; k < kFootPoints; ++k) {
    const SolePoint& point = system.sole[k];
    const Vec3<T> p_B{T(point.p_B.x()), T(point.p_B.y()), T(point.p_B.z())};
    v[k] = d.v[point.body] + cross(d.w[point.body], d.R_WB[point.body] * p_B);
  }
  return v;
}

SoleSlipJacobian sole_slip_jacobian(const System& system, const Data<double>& d) {
  const Array<Vec3<double>, kFootPoints> velocities = sole_velocities(system, d);
  SoleSlipJacobian J = SoleSlipJacobian::Zero();
  for (int k = 0; k < kFootPoints; ++k) {
    const SolePoint& fixed = system.sole[k];
    const MovingPoint point{fixed.body,
                            to_eigen(d.p_WB[fixed.body]) + to_eigen(d.q_WB[fixed.body]) * fixed.p_B,
                            to_eigen(velocities[k])};
    auto rows = J.middleRows<2>(2 * k);
    rows.block<2, 2>(0, kRootVelocity).setIdentity();
    for (int body = point.body; body >= 0; body = kParents[body]) {
      const Matrix3d R = to_eigen(d.q_WB[body]).toRotationMatrix();
      const Vector3d arm = point.p - to_eigen(d.p_WB[body]);
      const int first = body == 0 ? kRootRotation : kJointRotation + first_dof(body);
      for (int n = 0; n < (is_hinge(body) ? 1 : 3); ++n) {
        const Vector3d a = is_hinge(body) ? Vector3d(R * hinge_axis(body)) : Vector3d(R.col(n));
        rows.col(first + n) = by_angle(d, body, point, a).head<2>();
        rows.col(kPositions + first + n) = a.cross(arm).head<2>();
      }
    }
  }
  return J;
}

template Array<Vec3<double>, kFootPoints> sole_velocities(const System&, const Data<double>&);
template Array<Vec3<P>, kFootPoints> sole_velocities(const System&, const Data<P>&);

}  // namespace mimicx::control
