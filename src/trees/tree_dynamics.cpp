#include "trees/tree_dynamics.h"

#include "core/decompositions.h"

namespace mimicx::trees {
namespace {

/// The external force on body i in body coordinates; zero where none are given.
Vector6d force_on(const TreeForces& external, int i, const Matrix3d& R_WB) {
  if (external.empty()) return Vector6d::Zero();
  Vector6d f;
  f.head<3>() = R_WB.transpose() * external[i].head<3>();
  f.tail<3>() = R_WB.transpose() * external[i].tail<3>();
  return f;
}

/// Gravity enters as a fictitious acceleration −a_g of the world.
Vector6d acceleration_of_world(const Tree& tree) {
  Vector6d a = Vector6d::Zero();
  a.tail<3>() = -tree.gravity;
  return a;
}

}  // namespace

TreeKinematics kinematics(const Tree& tree, const TreeState& state) {
  const int n = tree.body.count();
  TreeKinematics k{List<Matrix6d>(n), List<Matrix3d>(n), List<Vector3d>(n), List<Vector6d>(n),
                   List<Vector6d>(n)};
  for (int i = 0; i < n; ++i) {
    const TreeBody& body = tree.body[i];
    const Vector3d r = body.offset + state.p[i];
    k.X[i] = motion_transform(state.R[i], r);
    k.v_J[i] = body.S * state.qd.segment(body.dof, body.dofs());
    if (body.parent < 0) {
      k.R_WB[i] = state.R[i];
      k.p_WB[i] = r;
      k.v[i] = k.v_J[i];
    } else {
      k.R_WB[i] = k.R_WB[body.parent] * state.R[i];
      k.p_WB[i] = k.p_WB[body.parent] + k.R_WB[body.parent] * r;
      k.v[i] = k.X[i] * k.v[body.parent] + k.v_J[i];
    }
  }
  return k;
}

VectorXd inverse_dynamics(const Tree& tree, const TreeState& state, const VectorXd& qdd,
                          const TreeForces& external) {
  const TreeKinematics k = kinematics(tree, state);
  const int n = tree.body.count();
  List<Vector6d> a(n), f(n);
  for (int i = 0; i < n; ++i) {
    const TreeBody& body = tree.body[i];
    const Vector6d a_parent = body.parent < 0 ? acceleration_of_world(tree) : a[body.parent];
    a[i] = k.X[i] * a_parent + body.S * qdd.segment(body.dof, body.dofs()) + cross_motion(k.v[i]) * k.v_J[i];
    f[i] = body.I * a[i] + cross_force(k.v[i]) * body.I * k.v[i] - force_on(external, i, k.R_WB[i]);
  }
  VectorXd tau(tree.dofs());
  for (int i = n - 1; i >= 0; --i) {
    const TreeBody& body = tree.body[i];
    tau.segment(body.dof, body.dofs()) =
        body.S.transpose() * f[i] + body.armature * qdd.segment(body.dof, body.dofs());
    if (body.parent >= 0) f[body.parent] += k.X[i].transpose() * f[i];
  }
  return tau;
}

MatrixXd mass_matrix(const Tree& tree, const TreeState& state) {
  const TreeKinematics k = kinematics(tree, state);
  List<Matrix6d> I_c;
  for (const TreeBody& body : tree.body) I_c.push_back(body.I);
  MatrixXd H = MatrixXd::Zero(tree.dofs(), tree.dofs());
  for (int i = tree.body.count() - 1; i >= 0; --i) {
    const TreeBody& body = tree.body[i];
    if (body.parent >= 0) I_c[body.parent] += k.X[i].transpose() * I_c[i] * k.X[i];
    MatrixXd F = I_c[i] * body.S;
    H.block(body.dof, body.dof, body.dofs(), body.dofs()) =
        body.S.transpose() * F + body.armature * MatrixXd::Identity(body.dofs(), body.dofs());
    for (int j = i; tree.body[j].parent >= 0;) {
      F = (k.X[j].transpose() * F).eval();
      j = tree.body[j].parent;
      const TreeBody& ancestor = tree.body[j];
      H.block(ancestor.dof, body.dof, ancestor.dofs(), body.dofs()) = ancestor.S.transpose() * F;
      H.block(body.dof, ancestor.dof, body.dofs(), ancestor.dofs()) = F.transpose() * ancestor.S;
    }
  }
  return H;
}

VectorXd dense_forward_dynamics(const Tree& tree, const TreeState& state, const VectorXd& tau,
                                const TreeForces& external) {
  const VectorXd C = inverse_dynamics(tree, state, VectorXd::Zero(tree.dofs()), external);
  return solve_symmetric(mass_matrix(tree, state), tau - C);
}

VectorXd forward_dynamics(const Tree& tree, const TreeState& state, const VectorXd& tau,
                          const TreeForces& external) {
  const TreeKinematics k = kinematics(tree, state);
  const int n = tree.body.count();
  List<Matrix6d> IA(n);
  List<Vector6d> pA(n), c(n), a(n);
  List<MatrixXd> U(n), D_inv(n);
  List<VectorXd> u(n);
  for (int i = 0; i < n; ++i) {
    const Matrix6d& I = tree.body[i].I;
    IA[i] = I;
    c[i] = cross_motion(k.v[i]) * k.v_J[i];
    pA[i] = cross_force(k.v[i]) * I * k.v[i] - force_on(external, i, k.R_WB[i]);
  }
  for (int i = n - 1; i >= 0; --i) {
    const TreeBody& body = tree.body[i];
    U[i] = IA[i] * body.S;
    D_inv[i] = inverse_symmetric(body.S.transpose() * U[i] +
                                 body.armature * MatrixXd::Identity(body.dofs(), body.dofs()));
    u[i] = tau.segment(body.dof, body.dofs()) - body.S.transpose() * pA[i];
    if (body.parent < 0) continue;
    const Matrix6d Ia = IA[i] - U[i] * D_inv[i] * U[i].transpose();
    const Vector6d pa = pA[i] + Ia * c[i] + U[i] * D_inv[i] * u[i];
    IA[body.parent] += k.X[i].transpose() * Ia * k.X[i];
    pA[body.parent] += k.X[i].transpose() * pa;
  }
  VectorXd qdd(tree.dofs());
  for (int i = 0; i < n; ++i) {
    const TreeBody& body = tree.body[i];
    const Vector6d a_parent = body.parent < 0 ? acceleration_of_world(tree) : a[body.parent];
    const Vector6d a_prime = k.X[i] * a_parent + c[i];
    const VectorXd qdd_i = D_inv[i] * (u[i] - U[i].transpose() * a_prime);
    qdd.segment(body.dof, body.dofs()) = qdd_i;
    a[i] = a_prime + body.S * qdd_i;
  }
  return qdd;
}

void integrate(const Tree& tree, const VectorXd& qdd, double dt, TreeState& state) {
  state.qd += dt * qdd;
  for (int i = 0; i < tree.body.count(); ++i) {
    const TreeBody& body = tree.body[i];
    const Vector6d v_J = body.S * state.qd.segment(body.dof, body.dofs());
    state.p[i] += dt * (state.R[i] * v_J.tail<3>());
    const Quaterniond turned = Quaterniond(state.R[i]) * exp_map(Vector3d(dt * v_J.head<3>()));
    state.R[i] = turned.normalized().toRotationMatrix();
  }
}

double kinetic_energy(const Tree& tree, const TreeState& state) {
  const TreeKinematics k = kinematics(tree, state);
  double energy = 0.0;
  for (int i = 0; i < tree.body.count(); ++i) energy += 0.5 * k.v[i].dot(tree.body[i].I * k.v[i]);
  return energy;
}

double potential_energy(const Tree& tree, const TreeState& state) {
  const TreeKinematics k = kinematics(tree, state);
  double energy = 0.0;
  for (int i = 0; i < tree.body.count(); ++i) {
    const Matrix6d& I = tree.body[i].I;  // [·, m c×; ·, m 1]
    const Vector3d m_c(I(2, 4), I(0, 5), I(1, 3));
    energy -= tree.gravity.dot(I(3, 3) * k.p_WB[i] + k.R_WB[i] * m_c);
  }
  return energy;
}

}  // namespace mimicx::trees
