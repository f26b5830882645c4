#include "oracles/book_model.h"

namespace mimicx::test {
namespace {

/// Motion transform into a frame whose origin is at r and whose axes are the columns of R, both given in
/// the old frame: X = [E 0; −E r× E], E = Rᵀ.                                     RBDA table 2.2, eq. 2.24
Matrix6d motion_transform(const Matrix3d& R, const Vector3d& r) {
  const Matrix3d E = R.transpose();
  Matrix6d X = Matrix6d::Zero();
  X.topLeftCorner<3, 3>() = E;
  X.bottomRightCorner<3, 3>() = E;
  X.bottomLeftCorner<3, 3>() = -E * book_skew(r);
  return X;
}

}  // namespace

Matrix3d book_skew(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Matrix6d cross_motion(const Vector6d& v) {
  Matrix6d m = Matrix6d::Zero();
  m.topLeftCorner<3, 3>() = book_skew(v.head<3>());
  m.bottomLeftCorner<3, 3>() = book_skew(v.tail<3>());
  m.bottomRightCorner<3, 3>() = book_skew(v.head<3>());
  return m;
}
Matrix6d cross_force(const Vector6d& v) { return -cross_motion(v).transpose(); }

BookForces no_forces() {
  BookForces forces;
  forces.fill(Vector6d::Zero());
  return forces;
}

BookModel make_book_model(const Character& character, double gravity) {
  BookModel model;
  model.gravity = Vector3d(0, 0, -gravity);
  int dof = 0;
  for (int i = 0; i < kBodies; ++i) {
    BookBody& body = model.body[i];
    body.parent = kParents[i];
    body.offset = character.joint_offset[i];
    body.dofs = i == 0 ? 6 : is_hinge(i) ? 1 : 3;
    body.dof = dof;
    dof += body.dofs;
    body.S = Eigen::MatrixXd::Zero(6, body.dofs);
    if (is_hinge(i))
      body.S.col(0).head<3>() = hinge_axis(i);
    else
      body.S.setIdentity();
    if (i > 0) body.armature = character.joint[i].armature;
    const double m = character.mass[i];
    const Matrix3d c = book_skew(character.com_B[i]);
    body.I.topLeftCorner<3, 3>() = character.inertia_B[i] + m * c * c.transpose();
    body.I.topRightCorner<3, 3>() = m * c;
    body.I.bottomLeftCorner<3, 3>() = m * c.transpose();
    body.I.bottomRightCorner<3, 3>() = m * Matrix3d::Identity();
  }
  return model;
}

BookKinematics book_kinematics(const BookModel& model, const BookPosition& q, const Eigen::VectorXd& qd) {
  BookKinematics k;
  for (int i = 0; i < kBodies; ++i) {
    const BookBody& body = model.body[i];
    k.v_J[i] = body.S * qd.segment(body.dof, body.dofs);
    if (body.parent < 0) {
      k.R_WB[i] = q.R[i];
      k.p_WB[i] = q.p_root;
      k.X[i] = motion_transform(q.R[i], Vector3d::Zero());
      k.v[i] = k.v_J[i];
    } else {
      const int parent = body.parent;
      k.R_WB[i] = k.R_WB[parent] * q.R[i];
      k.p_WB[i] = k.p_WB[parent] + k.R_WB[parent] * body.offset;
      k.X[i] = motion_transform(q.R[i], body.offset);
      k.v[i] = k.X[i] * k.v[parent] + k.v_J[i];
    }
  }
  return k;
}

}  // namespace mimicx::test
