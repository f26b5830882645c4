// Conservation laws of the whole system, for any joint torques and contacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "core/random_cases.h"
#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

/// Momentum of the whole about the world's origin (moment; linear), or its rate of change.
struct Momentum {
  Vector3d angular = Vector3d::Zero(), linear = Vector3d::Zero();
};

/// The bodies of one lane in its last solve.
template <class T>
struct Bodies {
  const Character& c;
  const Data<T>& d;
  int lane;
  Vector3d at(const PerBody<Vec3<T>>& x, int i) const { return lane_of(x[i], lane); }
  Matrix3d R(int i) const { return lane_of(d.q_WB[i], lane).normalized().toRotationMatrix(); }
  Vector3d com_arm(int i) const { return R(i) * c.com_B[i]; }
  Vector3d com(int i) const { return at(d.p_WB, i) + com_arm(i); }
  Matrix3d inertia(int i) const { return R(i) * c.inertia_B[i] * R(i).transpose(); }
};

template <class T>
Momentum momentum(const Bodies<T>& b) {
  Momentum sum;
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d w = b.at(b.d.w, i), p = b.c.mass[i] * (b.at(b.d.v, i) + w.cross(b.com_arm(i)));
    sum.linear += p;
    sum.angular += b.inertia(i) * w + b.com(i).cross(p);
  }
  return sum;
}

template <class T>
Momentum momentum_rate(const Bodies<T>& b) {
  Momentum sum;
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d w = b.at(b.d.w, i), alpha = b.at(b.d.a_w, i), arm = b.com_arm(i);
    const Vector3d f = b.c.mass[i] * (b.at(b.d.a_v, i) + alpha.cross(arm) + w.cross(w.cross(arm)));
    sum.linear += f;
    sum.angular += b.inertia(i) * alpha + w.cross(b.inertia(i) * w) + b.com(i).cross(f);
  }
  return sum;
}

template <class T>
Momentum external(const Bodies<T>& b, const PerBody<Wrench<T>>& ground, double gravity) {
  Momentum sum;
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d weight(0, 0, -gravity * b.c.mass[i]), f = lane_of(ground[i].f, b.lane);
    sum.linear += weight + f;
    sum.angular += b.com(i).cross(weight) + lane_of(ground[i].n, b.lane) + b.at(b.d.p_WB, i).cross(f);
  }
  return sum;
}

/// A violent second: the largest mismatch between the rate of momentum and the external forces, relative to
/// the largest rate so far, the largest rate, and the largest self-contact force.
struct Audit {
  double mismatch = 0, rate = 0, self_force = 0;
};
template <class T>
Audit audit_momentum(std::uint64_t trial) {
  Random random(31, {trial});
  const Character character = make_character(random_betas(random));
  const auto s =
      std::make_unique<Simulation<T>>(character, SimulationConfig{}, random_snapshot(random, 1.5, 4.0, 0.9));
  Audit audit;
  double linear = 0, angular = 0;
  for (int k = 0; k < 240; ++k) {
    s->advance();
    const Bodies<T> bodies{character, s->data, 0};
    const Momentum rate = momentum_rate(bodies);
    const Momentum forces = external(bodies, s->applied.ground, s->model.config.gravity);
    linear = std::max(linear, rate.linear.norm());
    angular = std::max(angular, rate.angular.norm());
    audit.mismatch = std::max({audit.mismatch, (rate.linear - forces.linear).norm() / linear,
                               (rate.angular - forces.angular).norm() / angular});
    for (const Wrench<T>& w : s->applied.self)
      audit.self_force = std::max(audit.self_force, lane_of(w.f, 0).norm());
  }
  audit.rate = linear;
  return audit;
}

// Where a hand strikes, friction resists like up to 2 t beside the hand's half a kilogram: of the seven
// digits of single precision three are left there.
TEST(Step, MomentumChangesByGravityAndRecordedGroundForcesAlone) {
  const int trials = test::random_cases(60);
  double sum = 0, largest = 0, self_force = 0;
  int impacts = 0;
  for (std::uint64_t trial = 0; trial < static_cast<std::uint64_t>(trials); ++trial) {
    const Audit exact = audit_momentum<double>(trial), packed = audit_momentum<Pack<8>>(trial);
    EXPECT_LT(exact.mismatch, 1e-9) << trial;
    sum += packed.mismatch;
    largest = std::max(largest, packed.mismatch);
    impacts += exact.rate > 2000.0;
    self_force = std::max(self_force, exact.self_force);
  }
  std::printf("  measured: in single precision %.1e in the mean of %d falls, %.1e at most\n", sum / trials,
              trials, largest);
  EXPECT_LT(sum / trials, 2e-3);
  EXPECT_LT(largest, 5e-2);
  EXPECT_GT(impacts, trials / 2);
  EXPECT_GT(self_force, 100.0) << "self contact took no part";
}

/// Momentum of positions and velocities alone, by forward kinematics in plain doubles.
Momentum momentum(const Character& c, const Snapshot& s) {
  const BodyPoses poses = forward_kinematics(c, s.p_root, s.q);
  PerBody<Vector3d> w, v;
  Momentum sum;
  for (int i = 0; i < kBodies; ++i) {
    w[i] = poses.q_WB[i] * s.omega[i];
    v[i] = s.v_root;
    if (i > 0) {
      const int lambda = kParents[i];
      w[i] += w[lambda];
      v[i] = v[lambda] + w[lambda].cross(poses.p_WB[i] - poses.p_WB[lambda]);
    }
    const Vector3d arm = poses.q_WB[i] * c.com_B[i], p = c.mass[i] * (v[i] + w[i].cross(arm));
    sum.linear += p;
    sum.angular += poses.q_WB[i] * (c.inertia_B[i] * (poses.q_WB[i].conjugate() * w[i])) +
                   (poses.p_WB[i] + arm).cross(p);
  }
  return sum;
}

/// Rate of change of momentum at constant velocity coordinates: differences of positions along the
/// velocities.
Momentum drift(const Character& c, const Snapshot& s) {
  constexpr double h = 3e-6;
  const auto moved = [&](double t) {
    Snapshot m = s;
    m.p_root += t * s.v_root;
    for (int i = 0; i < kBodies; ++i) m.q[i] = s.q[i].normalized() * exp_map(t * s.omega[i]);
    return momentum(c, m);
  };
  const Momentum after = moved(h), before = moved(-h);
  return {(after.angular - before.angular) / (2 * h), (after.linear - before.linear) / (2 * h)};
}

// Uses the states and the recorded contact forces, no accelerations of the solver: the change of momentum by
// the new velocities and by the motion of positions equals the impulses of weight and floor.
TEST(Step, MomentumOfTheStatesChangesByTheImpulsesOfWeightAndFloor) {
  double hardest = 0;
  for (std::uint64_t trial = 0; trial < 6; ++trial) {
    Random random(34, {trial});
    const Character c = make_character(random_betas(random));
    Simulation<double> s(c, {}, random_snapshot(random, 1.5, 4.0, 0.9));
    const double dt = s.model.dt;
    Snapshot before, after;
    for (int k = 0; k < 240; ++k) {
      read_lane(s.state, 0, before);
      s.advance();
      read_lane(s.state, 0, after);
      after.p_root = before.p_root;
      after.q = before.q;
      const Momentum h = momentum(c, before), h_next = momentum(c, after), moving = drift(c, before);
      const Momentum f = external(Bodies<double>{c, s.data, 0}, s.applied.ground, s.model.config.gravity);
      const Vector3d linear = h_next.linear - h.linear + dt * (moving.linear - f.linear);
      const Vector3d angular = h_next.angular - h.angular + dt * (moving.angular - f.angular);
      const double scale = dt * std::max(1000.0, f.linear.norm());  // N·s and N·m·s: a body is 1 m long
      hardest = std::max(hardest, f.linear.norm());
      ASSERT_LT(linear.norm(), 1e-7 * scale) << "trial " << trial << " step " << k;
      ASSERT_LT(angular.norm(), 1e-7 * scale) << "trial " << trial << " step " << k;
    }
  }
  EXPECT_GT(hardest, 5000.0) << "no impact";
}

// Newton–Euler with the recorded wrenches as external forces must reproduce the recorded joint torques, and
// zero at the pelvis: this checks every exported quantity against the motion, joint by joint.
TEST(Step, RneaWithRecordedWrenchesGivesTheRecordedTorques) {
  for (std::uint64_t trial = 0; trial < 6; ++trial) {
    Random random(32, {trial});
    const Character character = make_character(random_betas(random));
    Simulation<double> s(character, {}, random_snapshot(random, 1.5, 4.0, 0.9));
    const trees::Tree tree = trees::humanoid(character, s.model.config.gravity);
    for (int k = 0; k < 240; ++k) {
      Snapshot before;
      read_lane(s.state, 0, before);
      s.advance();
      trees::TreeForces forces(kBodies);
      for (int i = 0; i < kBodies; ++i) {
        forces[i].head<3>() = lane_of(s.applied.ground[i].n, 0) + lane_of(s.applied.self[i].n, 0);
        forces[i].tail<3>() = lane_of(s.applied.ground[i].f, 0) + lane_of(s.applied.self[i].f, 0);
      }
      const Eigen::VectorXd expected = tree_torque(s.applied.joint_torque);
      const Eigen::VectorXd tau =
          trees::inverse_dynamics(tree, tree_state(before), tree_acceleration(before, s.data), forces);
      double scale = 100.0;  // N·m; impacts are much larger
      for (const Vector6d& f : forces) scale = std::max(scale, f.norm());
      ASSERT_LT((tau - expected).cwiseAbs().maxCoeff(), 1e-9 * scale) << "trial " << trial << " step " << k;
    }
  }
}

/// A character of limp joints in free flight: no PD, no ranges, the floor out of reach.
Character limp() {
  Character c = make_character();
  for (JointParameters& j : c.joint) j.kp = j.kd = 0;
  return c;
}
SimulationConfig flight(double rate) {
  SimulationConfig o;
  o.rate = rate;
  o.limit_stiffness = o.limit_damping = 0;
  o.self_contact = false;
  return o;
}

/// Kinetic (armature included) and potential energy of a state.
double mechanical_energy(const Character& c, Simulation<double>& s) {
  update_kinematics(s.model, s.state, s.data);
  const Bodies<double> b{c, s.data, 0};
  double sum = 0;
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d w = b.at(s.data.w, i), v = b.at(s.data.v, i) + w.cross(b.com_arm(i));
    sum += 0.5 * c.mass[i] * v.squaredNorm() + 0.5 * w.dot(b.inertia(i) * w) +
           c.mass[i] * s.model.config.gravity * b.com(i).z();
    if (i > 0) sum += 0.5 * c.joint[i].armature * lane_of(s.state.omega[i], 0).squaredNorm();
  }
  return sum;
}

TEST(Step, FreeTumbleEnergyErrorIsOfFirstOrderInTheTimeStep) {
  const Character c = limp();
  Random random(33);
  const Snapshot start = random_snapshot(random, 0.8, 2.0, 100.0);
  std::array<double, 4> error;
  for (std::size_t k = 0; k < error.size(); ++k) {
    const double rate = 480.0 * static_cast<double>(1 << k);
    Simulation<double> s(c, flight(rate), start);
    const double before = mechanical_energy(c, s);
    for (int n = 0; n < static_cast<int>(0.5 * rate); ++n) s.advance();
    error[k] = mechanical_energy(c, s) - before;
  }
  std::printf("  measured: energy error after 0.5 s at 480, 960, 1920, 3840 Hz: %.3f %.3f %.3f %.3f J\n",
              error[0], error[1], error[2], error[3]);
  for (std::size_t k = 1; k < error.size(); ++k) {
    EXPECT_GT(error[k - 1] / error[k], 1.7) << "halving " << k;
    EXPECT_LT(error[k - 1] / error[k], 2.6) << "halving " << k;
  }
  EXPECT_LT(std::abs(error.back()), 2.0);  // J, of several hundred
}

TEST(Step, FreeFallConservesAngularMomentum) {
  const Character c = make_character();  // PD and ranges at work: internal torques must not matter
  Random random(34);
  const Snapshot start = random_snapshot(random, 0.8, 1.0, 100.0);
  std::array<double, 3> drift;
  for (std::size_t k = 0; k < drift.size(); ++k) {
    const double rate = 240.0 * static_cast<double>(1 << (2 * k));
    SimulationConfig config;
    config.rate = rate;
    config.gravity = 0.0;
    Simulation<double> s(c, config, start);
    update_kinematics(s.model, s.state, s.data);
    const Momentum before = momentum(Bodies<double>{c, s.data, 0});
    double worst = 0;
    for (int n = 0; n < static_cast<int>(rate); ++n) {
      s.advance();
      const Momentum rate_of = momentum_rate(Bodies<double>{c, s.data, 0});
      worst = std::max(worst, rate_of.angular.norm() / (before.angular.norm() * rate));
    }
    EXPECT_LT(worst, 1e-9);  // the continuous law holds in every step ...
    update_kinematics(s.model, s.state, s.data);
    drift[k] =
        (momentum(Bodies<double>{c, s.data, 0}).angular - before.angular).norm() / before.angular.norm();
  }
  EXPECT_LT(drift[0], 0.1);  // ... and the integrator keeps it to its order
  EXPECT_GT(drift[0] / drift[1], 3.0);
  EXPECT_GT(drift[1] / drift[2], 3.0);
}

}  // namespace
}  // namespace mimicx::physics
