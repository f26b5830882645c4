#include "core/so3.h"

#include <cmath>

#include "core/elementary.h"

namespace mimicx {

Quaterniond exp_map(const Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const auto [sine, cosine] = sin_cos(0.5 * angle);
  // sin(x/2)/x by its series near 0, where the quotient loses digits.
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : sine / angle;
  Quaterniond q;
  q.w() = cosine;
  q.vec() = scale * rotation_vector;
  return q.normalized();
}

Vector3d log_map(const Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  const double angle = 2.0 * atan2(sine, sign * q.w());
  const double scale = sine < 1e-8 ? 2.0 : angle / sine;
  return sign * scale * q.vec();
}

Vector6d rotation_6d(const Quaterniond& q) {
  const Matrix3d R = q.toRotationMatrix();
  Vector6d out;
  out << R.col(0), R.col(1);
  return out;
}

double heading_angle(const Quaterniond& q_WB) {
  Vector3d forward = q_WB * Vector3d::UnitZ();
  if (hypot(forward.x(), forward.y()) < 1e-3) forward = q_WB * Vector3d::UnitY();
  return atan2(forward.y(), forward.x());
}

Quaterniond rotation_z(double angle) {
  const auto [sine, cosine] = sin_cos(0.5 * angle);
  return Quaterniond(cosine, 0.0, 0.0, sine);
}

Quaterniond rotation_about(const Vector3d& axis, double angle) {
  const auto [sine, cosine] = sin_cos(0.5 * angle);
  Quaterniond q;
  q.w() = cosine;
  q.vec() = sine * axis;
  return q;
}

// Source: K. Shoemake, "Animating rotation with quaternion curves" (1985).
Quaterniond slerp(const Quaterniond& a, double share, const Quaterniond& b) {
  const double cosine = a.dot(b), sign = cosine < 0.0 ? -1.0 : 1.0;
  double of_a = 1.0 - share, of_b = share;
  if (std::abs(cosine) < 1.0 - 1e-15) {
    const double angle = acos(std::abs(cosine)), sine = sin(angle);
    of_a = sin(of_a * angle) / sine;
    of_b = sin(of_b * angle) / sine;
  }
  return Quaterniond(of_a * a.coeffs() + sign * of_b * b.coeffs());
}

double angle_between(const Quaterniond& a, const Quaterniond& b) {
  const Quaterniond turn = a * b.conjugate();
  return 2.0 * atan2(turn.vec().norm(), std::abs(turn.w()));
}

double angle_between(const Vector3d& a, const Vector3d& b) { return atan2(a.cross(b).norm(), a.dot(b)); }

Quaterniond rotation_between(const Vector3d& from, const Vector3d& to) {
  const Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  constexpr double kOpposite = -1.0 + 1e-12;  // Eigen's FromTwoVectors solves for the axis there, by an SVD
  Quaterniond q;
  if (cosine < kOpposite) {
    q.w() = 0.0;
    q.vec() = a.unitOrthogonal();
    return q;
  }
  const double s = std::sqrt((1.0 + cosine) * 2.0);
  q.vec() = a.cross(b) * (1.0 / s);
  q.w() = s * 0.5;
  return q;
}

Quaterniond swung(const Quaterniond& q, const Vector3d& from, const Vector3d& to) {
  return (rotation_between(q * from, to) * q).normalized();
}

Quaterniond twist_about(const Quaterniond& q, const Vector3d& axis) {
  const double along = q.vec().dot(axis);
  const double norm = hypot(q.w(), along);
  if (norm < 1e-12) return Quaterniond::Identity();  // half turn across the axis: any twist will do
  Quaterniond twist;
  twist.w() = q.w() / norm;
  twist.vec() = along / norm * axis;
  return twist;
}

}  // namespace mimicx
