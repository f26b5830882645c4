/// Inverse and forward dynamics of any tree, each by another algorithm of the book, and a step in time.
///
/// `qdd` and `tau` have one entry per degree of freedom, in the order of `TreeBody::dof`. The acceleration of
/// a free joint is the *spatial* one in its body's frame, gravity not subtracted.
#pragma once

#include "trees/tree.h"

namespace mimicx::trees {

/// External forces on the bodies: spatial force about the body's joint centre in *world* axes, (moment;
/// force). An empty list: none.
using TreeForces = List<Vector6d>;

/// Everything that depends on position and velocity only.
struct TreeKinematics {
  List<Matrix6d> X;     ///< motion transform parent (or world) → body
  List<Matrix3d> R_WB;  ///< body → world
  List<Vector3d> p_WB;  ///< joint centres in world, m
  List<Vector6d> v;     ///< spatial velocity, body coordinates
  List<Vector6d> v_J;   ///< joint velocity S q̇, body coordinates
};
TreeKinematics kinematics(const Tree& tree, const TreeState& state);

/// Recursive Newton–Euler: the generalised forces that produce qdd. Armature included.
///                                                                           RBDA table 5.1 with eq. 5.20
VectorXd inverse_dynamics(const Tree& tree, const TreeState& state, const VectorXd& qdd,
                          const TreeForces& external = {});

/// Composite-rigid-body algorithm: H with the armature on its diagonal.      RBDA table 6.2
MatrixXd mass_matrix(const Tree& tree, const TreeState& state);

/// H⁻¹(τ − C) by Cholesky, with C from Newton–Euler at q̈ = 0.
VectorXd dense_forward_dynamics(const Tree& tree, const TreeState& state, const VectorXd& tau,
                                const TreeForces& external = {});

/// Articulated-body algorithm with dense 6×6 matrices.                       RBDA table 7.1
VectorXd forward_dynamics(const Tree& tree, const TreeState& state, const VectorXd& tau,
                          const TreeForces& external = {});

/// Semi-implicit Euler: velocities first, positions with the new velocities. @param dt  s
void integrate(const Tree& tree, const VectorXd& qdd, double dt, TreeState& state);

/// Kinetic energy ½ Σ vᵀ I v, without the armatures, and potential energy −Σ m g·c, J.
double kinetic_energy(const Tree& tree, const TreeState& state);
double potential_energy(const Tree& tree, const TreeState& state);

}  // namespace mimicx::trees
