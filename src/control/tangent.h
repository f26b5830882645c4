/// The state manifold and its tangent space: small changes of a state as vectors.
///
/// A state contains rotations, so states have no componentwise difference. Instead x ⊖ y ∈ R¹²² is the change
/// that leads from y to x, and y ⊕ δ applies a change: (y ⊕ δ) ⊖ y = δ. Rotations change on the right,
/// q ↦ q·exp(δ), in the body's own frame, like angular velocities.
/// Order of the 122 coordinates:
///     0 …   2  root position, world, m
///     3 …   5  root rotation, body's frame, rad
///     6 …  60  joint rotations, child's frame, rad: one number about the axis of a hinge, three for a ball,
///              in the order of first_dof (character/bodies.h)
///    61 …  63  root velocity, world, m/s
///    64 …  66  root angular velocity, body's frame, rad/s
///    67 … 121  joint velocities, child's frame, rad/s, in the same order
/// Source: rotations as in Forster et al., "On-Manifold Preintegration" (2017), §II.
#pragma once

#include "core/containers.h"
#include "physics/data.h"
#include "physics/lanes.h"

namespace mimicx::control {

using namespace physics;  // states, targets and lanes are the simulator's

inline constexpr int kPositions = 6 + kDofs;     ///< coordinates of the pose
inline constexpr int kTangent = 2 * kPositions;  ///< coordinates of the state
// The first coordinate of each block.
inline constexpr int kRootPosition = 0;
inline constexpr int kRootRotation = 3;
inline constexpr int kJointRotation = 6;
inline constexpr int kRootVelocity = kPositions;
inline constexpr int kRootSpin = kPositions + 3;
inline constexpr int kJointVelocity = kPositions + 6;

template <class T>
using Tangent = Array<T, kTangent>;

/// One actuated degree of freedom.
struct Dof {
  int body;
  Vector3d axis;  ///< of the rotation, child's frame
};
/// All actuated degrees of freedom, in the order of first_dof.
const Array<Dof, kDofs>& dofs();

/// Calls visit(above, axis, k) for every rotation that moves a body, its own and those of its ancestors.
/// @param d  kinematics of the state
/// @param visit  above: the body that turns about its joint; axis: in the world; k: coordinate of the pose
template <class Visit>
void for_each_rotation(const Data<double>& d, int body, const Visit& visit) {
  for (int above = body; above >= 0; above = kParents[above]) {
    const Matrix3d R = to_eigen(d.q_WB[above]).toRotationMatrix();
    const int first = above == 0 ? kRootRotation : kJointRotation + first_dof(above);
    for (int n = 0; n < (is_hinge(above) ? 1 : 3); ++n)
      visit(above, is_hinge(above) ? Vector3d(R * hinge_axis(above)) : Vector3d(R.col(n)), first + n);
  }
}

/// a ⊖ b, lane by lane, along the shorter rotations.
template <class T>
Tangent<T> difference(const State<T>& a, const State<T>& b);

/// s ⊕ delta, lane by lane, in place. Rotation coordinates must stay under half a turn.
template <class T>
void retract(State<T>& s, const Tangent<T>& delta);

}  // namespace mimicx::control
