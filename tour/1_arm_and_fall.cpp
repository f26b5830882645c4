// Bodies and joints: a pendulum and a two-link arm against their closed forms, then the humanoid in free
// fall, in double and in the lanes of a pack.
//
// You learn: that one algorithm computes every tree of bodies; what is conserved only as dt → 0, and how
// fast; that "double" and "eight characters in float" are one program.
// Belongs to: docs/trees.md §1, §2; docs/physics.md §1, §2, §6.
// Questions: 1. By what factor does the period's error fall when dt is halved? Why by that?
//            2. By what factor do the errors of momentum and energy grow when dt is ten times as long? Why?
//            3. Give the fall one heavy arm (character.mass[kLeftElbow] *= 10). Which numbers change?
#include <cmath>

#include "control/cost/centroidal_momentum.h"
#include "energy.h"
#include "physics/standing_state.h"
#include "physics/step.h"
#include "plot.h"

using namespace mimicx;

// The time from rest at `angle` to rest on the other side and back, by simulation.
double period(const trees::Tree& pendulum, double angle, double dt, tour::Curve& curve) {
  trees::TreeState state = trees::rest_state(pendulum);
  trees::set_position(pendulum, 0, angle, state);
  double turned_at = 0.0, before = 0.0;
  for (double t = 0.0, turns = 0; turns < 2; t += dt) {
    trees::integrate(pendulum, trees::forward_dynamics(pendulum, state, trees::VectorXd::Zero(1)), dt, state);
    tour::add(curve, t + dt, trees::position(pendulum, state, 0));
    if (before * state.qd(0) < 0.0) {  // it turns round: between the last two steps
      turned_at = t + dt * before / (before - state.qd(0));
      ++turns;
    }
    before = state.qd(0);
  }
  return turned_at;
}

int main() {
  // A rod of 1 m. Its period is 4 √(I / m g l) K(sin(θ/2)), K the complete elliptic integral.
  trees::Tree pendulum;
  const Vector3d y(0, 1, 0), tip(0, 0, -1);
  const trees::RigidBody rod = {1.0, 0.5 * tip, Vector3d(1.0 / 12, 1.0 / 12, 0).asDiagonal()};
  pendulum.add(-1, Vector3d::Zero(), trees::hinge(y), rod);
  tour::Curve small = tour::line("from 10°", 0), large = tour::line("from 150°", 1);
  for (const double degrees : {10.0, 150.0}) {
    const double angle = degrees * M_PI / 180;
    const double exact = 4 * std::sqrt(2.0 / 3 / kGravity) * std::comp_ellint_1(std::sin(angle / 2));
    tour::Curve unused;
    std::printf("pendulum from %3.0f°: period %.4f s; simulated %.4f s (dt 20 ms), %.4f s (dt 10 ms)\n",
                degrees, exact, period(pendulum, angle, 0.02, unused),
                period(pendulum, angle, 0.01, degrees < 90 ? small : large));
  }

  // Two such rods: H of the textbooks is [5/3 + cos q₂, 1/3 + cos q₂/2; ·, 1/3].
  trees::Tree arm = pendulum;
  arm.add(0, tip, trees::hinge(y), rod);
  trees::TreeState bent = trees::rest_state(arm);
  trees::set_position(arm, 1, 1.0, bent);
  Eigen::Matrix2d H;
  const double c = std::cos(1.0);
  H << 5.0 / 3 + c, 1.0 / 3 + c / 2, 1.0 / 3 + c / 2, 1.0 / 3;
  std::printf("two-link arm: mass matrix differs from the closed form by %.0e\n",
              std::ceil((trees::mass_matrix(arm, bent) - H).norm() / 1e-14) * 1e-14);

  // The humanoid falls for half a second, limp and turning.
  Character character = make_character();
  for (JointParameters& joint : character.joint) joint.kp = joint.kd = 0.0;
  const physics::SimulationConfig config = {.rate = 960};
  const auto model = physics::make_model<double>(character, config);
  physics::State<double> x = physics::standing_state(character);
  x.p_root.z += 5.0;
  x.omega[kPelvis] = {1.0, 2.0, 0.5};
  x.omega[kSpine1] = {0.3, 0.2, -0.3};
  const physics::Target<double> target = physics::target_at(x);
  using Lanes = physics::Pack<physics::kLanes>;
  const auto lane_model = physics::make_model<float>(character, config);
  auto lanes = physics::in_all_lanes<Lanes>(x);
  const auto lane_target = physics::in_all_lanes<Lanes>(target);
  static physics::Data<double> d;  // large: not on the stack
  static physics::Data<Lanes> lane_d;
  const auto momentum = [&] {
    return physics::update_kinematics(model, x, d), control::centroidal_momentum(model, d);
  };
  const trees::Tree tree = trees::humanoid(character, kGravity);
  const auto before = momentum();
  const double energy = tour::energy_of(tree, x);
  for (int k = 0; k < config.rate / 2; ++k) {
    physics::step(model, target, x, d);
    physics::step(lane_model, lane_target, lanes, lane_d);
  }
  const auto after = momentum();
  const double spin = norm(after.angular - before.angular) / norm(before.angular);
  const double speed = before.linear.z - after.linear.z;
  std::printf("free fall of 0.5 s: %.4f m/s, g t = %.4f m/s\n", speed, kGravity / 2);
  std::printf("angular momentum: changed by %.2f %%; energy: by %.2f J of %.0f J\n", 100 * spin,
              tour::energy_of(tree, x) - energy, energy);
  const double apart = 1e6 * (physics::lane_of(lanes.p_root, 3) - to_eigen(x.p_root)).norm();
  std::printf("lane 3 of %d, in float: pelvis %.1f micrometres apart\n", physics::kLanes, apart);
  tour::save_picture("1_arm_and_fall", "A pendulum from 10 and from 150 degrees",
                     {{"one period of a rod", "time, s", "angle, rad", {small, large}}});
}
