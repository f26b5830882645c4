/// Rigid-body dynamics straight from the book, as an oracle for src/physics.
///
/// Source: R. Featherstone, "Rigid Body Dynamics Algorithms" (2008, "RBDA"). Everything is a dense 6×6
/// matrix in *body* coordinates (the simulator works in world-parallel ones), in double, with the Plücker
/// transforms of the book's table 2.2. Only `Character` is shared with the product; no line of src/physics.
///
/// Conventions: spatial vectors are (angular; linear). The pelvis is a six-degree joint with S = 1 in its own
/// coordinates, so generalised velocities are (ω, v) of the pelvis in the pelvis frame, then ω of each joint
/// in the child's frame (1 number for a hinge): 6 + 55 = 61 degrees of freedom.
/// It has no contact, control or limits. External forces are inputs.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "character/character.h"

namespace mimicx::test {

inline constexpr int kBookDofs = 6 + kDofs;

using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct BookBody {
  int parent;           ///< λ(i); -1 for the pelvis
  int dof;              ///< first degree of freedom, of `dofs`
  int dofs;             ///< 6, 3 or 1
  Vector3d offset;      ///< joint centre in the parent's frame, m
  Eigen::MatrixXd S;    ///< motion subspace, 6 × dofs, body coordinates
  Matrix6d I;           ///< spatial inertia about the joint centre (RBDA eq. 2.63)
  double armature = 0;  ///< added to the diagonal of the joint-space inertia, kg·m²
};

struct BookModel {
  PerBody<BookBody> body;
  Vector3d gravity;  ///< world, m/s²
};

BookModel make_book_model(const Character& character, double gravity);

/// Position of the system. Rotations as matrices, child → parent; [0] pelvis → world.
struct BookPosition {
  Vector3d p_root;
  PerBody<Matrix3d> R;
};

/// Forces on bodies: spatial force about the body's joint centre in *world* axes, (moment; force).
using BookForces = PerBody<Vector6d>;
BookForces no_forces();

/// a× as a matrix.
Matrix3d book_skew(const Vector3d& a);

/// Everything that depends on position and velocity only.
struct BookKinematics {
  PerBody<Matrix6d> X;     ///< motion transform parent → body (root: world axes at the pelvis)
  PerBody<Matrix3d> R_WB;  ///< body → world
  PerBody<Vector3d> p_WB;  ///< joint centres in world, m
  PerBody<Vector6d> v;     ///< spatial velocity, body coordinates
  PerBody<Vector6d> v_J;   ///< joint velocity S q̇, body coordinates
};
BookKinematics book_kinematics(const BookModel& model, const BookPosition& q, const Eigen::VectorXd& qd);

/// Spatial cross products v× (motion) and v×* (force), RBDA eqs. 2.31, 2.32.
Matrix6d cross_motion(const Vector6d& v);
Matrix6d cross_force(const Vector6d& v);

}  // namespace mimicx::test
