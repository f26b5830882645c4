#include "trees/tree.h"

#include <stdexcept>

#include "core/error.h"

namespace mimicx::trees {

MatrixXd hinge(const Vector3d& axis) {
  MatrixXd S = MatrixXd::Zero(6, 1);
  S.topRows<3>() = axis.normalized();
  return S;
}
MatrixXd slider(const Vector3d& axis) {
  MatrixXd S = MatrixXd::Zero(6, 1);
  S.bottomRows<3>() = axis.normalized();
  return S;
}
MatrixXd ball() { return MatrixXd::Identity(6, 3); }
MatrixXd free_joint() { return MatrixXd::Identity(6, 6); }

Matrix6d spatial_inertia(const RigidBody& body) {
  const Matrix3d c = skew(body.com);
  Matrix6d I;
  I.topLeftCorner<3, 3>() = body.inertia + body.mass * c * c.transpose();
  I.topRightCorner<3, 3>() = body.mass * c;
  I.bottomLeftCorner<3, 3>() = body.mass * c.transpose();
  I.bottomRightCorner<3, 3>() = body.mass * Matrix3d::Identity();
  return I;
}

int Tree::add(int parent, const Vector3d& offset, const MatrixXd& S, const RigidBody& rigid) {
  const int i = body.count();
  if (parent < -1 || parent >= i) raise(std::invalid_argument("Tree::add: the tree has no such parent"));
  body.push_back({parent, offset, S, spatial_inertia(rigid), 0.0, dofs()});
  return i;
}

Tree humanoid(const Character& character, double gravity) {
  Tree tree;
  tree.gravity = Vector3d(0, 0, -gravity);
  for (int i = 0; i < kBodies; ++i) {
    tree.add(kParents[i], character.joint_offset[i],
             i == kPelvis  ? free_joint()
             : is_hinge(i) ? hinge(hinge_axis(i))
                           : ball(),
             {character.mass[i], character.com_B[i], character.inertia_B[i]});
    if (i > 0) tree.body[i].armature = character.joint[i].armature;
  }
  return tree;
}

TreeState rest_state(const Tree& tree) {
  const int n = tree.body.count();
  return {List<Matrix3d>(n, Matrix3d::Identity()), List<Vector3d>(n, Vector3d::Zero()),
          VectorXd::Zero(tree.dofs())};
}

double position(const Tree& tree, const TreeState& state, int body) {
  const MatrixXd& S = tree.body[body].S;
  return S.col(0).head<3>().dot(log_map(Quaterniond(state.R[body]))) + S.col(0).tail<3>().dot(state.p[body]);
}

void set_position(const Tree& tree, int body, double value, TreeState& state) {
  const MatrixXd& S = tree.body[body].S;
  state.R[body] = exp_map(Vector3d(value * S.col(0).head<3>())).toRotationMatrix();
  state.p[body] = value * S.col(0).tail<3>();
}

Matrix3d skew(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Matrix6d cross_motion(const Vector6d& v) {
  Matrix6d m = Matrix6d::Zero();
  m.topLeftCorner<3, 3>() = skew(v.head<3>());
  m.bottomLeftCorner<3, 3>() = skew(v.tail<3>());
  m.bottomRightCorner<3, 3>() = skew(v.head<3>());
  return m;
}

Matrix6d cross_force(const Vector6d& v) { return -cross_motion(v).transpose(); }

Matrix6d motion_transform(const Matrix3d& R, const Vector3d& r) {
  const Matrix3d E = R.transpose();
  Matrix6d X = Matrix6d::Zero();
  X.topLeftCorner<3, 3>() = E;
  X.bottomRightCorner<3, 3>() = E;
  X.bottomLeftCorner<3, 3>() = -E * skew(r);
  return X;
}

}  // namespace mimicx::trees
