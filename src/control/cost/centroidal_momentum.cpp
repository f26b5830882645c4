#include "control/cost/centroidal_momentum.h"

#include "control/analytic/rotation_derivatives.h"
#include "physics/lanes.h"

namespace mimicx::control {
namespace {

Matrix3d to_matrix3(const Sym3<double>& s) {
  Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}

Matrix3d rotation(const Data<double>& d, int body) {
  Matrix3d R;
  for (int k = 0; k < 3; ++k) R.col(k) = to_eigen(d.R_WB[body].c[k]);
  return R;
}

/// A body with all bodies that it carries, in world axes about its joint centre.
struct Subtree {
  double mass = 0;
  Vector3d moment = Vector3d::Zero();   ///< mass times the centre of mass, from the joint centre, kg·m
  Matrix3d inertia = Matrix3d::Zero();  ///< kg·m²
  Vector3d linear = Vector3d::Zero();   ///< momentum, kg·m/s
  Vector3d angular = Vector3d::Zero();  ///< about the joint centre, kg·m²/s

  /// Adds the subtree of a joint that lies r away from this one.
  void add(const Subtree& s, const Vector3d& r) {
    mass += s.mass;
    moment += s.moment + s.mass * r;
    inertia +=
        s.inertia - skew_product(r, s.moment) - skew_product(s.moment, r) - s.mass * skew_product(r, r);
    linear += s.linear;
    angular += s.angular + r.cross(s.linear);
  }
};

PerBody<Subtree> subtrees(const Model<double>& model, const Data<double>& d) {
  PerBody<Subtree> all;
  for (int i = 0; i < kBodies; ++i) {
    const Matrix3d R = rotation(d, i);
    const Vector3d w = to_eigen(d.w[i]), v = to_eigen(d.v[i]);
    Subtree& s = all[i];
    s.mass = model.mass[i];
    s.moment = s.mass * (R * to_eigen(model.com[i]));
    s.inertia = R * to_matrix3(model.inertia_o[i]) * R.transpose();
    s.linear = s.mass * v + w.cross(s.moment);
    s.angular = s.inertia * w + s.moment.cross(v);
  }
  for (int i = kBodies - 1; i > 0; --i) all[kParents[i]].add(all[i], to_eigen(d.r[i]));
  return all;
}

/// Columns of one rotation axis a (world, unit) at a joint: by its angle and by its speed.
struct JointColumns {
  const Subtree& whole;  ///< of the pelvis
  Vector3d com;          ///< of the body, from the pelvis joint
  const Subtree& carried;
  Vector3d p;                        ///< joint centre, from the pelvis joint
  Vector3d w_parent, v;              ///< angular velocity of the parent; velocity of the joint centre
  Vector3d own_linear, own_angular;  ///< momentum of `carried` relative to the parent, about the joint centre

  JointColumns(const Subtree& root, const Subtree& subtree, const Data<double>& d, int body)
      : whole(root),
        com(root.moment / root.mass),
        carried(subtree),
        p(to_eigen(d.p_WB[body] - d.p_WB[0])),
        w_parent(Vector3d::Zero()),
        v(to_eigen(d.v[body])) {
    if (body > 0) w_parent = to_eigen(d.w[kParents[body]]);
    own_linear = carried.linear - carried.mass * v - w_parent.cross(carried.moment);
    own_angular = carried.angular - carried.moment.cross(v) - carried.inertia * w_parent;
  }

  /// docs/control.md §6: an angular momentum about the joint centre seen from the centre of mass.
  Vector6d about_com(const Vector3d& linear, const Vector3d& angular) const {
    Vector6d out;
    out << linear, angular + (p - com).cross(linear);
    return out / whole.mass;
  }

  Vector6d by_speed(const Vector3d& a) const {
    return about_com(a.cross(carried.moment), carried.inertia * a);
  }

  Vector6d by_angle(const Vector3d& a) const {
    const Vector3d moved = a.cross(carried.moment);
    Vector6d out = about_com(a.cross(own_linear) + w_parent.cross(moved),
                             a.cross(own_angular) + moved.cross(v) + a.cross(carried.inertia * w_parent) -
                                 carried.inertia * a.cross(w_parent));
    out.tail<3>() -= (moved / whole.mass).cross(whole.linear) / whole.mass;
    return out;
  }
};

}  // namespace

template <class T>
CentroidalMomentum<T> centroidal_momentum(const Model<RealOf<T>>& model, const Data<T>& d) {
  Vec3<T> linear = zero3<T>(), angular = zero3<T>(), moment = zero3<T>();  // about the pelvis joint
  RealOf<T> mass = 0;
  for (int i = 0; i < kBodies; ++i) {
    const T m(model.mass[i]);
    const Vec3<T> p = d.p_WB[i] - d.p_WB[0], h = m * (d.R_WB[i] * spread<T>(model.com[i]));
    const Sym3<RealOf<T>>& I = model.inertia_o[i];
    const Sym3<T> inertia{T(I.xx), T(I.xy), T(I.xz), T(I.yy), T(I.yz), T(I.zz)};
    const Vec3<T> own = d.R_WB[i] * (inertia * transpose_times(d.R_WB[i], d.w[i]));
    const Vec3<T> momentum = m * d.v[i] + cross(d.w[i], h);
    linear += momentum;
    angular += own + cross(h, d.v[i]) + cross(p, momentum);
    moment += h + m * p;
    mass += model.mass[i];
  }
  const T per_mass(1 / mass);
  return {per_mass * linear, per_mass * (angular - per_mass * cross(moment, linear))};
}

CentroidalJacobian centroidal_jacobian(const Model<double>& model, const Data<double>& d) {
  const PerBody<Subtree> all = subtrees(model, d);
  CentroidalJacobian J = CentroidalJacobian::Zero();
  J.block<3, 3>(0, kRootVelocity).setIdentity();
  for (int i = 0; i < kBodies; ++i) {
    const JointColumns columns(all[0], all[i], d, i);
    const Matrix3d R = rotation(d, i);
    const int first = i == 0 ? kRootRotation : kJointRotation + first_dof(i);
    const int count = is_hinge(i) ? 1 : 3;
    for (int k = 0; k < count; ++k) {
      const Vector3d a = is_hinge(i) ? Vector3d(R * hinge_axis(i)) : Vector3d(R.col(k));
      J.col(first + k) = columns.by_angle(a);
      J.col(kPositions + first + k) = columns.by_speed(a);
    }
  }
  return J;
}

template CentroidalMomentum<double> centroidal_momentum(const Model<double>&, const Data<double>&);
template CentroidalMomentum<Pack<kLanes>> centroidal_momentum(const Model<float>&, const Data<Pack<kLanes>>&);

}  // namespace mimicx::control
