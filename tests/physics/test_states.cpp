#include "physics/test_states.h"

#include <algorithm>
#include <numbers>

#include "physics/standing_state.h"

namespace mimicx::physics {

Vector3d random_vector(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

std::array<double, kBetas> random_betas(Random& random) {
  std::array<double, kBetas> betas;
  for (double& b : betas) b = random.uniform(-3.0, 3.0);
  return betas;
}

Snapshot random_snapshot(Random& random, double angle, double speed, double height) {
  Snapshot s;
  s.p_root = {random.uniform(-1, 1), random.uniform(-1, 1), height};
  s.v_root = speed * random_vector(random);
  const auto rotation = [&](int i) {
    const double size = random.uniform(0.0, i == 0 ? std::numbers::pi : angle);
    const Vector3d axis = is_hinge(i) ? hinge_axis(i) : Vector3d(random_vector(random).normalized());
    return exp_map(size * axis);
  };
  const auto spin = [&](int i) {
    return is_hinge(i) ? Vector3d(speed * random.normal() * hinge_axis(i))
                       : Vector3d(speed * random_vector(random));
  };
  for (int i = 0; i < kBodies; ++i) {
    s.q[i] = rotation(i);
    s.omega[i] = spin(i);
    s.target_q[i] = rotation(i);
    s.target_omega[i] = i == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(0.3 * spin(i));
  }
  return s;
}

double lowest_point(const Character& character, const Snapshot& s) {
  return lowest_contact(character, forward_kinematics(character, s.p_root, s.q));
}

Snapshot standing(const Character& character) {
  Snapshot s;
  read_lane(standing_state(character), 0, s);
  s.target_omega.fill(Vector3d::Zero());
  s.target_q = s.q;
  return s;
}

namespace {

Vector3d centre_of_mass(const Character& c, const BodyPoses& poses) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < kBodies; ++i) sum += c.mass[i] * (poses.p_WB[i] + poses.q_WB[i] * c.com_B[i]);
  return sum / c.total_mass();
}

/// Mean of the sole points of the given feet (bodies of the balls and their ankles), world.
Vector3d middle_of_soles(const Character& c, std::initializer_list<int> feet, const BodyPoses& poses) {
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (int k = 0; k < kFootPoints; ++k)
    for (int foot : feet) {
      const ContactPoint& point = c.contact_points[k];
      if (point.body != foot && point.body != kParents[foot]) continue;
      const int i = point.body;
      sum += poses.p_WB[i] + poses.q_WB[i] * sole_point(point);
      count += 1;
    }
  return sum / count;
}

}  // namespace

void balance(const Character& character, std::initializer_list<int> feet, Snapshot& s) {
  const Quaterniond flat = exp_map(Vector3d(std::numbers::pi / 2, 0, 0));
  const Quaterniond upright = s.q[0];
  Vector3d lean = Vector3d::Zero();
  for (int iteration = 0; iteration < 50; ++iteration) {
    s.q[0] = exp_map(lean) * upright;
    BodyPoses poses = forward_kinematics(character, s.p_root, s.q);
    for (int foot : feet) {
      const auto ankle = kParents[foot];
      s.q[ankle] = poses.q_WB[kParents[ankle]].conjugate() * flat;
      s.q[foot] = Quaterniond::Identity();
    }
    poses = forward_kinematics(character, s.p_root, s.q);
    const Vector3d offset = centre_of_mass(character, poses) - middle_of_soles(character, feet, poses);
    // A lean about x by α moves the centre of mass, offset.z above the soles, by −α·z in y.
    lean += Vector3d(offset.y(), -offset.x(), 0) / offset.z();
  }
  s.p_root.z() -= lowest_point(character, s);
  s.target_q = s.q;
}

Character stiffened(Character character) {
  for (JointParameters& j : character.joint) {
    j.kp *= 40;
    j.kd *= 40;
    j.torque_limit *= 40;
  }
  return character;
}

MotionState random_motion(const Snapshot& s, Random& random) {
  MotionState m;
  m.p_root = s.p_root;
  m.v_root = s.v_root;
  m.a_root = 20.0 * random_vector(random);
  m.q = s.q;
  m.omega = s.omega;
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d x = 50.0 * random_vector(random);
    m.omega_d[i] = is_hinge(i) ? Vector3d(x.x() * hinge_axis(i)) : x;
  }
  return m;
}

BodyWrenches random_wrenches(Random& random) {
  BodyWrenches wrenches;
  for (Vector6d& w : wrenches) {
    w.head<3>() = 30.0 * random_vector(random);
    w.tail<3>() = 200.0 * random_vector(random);
  }
  return wrenches;
}

trees::TreeState tree_state(const Snapshot& s) {
  trees::TreeState state;
  for (const Quaterniond& q : s.q) state.R.push_back(q.toRotationMatrix());
  state.p.assign(kBodies, Vector3d::Zero());
  state.p[kPelvis] = s.p_root;
  state.qd = tree_velocity(s);
  return state;
}

Eigen::VectorXd tree_vector(const Vector3d& angular, const Vector3d& linear,
                            const PerBody<Vector3d>& joints) {
  Eigen::VectorXd out(kTreeDofs);
  out.segment<3>(0) = angular;
  out.segment<3>(3) = linear;
  int dof = 6;
  for (int i = 1; i < kBodies; ++i) {
    const Vector3d& x = joints[i];
    if (is_hinge(i)) {
      out(dof++) = hinge_axis(i).dot(x);
    } else {
      out.segment<3>(dof) = x;
      dof += 3;
    }
  }
  return out;
}

Eigen::VectorXd tree_velocity(const Snapshot& s) {
  return tree_vector(s.omega[0], s.q[0].conjugate() * s.v_root, s.omega);
}

Eigen::VectorXd tree_acceleration(const Snapshot& s, const Data<double>& d) {
  const Matrix3d R = s.q[0].toRotationMatrix();
  const BodyPoses poses = forward_kinematics(Character{}, s.p_root, s.q);
  PerBody<Vector3d> joints;
  for (int i = 0; i < kBodies; ++i) joints[i] = poses.q_WB[i].conjugate() * to_eigen(d.qdd[i]);
  // The spatial acceleration differs from the classical one by ω × v.                  RBDA §2.11
  return tree_vector(R.transpose() * to_eigen(d.a_w[0]),
                     R.transpose() * to_eigen(d.a_v[0]) - s.omega[0].cross(R.transpose() * s.v_root), joints);
}

Eigen::VectorXd tree_torque(const PerBody<Vec3<double>>& tau) {
  PerBody<Vector3d> joints;
  for (int i = 0; i < kBodies; ++i) joints[i] = to_eigen(tau[i]);
  return tree_vector(Vector3d::Zero(), Vector3d::Zero(), joints);
}

}  // namespace mimicx::physics
