#include "motion/prepare/hinge.h"

#include <algorithm>

#include "core/elementary.h"
#include "core/units.h"

namespace mimicx::motion {
namespace {

constexpr double kAlreadyHinge = 1e-7;            ///< rad off the axis; joints below it do not change
constexpr double kStraightWeight = 0.06;          ///< pull to SMPL's own swivel, in units of sin²α
constexpr double kStraightFrom = 15.0 * kDegree;  ///< a limb bent by less is straight …
constexpr double kStraightUntil = 30.0 * kDegree;  ///< … and one bent by more is not: its conversion is exact

struct Limb {
  int upper, hinge, end;
};
constexpr std::array<Limb, 4> kHingedLimbs = {{{kLeftHip, kLeftKnee, kLeftAnkle},
                                               {kRightHip, kRightKnee, kRightAnkle},
                                               {kLeftShoulder, kLeftElbow, kLeftWrist},
                                               {kRightShoulder, kRightElbow, kRightWrist}}};

/// Angle of the rotation about `axis` closest to q, in (-π, π].
double hinge_angle(const Quaterniond& q, const Vector3d& axis) {
  return log_map(twist_about(q, axis)).dot(axis);
}

/// Angle in (-π, π] about the unit axis that turns `from` to `to`, both seen along the axis.
double angle_about(const Vector3d& axis, const Vector3d& from, const Vector3d& to) {
  const Vector3d a = from - axis.dot(from) * axis, b = to - axis.dot(to) * axis;
  return atan2(axis.dot(a.cross(b)), a.dot(b));
}

/// The flexing angle at which the scalar product of the bones is `dot`.  docs/method.md, "Hinges", (1)
/// @param a, b  upper bone in its own frame; lower bone in the frame of the hinge's child, m
double solve_hinge(const Vector3d& a, const Vector3d& b, const Vector3d& axis, double dot) {
  const double axial = axis.dot(a) * axis.dot(b);
  const double along = a.dot(b) - axial, across = a.dot(axis.cross(b));
  const double cosine = std::clamp((dot - axial) / hypot(along, across), -1.0, 1.0);
  return atan2(across, along) + acos(cosine);
}

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

/// The swivel between the exact one (the limb is bent) and 0 (it is straight).  docs/method.md, "Hinges", (3)
/// @param bend, hinged_bend  angle between the bones in the SMPL motion and at the hinge's angle, rad
double blended_swivel(double exact, double bend, double hinged_bend) {
  const double straight = 1.0 - smooth_step((bend - kStraightFrom) / (kStraightUntil - kStraightFrom));
  const double size = sin(bend) * sin(hinged_bend);
  const auto [sine, cosine] = sin_cos(exact);
  const double flexing = cosine < 0.0 ? (1.0 - straight) * cosine : cosine;
  return atan2(size * sine, size * flexing + straight * kStraightWeight);
}

/// One limb of one frame.  docs/method.md, "Hinges", (2)
/// @param R  world rotations of the SMPL motion
/// @param q  joint rotations to change
void convert_limb(const Character& character, const Limb& limb, const PerBody<Quaterniond>& R,
                  PerBody<Quaterniond>& q) {
  const int A = limb.upper, B = limb.hinge, C = limb.end, P = kParents[A];
  const Vector3d axis = hinge_axis(B);
  const Quaterniond twist = twist_about(q[B], axis);
  if (angle_between(q[B], twist) < kAlreadyHinge) {
    q[B] = exp_map(hinge_angle(twist, axis) * axis);
    return;
  }
  const Vector3d &a = character.joint_offset[B], &b = character.joint_offset[C];
  const Vector3d u = R[A] * a, v = R[B] * b, line = (u + v).normalized();
  const Quaterniond bend = exp_map(solve_hinge(a, b, axis, u.dot(v)) * axis);
  const Vector3d chain = a + bend * b;  // from A's joint to C's, in A's frame
  const Quaterniond aimed = rotation_between(R[A] * chain, line) * R[A];
  const double exact = angle_about(line, aimed * a, u);
  const double swivel = blended_swivel(exact, angle_between(u, v), angle_between(a, bend * b));
  const Quaterniond upper = (rotation_about(line, swivel) * aimed).normalized();
  q[A] = R[P].conjugate() * upper;
  q[B] = bend;
  q[C] = (upper * bend).conjugate() * R[C];
}

}  // namespace

PerFrame<PerBody<Quaterniond>> to_hinges(const Character& character,
                                         const PerFrame<PerBody<Quaterniond>>& smpl) {
  PerFrame<PerBody<Quaterniond>> out = smpl;
  for (PerBody<Quaterniond>& q : out) {
    PerBody<Quaterniond> R = q;
    for (int i = 1; i < kBodies; ++i) R[i] = R[kParents[i]] * q[i];
    for (const Limb& limb : kHingedLimbs) convert_limb(character, limb, R, q);
  }
  return out;
}

}  // namespace mimicx::motion
