#include "character/joint_range.h"

#include "character/bodies.h"
#include "core/elementary.h"

namespace mimicx {

RangeDistance range_distance(const JointParameters& joint, int body, const Quaterniond& q) {
  const Vector3d centre = is_hinge(body) ? Vector3d(joint.centre.x() * hinge_axis(body)) : joint.centre;
  Quaterniond x = exp_map(centre).conjugate() * q;
  if (x.w() < 0.0) x.coeffs() *= -1.0;
  const Eigen::Array3d chord = joint.half_range.unaryExpr([](double h) { return 2.0 * sin(0.5 * h); });
  const Eigen::Array3d u = 2.0 * x.vec().array(), s = u / chord, a = s / chord;  // a = g ∇g
  const double g = s.matrix().norm(), m = a.matrix().norm();
  // The excess (g − 1)/‖∇g‖ is (g² − g)/m. It has no direction at the centre.
  if (g < 1e-9) return {-chord.minCoeff(), Vector3d::Zero()};
  const double excess = (g * g - g) / m;
  const Eigen::Array3d by_g = a / g, by_m = a / (chord * chord * m);
  const Vector3d by_u = ((2.0 * g - 1.0) / m * by_g - excess / m * by_m).matrix();
  return {excess, x.w() * by_u + by_u.cross(x.vec())};  // δu = w δ + vec × δ
}

}  // namespace mimicx
