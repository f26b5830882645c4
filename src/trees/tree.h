/// Any tree of rigid bodies: pendulum, arm, cart-pole, hopper, the humanoid.
///
/// Source: R. Featherstone, "Rigid Body Dynamics Algorithms" (2008, "RBDA"). Everything is a dense 6×6
/// matrix in *body* coordinates, in double, with the Plücker transforms of the book's table 2.2: the form to
/// learn the algorithms from. The simulator of src/physics does the same for one tree, in a form
/// made for speed (docs/trees.md §3), and is tested against this one; the two share `Character` alone.
///
/// Conventions: spatial vectors are (angular; linear). A joint i leads from body λ(i) to body i. Its centre
/// is at rest at `offset` in the parent's frame, and its motion subspace S is constant in the child's frame.
/// That covers every joint without a formula of its own: a hinge is S = (axis; 0), a slider S = (0; axis).
/// It has no contact, control or limits. External forces are inputs.
#pragma once

#include <Eigen/Core>

#include "character/character.h"
#include "core/units.h"

namespace mimicx::trees {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Motion subspaces S, 6 × degrees of freedom, child's frame.                              RBDA table 4.1
MatrixXd hinge(const Vector3d& axis);
MatrixXd slider(const Vector3d& axis);
MatrixXd ball();
MatrixXd free_joint();

/// A rigid body in its own frame, whose origin is its joint centre.
struct RigidBody {
  double mass = 0;                      ///< kg
  Vector3d com = Vector3d::Zero();      ///< centre of mass, m
  Matrix3d inertia = Matrix3d::Zero();  ///< about the centre of mass, kg·m²
};
/// Spatial inertia about the body's origin.                                                RBDA eq. 2.63
Matrix6d spatial_inertia(const RigidBody& body);

/// A body and the joint that connects it to its parent.
struct TreeBody {
  int parent;           ///< λ(i), a smaller number; −1: the world
  Vector3d offset;      ///< joint centre in the parent's frame, m
  MatrixXd S;           ///< motion subspace, 6 × dofs, body coordinates
  Matrix6d I;           ///< spatial inertia about the joint centre
  double armature = 0;  ///< added to the diagonal of the joint-space inertia, kg·m² or kg
  int dof = 0;          ///< the joint's first entry in q̇, of `dofs()`
  int dofs() const { return static_cast<int>(S.cols()); }
};

struct Tree {
  Vector3d gravity = Vector3d(0, 0, -kGravity);  ///< world, m/s²
  List<TreeBody> body;

  int dofs() const { return body.empty() ? 0 : body.back().dof + body.back().dofs(); }
  /// Adds a body to a tree. @param parent  number of a body of the tree; −1: the world
  /// @return the number of the new body. @throws std::invalid_argument for another parent
  int add(int parent, const Vector3d& offset, const MatrixXd& S, const RigidBody& rigid);
};

/// The character as a tree: body numbers are those of `Body`, the pelvis is a free joint. Its 61 velocities
/// are (ω, v) of the pelvis in its own frame, then ω of each joint in the child's (one number for a hinge).
Tree humanoid(const Character& character, double gravity);

/// Configuration and velocity. The position of joint i is where its child's frame is, seen from the frame at
/// the joint's centre in the parent: rotation R and translation p.
struct TreeState {
  List<Matrix3d> R;  ///< child → parent
  List<Vector3d> p;  ///< m, parent's axes; zero but for sliders and free joints
  VectorXd qd;       ///< q̇, rad/s and m/s
};
/// All joints at zero, at rest.
TreeState rest_state(const Tree& tree);

/// Position of a hinge (rad, −π to π) or a slider (m).
double position(const Tree& tree, const TreeState& state, int body);
void set_position(const Tree& tree, int body, double value, TreeState& state);

/// a× as a matrix.
Matrix3d skew(const Vector3d& a);
/// Spatial cross products v× (motion) and v×* (force).                               RBDA eqs. 2.31, 2.32
Matrix6d cross_motion(const Vector6d& v);
Matrix6d cross_force(const Vector6d& v);
/// Motion transform into a frame whose origin is at r and whose axes are the columns of R, both given in
/// the old frame: X = [E 0; −E r× E], E = Rᵀ.                                     RBDA table 2.2, eq. 2.24
Matrix6d motion_transform(const Matrix3d& R, const Vector3d& r);

}  // namespace mimicx::trees
