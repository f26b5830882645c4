#include "motion/closest_points.h"

#include <algorithm>

namespace mimicx::motion {

SegmentPair closest_points(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0, const Vector3d& b1) {
  // Ericson, "Real-Time Collision Detection" (2005), section 5.1.9: clamp the parameters of the lines.
  const Vector3d d1 = a1 - a0, d2 = b1 - b0, r = a0 - b0;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), b = d1.dot(d2), c = d1.dot(r), f = d2.dot(r);
  const auto clamped = [](double numerator, double denominator) {
    return denominator > 0.0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
  };
  double s = clamped(b * f - c * e, a * e - b * b);
  const double t = clamped(b * s + f, e);
  s = clamped(b * t - c, a);
  return {a0 + s * d1, b0 + t * d2};
}

SegmentPair closest_points(const Character& character, const BodyPoses& poses, int a, int b) {
  const auto end = [&](int body, const Vector3d& p_B) -> Vector3d {
    return poses.p_WB[body] + poses.q_WB[body] * p_B;
  };
  const Capsule &A = character.capsule[a], &B = character.capsule[b];
  return closest_points(end(a, A.a_B), end(a, A.b_B), end(b, B.a_B), end(b, B.b_B));
}

}  // namespace mimicx::motion
