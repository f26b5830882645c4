/// The tree of the humanoid: 22 bodies on the SMPL-X body skeleton, their names, parents and joints.
///
/// Body i and the joint that connects it to its parent share the number i. The tree is fixed at compile time;
/// character.h has the quantities that depend on the shape.
#pragma once

#include <array>
#include <string_view>

#include "core/containers.h"
#include "core/so3.h"

namespace mimicx {

inline constexpr int kBodies = 22;
inline constexpr int kJoints = 21;  ///< actuated joints: every body but the pelvis
inline constexpr int kDofs = 55;    ///< actuated degrees of freedom: 17 · 3 + 4 · 1

/// One value per body, indexed by `Body` or int.
template <class T>
using PerBody = Array<T, kBodies>;

enum Body : int {
  kPelvis,
  kLeftHip,
  kRightHip,
  kSpine1,
  kLeftKnee,
  kRightKnee,
  kSpine2,
  kLeftAnkle,
  kRightAnkle,
  kSpine3,
  kLeftFoot,
  kRightFoot,
  kNeck,
  kLeftCollar,
  kRightCollar,
  kHead,
  kLeftShoulder,
  kRightShoulder,
  kLeftElbow,
  kRightElbow,
  kLeftWrist,
  kRightWrist
};

/// SMPL-X names, in the order of `Body`.
extern const PerBody<std::string_view> kBodyNames;
/// The body of that name, -1 for any other name.
int body_of_name(std::string_view name);
/// Parent of each body; -1 for the pelvis. Parents come before their children.
inline constexpr PerBody<int> kParents = {-1, 0, 0, 0, 1,  2,  3,  4,  5,  6,  7,
                                          8,  9, 9, 9, 12, 13, 14, 16, 17, 18, 19};

/// Knees and elbows turn about one axis; every other joint is spherical.
constexpr bool is_hinge(int body) {
  return body == kLeftKnee || body == kRightKnee || body == kLeftElbow || body == kRightElbow;
}
/// Unit axis of a hinge in the (coincident at rest) parent and child frames; positive angles flex.
Vector3d hinge_axis(int body);

/// First degree of freedom of a body's joint in 0..54, bodies 1..21 in order.
constexpr int first_dof(int body) {
  int dof = 0;
  for (int i = 1; i < body; ++i) dof += is_hinge(i) ? 1 : 3;
  return dof;
}
static_assert(first_dof(kBodies - 1) + 3 == kDofs);

/// End effectors e^p of the state: wrists and balls of the feet.                    docs/method.md §3
inline constexpr std::array<int, 4> kEndEffectors = {kLeftWrist, kRightWrist, kLeftFoot, kRightFoot};

/// Limbs: the trunk with head and collars (0), left and right leg (1, 2), left and right arm (3, 4).
inline constexpr int kLimbs = 5;
inline constexpr PerBody<int> kLimbOf = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 0, 0, 0, 3, 4, 3, 4, 3, 4};
/// The first body of each limb; of the trunk the pelvis.
inline constexpr Array<int, kLimbs> kLimbRoot = {kPelvis, kLeftHip, kRightHip, kLeftShoulder, kRightShoulder};

/// Whether a body is on the right side. It follows its mirror image: left body i, right body i + 1.
bool is_right(int body);

}  // namespace mimicx
