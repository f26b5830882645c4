#include "oracles/book_dynamics.h"

namespace mimicx::test {
namespace {

/// A force given in world axes about the joint centre, in body coordinates.
Vector6d to_body(const Matrix3d& R_WB, const Vector6d& f_W) {
  Vector6d f;
  f.head<3>() = R_WB.transpose() * f_W.head<3>();
  f.tail<3>() = R_WB.transpose() * f_W.tail<3>();
  return f;
}

Vector6d spatial_gravity(const BookModel& model) {
  Vector6d a = Vector6d::Zero();
  a.tail<3>() = model.gravity;
  return a;
}

}  // namespace

Eigen::VectorXd book_inverse_dynamics(const BookModel& model, const BookPosition& q,
                                      const Eigen::VectorXd& qd, const Eigen::VectorXd& qdd,
                                      const BookForces& external) {
  const BookKinematics k = book_kinematics(model, q, qd);
  PerBody<Vector6d> a, f;
  for (int i = 0; i < kBodies; ++i) {
    const BookBody& body = model.body[i];
    // Gravity enters as a fictitious acceleration −a_g of the world.
    const Vector6d a_parent = body.parent < 0 ? Vector6d(-spatial_gravity(model)) : a[body.parent];
    a[i] = k.X[i] * a_parent + body.S * qdd.segment(body.dof, body.dofs) + cross_motion(k.v[i]) * k.v_J[i];
    f[i] = body.I * a[i] + cross_force(k.v[i]) * body.I * k.v[i] - to_body(k.R_WB[i], external[i]);
  }
  Eigen::VectorXd tau(kBookDofs);
  for (int i = kBodies - 1; i >= 0; --i) {
    const BookBody& body = model.body[i];
    tau.segment(body.dof, body.dofs) =
        body.S.transpose() * f[i] + body.armature * qdd.segment(body.dof, body.dofs);
    if (body.parent >= 0) f[body.parent] += k.X[i].transpose() * f[i];
  }
  return tau;
}

Eigen::MatrixXd book_mass_matrix(const BookModel& model, const BookPosition& q) {
  const BookKinematics k = book_kinematics(model, q, Eigen::VectorXd::Zero(kBookDofs));
  PerBody<Matrix6d> I_c;
  for (int i = 0; i < kBodies; ++i) I_c[i] = model.body[i].I;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(kBookDofs, kBookDofs);
  for (int i = kBodies - 1; i >= 0; --i) {
    const BookBody& body = model.body[i];
    if (body.parent >= 0) I_c[body.parent] += k.X[i].transpose() * I_c[i] * k.X[i];
    Eigen::MatrixXd F = I_c[i] * body.S;
    H.block(body.dof, body.dof, body.dofs, body.dofs) =
        body.S.transpose() * F + body.armature * Eigen::MatrixXd::Identity(body.dofs, body.dofs);
    for (int j = i; model.body[j].parent >= 0;) {
      F = (k.X[j].transpose() * F).eval();
      j = model.body[j].parent;
      const BookBody& ancestor = model.body[j];
      H.block(ancestor.dof, body.dof, ancestor.dofs, body.dofs) = ancestor.S.transpose() * F;
      H.block(body.dof, ancestor.dof, body.dofs, ancestor.dofs) = F.transpose() * ancestor.S;
    }
  }
  return H;
}

Eigen::VectorXd book_forward_dynamics_dense(const BookModel& model, const BookPosition& q,
                                            const Eigen::VectorXd& qd, const Eigen::VectorXd& tau,
                                            const BookForces& external) {
  const Eigen::VectorXd C = book_inverse_dynamics(model, q, qd, Eigen::VectorXd::Zero(kBookDofs), external);
  return book_mass_matrix(model, q).llt().solve(tau - C);
}

Eigen::VectorXd book_forward_dynamics_aba(const BookModel& model, const BookPosition& q,
                                          const Eigen::VectorXd& qd, const Eigen::VectorXd& tau,
                                          const BookForces& external) {
  const BookKinematics k = book_kinematics(model, q, qd);
  PerBody<Matrix6d> IA;
  PerBody<Vector6d> pA, c, a;
  PerBody<Eigen::MatrixXd> U, D;
  PerBody<Eigen::VectorXd> u;
  for (int i = 0; i < kBodies; ++i) {
    IA[i] = model.body[i].I;
    c[i] = cross_motion(k.v[i]) * k.v_J[i];
    pA[i] = cross_force(k.v[i]) * model.body[i].I * k.v[i] - to_body(k.R_WB[i], external[i]);
  }
  for (int i = kBodies - 1; i > 0; --i) {
    const BookBody& body = model.body[i];
    const int lambda = body.parent;
    U[i] = IA[i] * body.S;
    D[i] = body.S.transpose() * U[i] + body.armature * Eigen::MatrixXd::Identity(body.dofs, body.dofs);
    u[i] = tau.segment(body.dof, body.dofs) - body.S.transpose() * pA[i];
    const Matrix6d Ia = IA[i] - U[i] * D[i].inverse() * U[i].transpose();
    const Vector6d pa = pA[i] + Ia * c[i] + U[i] * D[i].inverse() * u[i];
    IA[lambda] += k.X[i].transpose() * Ia * k.X[i];
    pA[lambda] += k.X[i].transpose() * pa;
  }
  // Floating base: a₀ relative to a freely falling frame; the true one has gravity added at the end.
  Eigen::VectorXd qdd(kBookDofs);
  a[0] = IA[0].ldlt().solve(tau.head<6>() - pA[0]);
  qdd.head<6>() = a[0] + k.X[0] * spatial_gravity(model);
  for (int i = 1; i < kBodies; ++i) {
    const BookBody& body = model.body[i];
    const Vector6d a_prime = k.X[i] * a[body.parent] + c[i];
    const Eigen::VectorXd x = D[i].inverse() * (u[i] - U[i].transpose() * a_prime);
    qdd.segment(body.dof, body.dofs) = x;
    a[i] = a_prime + body.S * x;
  }
  return qdd;
}

}  // namespace mimicx::test
