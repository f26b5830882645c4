#include "motion/prepare/arm_separation.h"

#include <algorithm>

#include "motion/closest_points.h"
#include "motion/prepare/smooth_correction.h"

namespace mimicx::motion {
namespace {

constexpr double kSigmaOverlap = 0.003;                                          ///< m
constexpr CorrectionSigmas kTurnSigmas = {0.5, 0.02, 0.2, 1e-4, 40, 1.0 / 256};  ///< rad
constexpr double kOverlapGrows = 1.0 / 3.0;                                      ///< s
constexpr double kTouching = 1e-6;  ///< m: axes that cross have no direction apart
constexpr double kDeep = 0.5;       ///< of the sum of the radii: axes that are nearer are deep inside

/// Unknowns of a frame: shoulder (3) and elbow (1) of the left arm, then of the right one.
constexpr int kArmUnknowns = 8;
using Turns = Eigen::Matrix<double, kArmUnknowns, 1>;
struct Turn {
  int body, first, count;
};
constexpr Array<Turn, 4> kTurns = {
    {{{kLeftShoulder, 0, 3}, {kLeftElbow, 3, 1}, {kRightShoulder, 4, 3}, {kRightElbow, 7, 1}}}};

bool is_of_arm(int body) { return kLimbOf[body] >= 3; }
bool is_of_trunk(int body) { return body <= kSpine3 && kLimbOf[body] == 0; }
bool is_upper_arm(int body) { return body == kLeftShoulder || body == kRightShoulder; }
bool is_forearm(int body) { return body == kLeftElbow || body == kRightElbow; }

PerBody<Quaterniond> turned(const PerBody<Quaterniond>& q, const Turns& c) {
  PerBody<Quaterniond> out = q;
  for (const Turn& turn : kTurns) {
    const Vector3d by = turn.count == 3 ? Vector3d(c.segment<3>(turn.first))
                                        : Vector3d(c[turn.first] * hinge_axis(turn.body));
    out[turn.body] = q[turn.body] * exp_map(by);
  }
  return out;
}

/// Two capsules that overlap by more than is allowed.
struct Overlap {
  double excess;  ///< m
  Turns slope;    ///< of it, by the turns of the frame
};

/// d p / d c of a point that is fixed to a body, [3][8]. Turns are small: exp(c + δ) ≈ exp(c) exp(δ).
Eigen::Matrix<double, 3, kArmUnknowns> point_jacobian(const BodyPoses& poses, int body, const Vector3d& p) {
  Eigen::Matrix<double, 3, kArmUnknowns> J = Eigen::Matrix<double, 3, kArmUnknowns>::Zero();
  for (const Turn& turn : kTurns) {
    int above = body;
    while (above > turn.body) above = kParents[above];
    if (above != turn.body) continue;
    const Vector3d arm = p - poses.p_WB[turn.body];
    const Matrix3d R = poses.q_WB[turn.body].toRotationMatrix();
    if (turn.count == 1) J.col(turn.first) = (R * hinge_axis(turn.body)).cross(arm);
    for (int k = 0; turn.count == 3 && k < 3; ++k) J.col(turn.first + k) = R.col(k).cross(arm);
  }
  return J;
}

/// Unit vector in which a point of an arm leaves the trunk: away from the axis of the trunk's capsule, and
/// the deeper it is inside, the more to the arm's own side. The nearest side of an elbow that an estimator
/// left deep inside changes from frame to frame, from front to back.
Vector3d way_out_of_trunk(const BodyPoses& poses, int arm, int trunk, const Vector3d& apart, double radii) {
  const Vector3d own_side = poses.q_WB[trunk] * Vector3d(is_right(arm) ? -1.0 : 1.0, 0.0, 0.0);
  const double deep = std::max(0.0, 1.0 - apart.norm() / (kDeep * radii));
  return ((1.0 - deep) * apart.normalized() + deep * own_side).normalized();
}

/// Unit vector in which capsule a leaves capsule b.
Vector3d way_out(const Character& character, const BodyPoses& poses, int a, int b, const SegmentPair& near) {
  const double radii = character.capsule[a].radius + character.capsule[b].radius;
  const auto has_elbow_in = [&](int arm, int trunk, const Vector3d& p) {
    if (!is_of_trunk(trunk)) return false;
    if (is_forearm(arm))  // its half at the elbow
      return (p - poses.p_WB[arm]).norm() < 0.5 * character.joint_offset[kLeftWrist].norm();
    return is_upper_arm(arm);
  };
  if (has_elbow_in(a, b, near.a)) return way_out_of_trunk(poses, a, b, near.a - near.b, radii);
  if (has_elbow_in(b, a, near.b)) return -way_out_of_trunk(poses, b, a, near.b - near.a, radii);
  return (near.a - near.b).normalized();
}

List<Overlap> find_overlaps(const Character& character, const BodyPoses& poses, double allowed) {
  List<Overlap> found;
  for (const auto& [a, b] : character.self_pairs) {
    if (!is_of_arm(a) && !is_of_arm(b)) continue;
    const SegmentPair near = closest_points(character, poses, a, b);
    const Vector3d apart = near.a - near.b;
    const double excess = character.capsule[a].radius + character.capsule[b].radius - apart.norm() - allowed;
    if (excess <= 0.0 || apart.norm() < kTouching) continue;
    const Vector3d n = way_out(character, poses, a, b, near);
    found.push_back(
        {excess, -(point_jacobian(poses, a, near.a) - point_jacobian(poses, b, near.b)).transpose() * n});
  }
  return found;
}

BodyPoses poses_with(const Reference& reference, int t, const Turns& c) {
  const ReferenceFrame& frame = reference.frames[t];
  return forward_kinematics(reference.character, frame.p_root, turned(frame.q, c));
}

/// An overlap counts while it is there, so a whole step may jump far out of it, and the next one back into
/// it: the halved steps of smooth corrections end that.
PerFrame<Turns> solve_turns(const Reference& reference) {
  const int frames = reference.size();
  const auto overlaps = [&](const List<Turns>& c, CorrectionEquations<kArmUnknowns>& equations) {
    for (int t = 0; t < frames; ++t)
      for (const Overlap& overlap : find_overlaps(reference.character, poses_with(reference, t, c[t]),
                                                  allowed_overlap(t, reference.fps)))
        equations.add(t, overlap.slope, overlap.excess, kSigmaOverlap);
  };
  return smooth_correction<kArmUnknowns>({0, frames}, frames, reference.fps, kTurnSigmas, overlaps).c;
}

bool has_overlap(const Reference& reference) {
  for (int t = 0; t < reference.size(); ++t)
    if (!find_overlaps(reference.character, reference.poses[t], allowed_overlap(t, reference.fps)).empty())
      return true;
  return false;
}

}  // namespace

double allowed_overlap(int frame, double fps) {
  return kAllowedOverlap * std::min(1.0, frame / (kOverlapGrows * fps));
}

double separate_arms(Reference& reference) {
  if (!has_overlap(reference)) return 0.0;
  const PerFrame<Turns> c = solve_turns(reference);
  double moved = 0.0;
  for (int t = 0; t < reference.size(); ++t) {
    const BodyPoses now = poses_with(reference, t, c[t]);
    for (int body = 0; body < kBodies; ++body)
      moved = std::max(moved, (now.p_WB[body] - reference.poses[t].p_WB[body]).norm());
    reference.frames[t].q = turned(reference.frames[t].q, c[t]);
    reference.poses[t] = now;
  }
  return moved;
}

}  // namespace mimicx::motion
