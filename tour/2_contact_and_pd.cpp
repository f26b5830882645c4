// Stiff springs: a joint that is held by a PD controller, and a body that stands on a floor.
//
// You learn: why a stiff spring-damper explodes when its force is taken at the start of a step, and how the
// same spring at the end of the step becomes a number on the diagonal of D; that the floor is such springs.
// Belongs to: docs/physics.md §3, §4.
// Questions: 1. At which dt is the explicit joint just stable? Compare with 2 dt kd/I + dt² kp/I < 4.
//            2. Why does the body with its true gains fall although every joint is held?
//            3. Set the friction to 0. Which force remains while the body stands? Why does the body stand all
//            the same?
#include <cmath>

#include "physics/standing_state.h"
#include "physics/step.h"
#include "plot.h"
#include "trees/tree_dynamics.h"

using namespace mimicx;
using Eigen::VectorXd;

// The toes on the hinge at the ball of the foot.
trees::Tree toes_of(const Character& c) {
  trees::Tree tree;
  tree.gravity.setZero();
  tree.add(-1, Vector3d::Zero(), trees::hinge(Vector3d::UnitX()),
           {c.mass[kLeftFoot], c.com_B[kLeftFoot], c.inertia_B[kLeftFoot]});
  tree.body[0].armature = c.joint[kLeftFoot].armature;
  return tree;
}

// A joint is released 0.3 rad from its target. @return the angle after a second
double held_joint(trees::Tree tree, double kp, double kd, bool implicit, double dt, tour::Curve& curve) {
  if (implicit) tree.body[0].armature += dt * kd + dt * dt * kp;  // δ of (5)
  trees::TreeState state = trees::rest_state(tree);
  trees::set_position(tree, 0, 0.3, state);
  bool left = false;
  for (double t = 0.0; t < 1.0; t += dt) {
    const double phi = trees::position(tree, state, 0), omega = state.qd(0);
    const double tau = -kp * phi - (implicit ? kd + dt * kp : kd) * omega;
    if (!left && t < 0.3) tour::add(curve, t, phi);
    left = left || std::abs(phi) > 1.0;  // the first point out there is the last one drawn
    trees::integrate(tree, trees::forward_dynamics(tree, state, VectorXd::Constant(1, tau)), dt, state);
  }
  return trees::position(tree, state, 0);
}

struct Stance {
  double pelvis, load;  // at the end: height, m; the floor's force over the weight
};

// The standard body stands for `seconds` with its gains times `factor`, its targets those of the pose.
Stance stand(double factor, double seconds, tour::Curve& curve) {
  Character character = make_character();
  for (JointParameters& joint : character.joint) {
    joint.kp *= factor;
    joint.kd *= factor;
  }
  const physics::SimulationConfig config;
  const auto model = physics::make_model<double>(character, config);
  physics::State<double> x = physics::standing_state(character);
  const physics::Target<double> target = physics::target_at(x);
  static physics::Data<double> d;
  physics::Applied<double> applied;
  for (int k = 0; k < seconds * config.rate; ++k) {
    physics::clear(applied);
    if (physics::step(model, target, x, d, &applied)) break;  // the mask of what has gone wrong
    if (k % 8 == 0) tour::add(curve, k / config.rate, x.p_root.z);
  }
  double force = 0.0;
  for (const auto& wrench : applied.ground) force += wrench.f.z;
  return {x.p_root.z, force / (character.total_mass() * kGravity)};
}

int main() {
  tour::Curve explicit_curve = tour::line("force at the start of the step", 1, tour::Style::kLineAndDots);
  tour::Curve implicit_curve = tour::line("at the end of the step", 0, tour::Style::kLineAndDots);
  const Character body = make_character();
  const trees::Tree toes = toes_of(body);
  const double kp = body.joint[kLeftFoot].kp, kd = body.joint[kLeftFoot].kd;
  const double I = trees::mass_matrix(toes, trees::rest_state(toes))(0, 0);
  for (const double rate : {240.0, 2400.0}) {
    tour::Curve unused;
    const double dt = 1.0 / rate;
    const double start = held_joint(toes, kp, kd, false, dt, rate < 1000 ? explicit_curve : unused);
    const double end = held_joint(toes, kp, kd, true, dt, rate < 1000 ? implicit_curve : unused);
    std::printf("held joint at %4.0f Hz after 1 s: explicit %s, implicit %.4f rad; criterion %.1f < 4\n",
                rate, std::abs(start) < 0.1 ? "at rest" : "exploded", end, (2 * dt * kd + dt * dt * kp) / I);
  }
  tour::Curve true_curve = tour::line("true gains", 1);
  tour::Curve stiff_curve = tour::line("ten times as stiff", 0);
  const Stance soft = stand(1.0, 4.0, true_curve), stiff = stand(10.0, 4.0, stiff_curve);
  std::printf("true gains, 4 s: pelvis at %.2f m, the floor carries %.2f of the weight\n", soft.pelvis,
              soft.load);
  std::printf("ten times as stiff: pelvis at %.2f m, the floor carries %.2f of the weight\n", stiff.pelvis,
              stiff.load);
  const tour::Panel held = {
      "the ball of a foot at 240 Hz", "time, s", "angle, rad", {explicit_curve, implicit_curve}};
  const tour::Panel standing = {"a body without a policy", "time, s", "height of the pelvis, m",
                                {true_curve, stiff_curve}, false,     true};
  tour::save_picture("2_contact_and_pd", "A held joint, and a body that stands", {held, standing});
}
