#include "import/retarget/retarget_solve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/elementary.h"

namespace mimicx::import {
namespace {

using JointRotations = PerBody<Quaterniond>;

/// Joint at the end of a body's bone, or -1 for bodies whose direction is free.
int bone_end(int body) {
  const auto found =
      std::find_if(kBones.begin(), kBones.end(), [&](const Bone& b) { return b.body == body; });
  return found == kBones.end() ? -1 : found->end;
}

/// Rest direction of a body's bone in its own frame.
Vector3d bone_direction(const Character& character, int body) {
  return character.joint_offset[bone_end(body)].normalized();
}

/// The rotation that takes a to u exactly, and b into the half plane of u and v.
Quaterniond aligned(const Vector3d& a, const Vector3d& b, const Vector3d& u, const Vector3d& v) {
  const auto frame = [](const Vector3d& first, const Vector3d& second) {
    Matrix3d m;
    m.col(0) = first.normalized();
    m.col(2) = first.cross(second).normalized();
    m.col(1) = m.col(2).cross(m.col(0));
    return m;
  };
  return Quaterniond(frame(u, v) * frame(a, b).transpose()).normalized();
}

/// Points of the trunk at rest, in the frame of the pelvis resp. the chest.
struct Trunk {
  Vector3d hips;       ///< middle of the hips from the pelvis
  Vector3d shoulders;  ///< middle of the shoulders from the chest
  Vector3d direction;  ///< from hips to shoulders, at rest
};
Trunk trunk_of(const Character& character) {
  const auto& offset = character.joint_offset;
  Trunk trunk;
  trunk.hips = 0.5 * (offset[kLeftHip] + offset[kRightHip]);
  trunk.shoulders =
      0.5 * (offset[kLeftCollar] + offset[kLeftShoulder] + offset[kRightCollar] + offset[kRightShoulder]);
  trunk.direction = offset[kSpine1] + offset[kSpine2] + offset[kSpine3] + trunk.shoulders - trunk.hips;
  return trunk;
}

/// Orientation of a foot with a level sole that points to its toes, or without toes in the body's direction.
Quaterniond level_foot(const Character& character, const Landmarks& pose, int ankle, int toes,
                       bool has_toes) {
  const Vector3d rest = has_toes ? character.joint_offset[toes] : Vector3d::UnitZ();
  Vector3d points = has_toes ? pose.direction(ankle, toes) : pose.forward();
  if (hypot(points.x(), points.y()) < 0.1) points = pose.forward();
  return aligned(Vector3d::UnitY(), rest, Vector3d::UnitZ(), points);
}

/// Orientation of all bodies in a neutral pose, from the positions of the joints.
JointRotations neutral_rotations(const Character& character, const Landmarks& pose, const JointMap& map,
                                 const Twists& twists) {
  const Vector3d rest = trunk_of(character).direction, x = Vector3d::UnitX();
  JointRotations q;
  q[kPelvis] = aligned(x, rest, pose.direction(kRightHip, kLeftHip), pose.trunk());
  const Quaterniond chest = aligned(x, rest, pose.direction(kRightShoulder, kLeftShoulder), pose.trunk());
  for (int b = 1; b < kBodies; ++b) {
    q[b] = b == kSpine3 ? chest : q[kParents[b]];
    if (b == kSpine1) q[b] = slerp(q[kPelvis], 1.0 / 3.0, chest);
    if (b == kSpine2) q[b] = slerp(q[kPelvis], 2.0 / 3.0, chest);
    if (const int end = bone_end(b); end >= 0) {
      const Vector3d bone = bone_direction(character, b);
      q[b] = swung(q[b], bone, pose.direction(b, end)) * exp_map(twists[b] * bone);
    }
    if (b == kLeftAnkle) q[b] = level_foot(character, pose, b, kLeftFoot, map[kLeftFoot] >= 0);
    if (b == kRightAnkle) q[b] = level_foot(character, pose, b, kRightFoot, map[kRightFoot] >= 0);
  }
  return q;
}

/// Bends the lumbar bodies so that the middle of the shoulders lies in the skeleton's direction from the
/// hips.
void solve_trunk(const Character& character, const Vector3d& direction, JointRotations& q) {
  const Trunk trunk = trunk_of(character);
  const auto& offset = character.joint_offset;
  q[kSpine1] = slerp(q[kPelvis], 1.0 / 3.0, q[kSpine3]);
  q[kSpine2] = slerp(q[kPelvis], 2.0 / 3.0, q[kSpine3]);
  const Vector3d fixed = q[kPelvis] * (offset[kSpine1] - trunk.hips) + q[kSpine3] * trunk.shoulders;
  const Vector3d bends = q[kSpine1] * offset[kSpine2] + q[kSpine2] * offset[kSpine3];
  // fixed + Q · bends = reach · direction: a sphere and a ray; out of reach, the nearest point of the ray.
  const double along = fixed.dot(direction);
  const double room = bends.squaredNorm() - fixed.squaredNorm() + along * along;
  const double reach = along + std::sqrt(std::max(room, 0.0));
  const Quaterniond Q = rotation_between(bends, reach * direction - fixed);
  q[kSpine1] = (Q * q[kSpine1]).normalized();
  q[kSpine2] = (Q * q[kSpine2]).normalized();
}

}  // namespace

Vector3d shoulders_in_chest(const PerFrame<Landmarks>& poses) {
  Vector3d mean = Vector3d::Zero();
  for (const Landmarks& pose : poses)
    mean += pose.q[kSpine3].conjugate() * (pose.between(kLeftShoulder, kRightShoulder) - pose.p[kSpine3]) /
            static_cast<double>(poses.size());
  return mean;
}

Calibration calibrate(const Character& character, const NeutralPoses& neutral, const PerBody<bool>& turns,
                      const JointMap& map, const Twists& twists) {
  Calibration out;
  out.turns = turns;
  const auto take_means = [&](const PerFrame<Landmarks>& poses, const std::vector<int>& bodies) {
    PerBody<Eigen::Vector4d> sum;
    sum.fill(Eigen::Vector4d::Zero());
    for (const Landmarks& pose : poses) {
      const JointRotations q = neutral_rotations(character, pose, map, twists);
      for (const int b : bodies) {
        const Eigen::Vector4d q_JB = (pose.q[b].conjugate() * q[b]).coeffs();
        sum[b] += sum[b].dot(q_JB) < 0.0 ? Eigen::Vector4d(-q_JB) : q_JB;
      }
    }
    for (const int b : bodies) out.q_JB[b] = Quaterniond(sum[b]).normalized();
  };
  std::vector<int> all(kBodies);
  std::iota(all.begin(), all.end(), 0);
  take_means(neutral.body, all);
  if (!neutral.left_foot.empty()) take_means(neutral.left_foot, {kLeftAnkle, kLeftFoot});
  if (!neutral.right_foot.empty()) take_means(neutral.right_foot, {kRightAnkle, kRightFoot});
  out.p_JS = shoulders_in_chest(neutral.body);
  return out;
}

Twists measure_twists(const Character& character, const Calibration& calibration,
                      const PerFrame<Landmarks>& frames) {
  Twists twists{};
  for (const auto& [upper, lower] : {Bone{kLeftHip, kLeftKnee},
                                     {kRightHip, kRightKnee},
                                     {kLeftShoulder, kLeftElbow},
                                     {kRightShoulder, kRightElbow}}) {
    if (!calibration.turns[upper]) continue;
    // A hinge h keeps h · v, v the lower bone in the upper body's frame. With a twist α about the upper bone
    // u that is h_u v_u + a cos α + b sin α, where a and b come from what of h and v is across u.
    const Vector3d u = bone_direction(character, upper), h = hinge_axis(lower), across = h - h.dot(u) * u;
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    Eigen::Vector2d products = Eigen::Vector2d::Zero();
    for (const Landmarks& pose : frames) {
      const Quaterniond q = swung(pose.q[upper] * calibration.q_JB[upper], u, pose.direction(upper, lower));
      const Vector3d v = q.conjugate() * pose.direction(lower, bone_end(lower));
      const Eigen::Vector2d ab(across.dot(v), -across.dot(u.cross(v)));
      squares += ab * ab.transpose();
      products += (h.dot(bone_direction(character, lower)) - h.dot(u) * v.dot(u)) * ab;
    }
    // Least squares; every frame also pulls to zero twist with the weight of a bend of ten degrees.
    const double pull = 0.03 * static_cast<double>(frames.size());
    double best = std::numeric_limits<double>::infinity();
    for (int tenths = -900; tenths <= 900; ++tenths) {
      const double angle = tenths * std::numbers::pi / 1800.0;
      const Eigen::Vector2d cs(cos(angle), sin(angle));
      const double cost = cs.dot(squares * cs) - 2.0 * products.dot(cs) - 2.0 * pull * cs.x();
      if (cost >= best) continue;
      best = cost;
      twists[upper] = angle;
    }
  }
  return twists;
}

JointRotations body_rotations(const Character& character, const Calibration& calibration,
                              const Landmarks& pose) {
  JointRotations q;
  const auto calibrated = [&](int b) { return (pose.q[b] * calibration.q_JB[b]).normalized(); };
  q[kPelvis] = calibrated(kPelvis);
  q[kSpine3] = calibrated(kSpine3);
  const Vector3d shoulders = pose.p[kSpine3] + pose.q[kSpine3] * calibration.p_JS;
  solve_trunk(character, (shoulders - pose.between(kLeftHip, kRightHip)).normalized(), q);
  for (int b = 1; b < kBodies; ++b) {
    if (b == kSpine1 || b == kSpine2 || b == kSpine3) continue;
    q[b] = calibration.turns[b] ? calibrated(b) : q[kParents[b]];
    if (const int end = bone_end(b); end >= 0)
      q[b] = swung(q[b], bone_direction(character, b), pose.direction(b, end));
  }
  return q;
}

}  // namespace mimicx::import
