// PD control, torque bounds and anatomical ranges inside the implicit scheme.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "character/joint_range.h"
#include "physics/contact_scenes.h"
#include "physics/joint_torques.h"
#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

constexpr int kKnee = kLeftKnee;

/// The left knee as an isolated oscillator: pelvis and thigh too heavy to move, no mass below the shank, no
/// gravity, no ranges.
struct KneeOscillator {
  Character character = make_character();
  SimulationConfig config;
  double inertia;  ///< of the shank about the knee's axis plus armature, kg·m²

  explicit KneeOscillator(double rate) {
    config.rate = rate;
    config.gravity = config.limit_stiffness = config.limit_damping = 0;
    config.self_contact = false;
    for (const int i : {kPelvis, kLeftHip}) {
      character.mass[i] = 1e12;
      character.inertia_B[i] = 1e12 * Matrix3d::Identity();
    }
    for (const int i : {kLeftAnkle, kLeftFoot}) {
      character.mass[i] = 0;
      character.inertia_B[i].setZero();
    }
    JointParameters& j = character.joint[kKnee];
    j.kp = 100;
    j.kd = 4;
    j.torque_limit = 1e9;
    const Vector3d axis = hinge_axis(kLeftKnee), d = character.com_B[kKnee];
    inertia = axis.dot(character.inertia_B[kKnee] * axis) +
              character.mass[kKnee] * d.cross(axis).squaredNorm() + j.armature;
  }
  Simulation<double> start(double angle, double speed) const {
    Snapshot s;
    s.p_root = {0, 0, 50};
    s.q.fill(Quaterniond::Identity());
    s.target_q = s.q;
    s.omega.fill(Vector3d::Zero());
    s.target_omega = s.omega;
    s.q[kKnee] = exp_map(angle * hinge_axis(kLeftKnee));
    s.omega[kKnee] = speed * hinge_axis(kLeftKnee);
    return Simulation<double>(character, config, s);
  }
};
double knee_angle(const Simulation<double>& s) {
  return hinge_axis(kLeftKnee).dot(log_map(lane_of(s.state.q[kKnee], 0)));
}

TEST(ImplicitPd, HingeFollowsImplicitEulerOfTheOscillator) {
  const KneeOscillator knee(240);
  const JointParameters& j = knee.character.joint[kKnee];
  Simulation<double> s = knee.start(0.5, 2.0);
  const double dt = 1.0 / knee.config.rate;
  double angle = 0.5, speed = 2.0;
  for (int k = 0; k < 240; ++k) {
    s.advance();
    // (I + dt kd + dt² kp) ω' = I ω − dt kp q: velocities and positions of the end of the step.
    speed = (knee.inertia * speed - dt * j.kp * angle) / (knee.inertia + dt * j.kd + dt * dt * j.kp);
    angle += dt * speed;
    ASSERT_NEAR(knee_angle(s), angle, 1e-9) << "step " << k;
  }
}

TEST(ImplicitPd, ConvergesToTheClosedFormOfTheDampedOscillator) {
  std::array<double, 3> error;
  for (std::size_t k = 0; k < error.size(); ++k) {
    const double rate = 600.0 * static_cast<double>(1 << (2 * k)), time = 0.25;
    const KneeOscillator knee(rate);
    Simulation<double> s = knee.start(0.5, 0.0);
    for (int n = 0; n < static_cast<int>(time * rate); ++n) s.advance();
    const double decay = 4.0 / (2 * knee.inertia), w = std::sqrt(100.0 / knee.inertia - decay * decay);
    const double exact =
        0.5 * std::exp(-decay * time) * (std::cos(w * time) + decay / w * std::sin(w * time));
    error[k] = std::abs(knee_angle(s) - exact);
  }
  EXPECT_LT(error[2], 1e-3);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.6);
  EXPECT_NEAR(error[1] / error[2], 4.0, 0.6);
}

TEST(ImplicitPd, VelocityFeedForwardTracksARampWithoutLag) {
  const KneeOscillator knee(240);
  Simulation<double> s = knee.start(0.0, 0.0);
  const double speed = 1.5;
  double angle = 0.0;
  for (int k = 0; k < 480; ++k) {
    angle = speed * (k + 1) / 240.0;  // the target is the angle at the end of the step
    set_lane(s.target.q[kKnee], 0, exp_map(angle * hinge_axis(kLeftKnee)));
    set_lane(s.target.omega[kKnee], 0, Vector3d(speed * hinge_axis(kLeftKnee)));
    s.advance();
    if (angle > 2.5) break;
  }
  EXPECT_NEAR(knee_angle(s), angle, 1e-6);
}

/// A pack of characters with new random, distant PD targets 30 times a second.
template <class Check>
void thrash(const Character& character, double rate, int passes, Check&& check) {
  using P = Pack<kLanes>;
  SimulationConfig config;
  config.rate = rate;
  config.passes = passes;
  const auto s = std::make_unique<Simulation<P>>(character, config);
  std::array<Snapshot, kLanes> start;
  for (int lane = 0; lane < kLanes; ++lane) {
    Random random(41, {static_cast<std::uint64_t>(lane)});
    start[lane] = random_snapshot(random, 1.0, 3.0, 1.0);
    set_lane(start[lane], lane, s->state, s->target);
  }
  const int interval = static_cast<int>(rate / 30.0);
  for (int k = 0; k < static_cast<int>(rate); ++k) {
    for (int lane = 0; k % interval == 0 && lane < kLanes; ++lane) {
      Random random(42, {static_cast<std::uint64_t>(lane), static_cast<std::uint64_t>(k)});
      for (int i = 1; i < kBodies; ++i) {
        const Vector3d turn = 0.4 * random_vector(random);
        const bool hinge = is_hinge(i);
        const Vector3d along = hinge ? Vector3d(turn.x() * hinge_axis(i)) : turn;
        set_lane(s->target.q[i], lane, start[lane].target_q[i] * exp_map(along));
      }
    }
    s->advance();
    check(*s);
  }
}

TEST(TorqueBound, IsNeverExceededUnderRandomTargets) {
  using P = Pack<kLanes>;
  for (double rate : {120.0, 240.0, 480.0})
    for (int passes : {1, 2, 3}) {
      double worst = 0;
      long saturated = 0, samples = 0;
      thrash(make_character(), rate, passes, [&](const Simulation<P>& s) {
        for (int i = 1; i < kBodies; ++i) {
          const Vec3<P> torque = applied_pd_torque(s.data, i);
          for (int lane = 0; lane < kLanes; ++lane) {
            const double share = lane_of(torque, lane).norm() / s.model.torque_limit[i];
            worst = std::max(worst, share);
            ++samples;
            saturated += share > 0.999;
          }
        }
      });
      std::printf("  measured: %.0f Hz, %d passes: %.1f %% of the joint steps at the bound\n", rate, passes,
                  100.0 * static_cast<double>(saturated) / static_cast<double>(samples));
      EXPECT_LE(worst, 1.0 + 1e-6) << rate << " Hz, " << passes << " passes";
      EXPECT_GT(saturated, samples / 50) << "the test must drive joints into their bounds";
    }
}

/// The standard body, all β at their maximum, all at their minimum, and a random one.
std::vector<Character> shapes() {
  Random random(43);
  std::array<double, kBetas> most, least;
  most.fill(3.0);
  least.fill(-3.0);
  std::vector<Character> all = {make_character(), make_character(most), make_character(least)};
  all.push_back(make_character(random_betas(random)));
  return all;
}

TEST(TorqueBound, HoldsForEveryShapeAtEveryRateAndScalesWithTheMass) {
  using P = Pack<kLanes>;
  const Character standard = make_character();
  for (const Character& character : shapes()) {
    for (int i = 1; i < kBodies; ++i)
      EXPECT_NEAR(character.joint[i].torque_limit / standard.joint[i].torque_limit,
                  character.total_mass() / standard.total_mass(), 1e-12);
    for (double rate : {120.0, 240.0, 480.0}) {
      double worst = 0;
      thrash(character, rate, 2, [&](const Simulation<P>& s) {
        for (int i = 1; i < kBodies; ++i)
          for (int lane = 0; lane < kLanes; ++lane)
            worst = std::max(
                worst, lane_of(applied_pd_torque(s.data, i), lane).norm() / character.joint[i].torque_limit);
      });
      EXPECT_LE(worst, 1.0 + 1e-6) << rate << " Hz, " << character.total_mass() << " kg";
      EXPECT_GT(worst, 0.99) << "the test must drive joints into their bounds";
    }
  }
}

// clamp(law) has the law's sign. A torque that was saturated for contacts which the last solve then moved may
// have the other one, and drive its joint like a motor.
TEST(TorqueBound, SaturatedTorquesDoNotOpposeTheLaw) {
  using P = Pack<kLanes>;
  const Character character = make_character();
  int returned = 0, opposed = 0, opposed_again = 0;
  for (std::uint64_t first = 0; first < 200; first += kLanes) {
    const auto s = std::make_unique<Simulation<P>>(character, SimulationConfig{});
    for (int lane = 0; lane < kLanes; ++lane)
      set_lane(snapshot_of(ContactScene::kDrop, character, first + static_cast<std::uint64_t>(lane)), lane,
               s->state, s->target);
    const auto count = [](const MaskOf<P>& mask) {
      int lanes = 0;
      for (int lane = 0; lane < kLanes; ++lane) lanes += ScalarTraits<P>::lane(mask, lane) ? 1 : 0;
      return lanes;
    };
    for (int k = 0; k < 144; ++k) {
      s->advance();
      const Data<P>& d = s->data;
      for (int i = 1; i < kBodies; ++i) {
        const Vec3<P> law = add_scaled(d.tau_pd[i], -d.delta_pd[i], d.qdd[i]);
        const MaskOf<P> reversed = dot(law, d.tau[i]) < P(0.0), opposes = reversed & d.saturated[i];
        returned += count(d.returned[i]);
        opposed += count(opposes & !d.returned[i]);
        opposed_again += count(opposes & d.returned[i]);
      }
    }
  }
  std::printf("  measured: %d returned to the law, %d of them saturated against it again\n", returned,
              opposed_again);
  EXPECT_EQ(opposed, 0);
  EXPECT_GT(returned, 10) << "the test must turn laws against their torques";
  EXPECT_LE(opposed_again, returned / 10);
}

// The bound would also hold for a controller without torque. Far from the bound the torque is the law's.
TEST(TorqueBound, LeavesUnsaturatedJointsToTheImplicitLaw) {
  const Character character = make_character();
  SimulationConfig config;
  Snapshot start = standing(character);
  start.target_q[kLeftShoulder] = start.q[kLeftShoulder] * exp_map(Vector3d(0, 0, 0.05));
  Simulation<double> s(character, config, start);
  s.advance();
  const JointParameters& j = character.joint[kLeftShoulder];
  const double dt = 1.0 / config.rate;
  Snapshot end;
  read_lane(s.state, 0, end);
  // The law at the end of the step, to first order: φ − dt ω.
  const Vector3d phi = log_map(start.q[kLeftShoulder].conjugate() * start.target_q[kLeftShoulder]);
  const Vector3d omega = end.omega[kLeftShoulder];
  const Vector3d expected = j.kp * (phi - dt * omega) - j.kd * omega;
  EXPECT_LT((lane_of(s.applied.joint_torque[kLeftShoulder], 0) - expected).norm(), 1e-9);
}

State<double> state_of(const Snapshot& s) {
  State<double> state;
  Target<double> target;
  set_lane(s, 0, state, target);
  return state;
}

// The spring of a joint at rest is its stiffness times the distance that fits and references are kept within.
TEST(JointRange, SpringPushesByTheDistanceFromTheRange) {
  Random random(11, {});
  const Character character = make_character(random_betas(random));
  const auto model = make_model<double>(character);
  int outside = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Snapshot s = random_snapshot(random, 1.2, 0.0, 2.0);
    const State<double> state = state_of(s);
    Data<double> d;
    update_kinematics(model, state, d);
    for (int b = 1; b < kBodies; ++b) {
      compute_range(model, state, b, d);
      const double excess = range_distance(character.joint[b], b, s.q[b]).excess;
      outside += excess > 0.0 ? 1 : 0;
      EXPECT_NEAR(norm(d.tau_range[b]), model.config.limit_stiffness * std::max(excess, 0.0), 1e-8) << b;
    }
  }
  EXPECT_GT(outside, 50);
}

/// The joint's rotation to the centre of its range and back, hinges about their axis.
Quaterniond range_centre(const JointParameters& j, int body) {
  return exp_map(is_hinge(body) ? Vector3d(j.centre.x() * hinge_axis(body)) : j.centre);
}

// docs/physics.md §3, "Range": the spring pushes against the gradient of g by 2 (x, y, z), and the damper
// resists the whole velocity of the joint.
TEST(JointRange, TorqueIsSpringAlongTheGradientAndDamperOfTheWholeVelocity) {
  Random random(12, {});
  const Character character = make_character();
  const auto model = make_model<double>(character);
  const double k = model.config.limit_stiffness, gain = model.config.limit_damping + model.dt * k;
  int outside = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Snapshot s = random_snapshot(random, 1.2, 3.0, 2.0);
    const BodyPoses poses = forward_kinematics(character, s.p_root, s.q);
    const State<double> moving = state_of(s);
    State<double> still = moving;
    for (auto& omega : still.omega) omega = zero3<double>();
    Data<double> d, at_rest;
    update_kinematics(model, moving, d);
    update_kinematics(model, still, at_rest);
    for (int b = 1; b < kBodies; ++b) {
      compute_range(model, moving, b, d);
      compute_range(model, still, b, at_rest);
      const Matrix3d R = poses.q_WB[b].toRotationMatrix();
      const Vector3d torque = to_eigen(d.tau_range[b]), spring = to_eigen(at_rest.tau_range[b]);
      const bool is_outside = spring.norm() > 1e-6;
      outside += is_outside ? 1 : 0;
      const Vector3d damper =
          is_outside ? Vector3d(-gain * (R * to_eigen(moving.omega[b]))) : Vector3d::Zero();
      EXPECT_LT((torque - spring - damper).norm(), 1e-9 * (1.0 + torque.norm())) << b;
      EXPECT_NEAR(d.delta_range[b], is_outside ? model.dt * gain : 0.0, 1e-12) << b;
      if (!is_outside || is_hinge(b)) continue;
      const JointParameters& j = character.joint[b];
      Quaterniond x = range_centre(j, b).conjugate() * s.q[b];
      if (x.w() < 0.0) x.coeffs() *= -1.0;
      const Vector3d half = 2.0 * (0.5 * j.half_range.array()).sin().matrix();
      const auto g = [&](const Vector3d& v) { return v.cwiseQuotient(half).norm(); };
      Vector3d gradient;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d step = 1e-6 * Vector3d::Unit(axis);
        gradient[axis] = (g(2.0 * x.vec() + step) - g(2.0 * x.vec() - step)) / 2e-6;
      }
      EXPECT_LT((spring.normalized() + R * gradient.normalized()).norm(), 1e-6) << b;
    }
  }
  EXPECT_GT(outside, 50);
}

/// Distance of a joint from its range ellipsoid, rad along the way to the centre; 0 inside.
double excess(const JointParameters& j, int body, const Quaterniond& q) {
  const Vector3d r = log_map(range_centre(j, body).conjugate() * q);
  const Vector3d inverse = (2.0 * (0.5 * j.half_range.array()).sin()).inverse().matrix();
  const auto outside = [&](double scale) {
    const Vector3d chord = 2.0 * std::sin(0.5 * scale * r.norm()) * r.normalized();
    return chord.cwiseProduct(inverse).norm() > 1.0;
  };
  if (!outside(1.0)) return 0.0;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) (outside(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  return (1.0 - low) * r.norm();
}

struct Excess {
  double largest;  ///< while the limb slams into the range
  double held;  ///< pressed against it: mean of the last half second, in which some joints hunt by 0.01 rad
};

/// Drives one joint from the centre of its range about `axis` with its full torque.
Excess drive(const Character& character, int body, const Vector3d& axis, double rate = 240.0) {
  SimulationConfig config;
  config.rate = rate;
  config.gravity = 0;
  config.self_contact = false;
  Snapshot s;
  s.p_root = {0, 0, 50};
  s.omega.fill(Vector3d::Zero());
  s.target_omega = s.omega;
  for (int b = 0; b < kBodies; ++b) s.q[b] = range_centre(character.joint[b], b);
  s.target_q = s.q;
  const auto i = static_cast<std::size_t>(body);
  s.target_q[i] = s.q[i] * exp_map(3.0 * axis);
  Simulation<double> simulation(character, config, s);
  Excess result{0, 0};
  const int steps = static_cast<int>(rate);
  for (int k = 0; k < steps; ++k) {
    simulation.advance();
    const double now = excess(character.joint[i], body, lane_of(simulation.state.q[i], 0));
    result.largest = std::max(result.largest, now);
    if (2 * k >= steps) result.held += 2.0 * now / steps;
  }
  return result;
}

/// Drives every joint against its range from all sides for a second. Its deflection is then (6) within the
/// relative `tolerance`; the free body still swings. @return the largest transient deflection, rad
double drive_all(const Character& character, double rate, double tolerance) {
  const SimulationConfig config;
  double largest = 0;
  for (int body = 1; body < kBodies; ++body)
    for (int direction = 0; direction < (is_hinge(body) ? 2 : 6); ++direction) {
      const double sign = direction % 2 ? 1.0 : -1.0;
      const Vector3d axis = sign * (is_hinge(body) ? hinge_axis(body) : Vector3d::Unit(direction / 2));
      const Excess e = drive(character, body, axis, rate);
      // The range is a spring on the chord 2 sin(θ/2), so on the angle it is cos(θ/2) times as stiff.
      const JointParameters& j = character.joint[body];
      const double half = j.half_range(is_hinge(body) ? 0 : direction / 2);
      const double give = j.torque_limit / (config.limit_stiffness * std::cos(0.5 * half));
      EXPECT_NEAR(e.held, give, tolerance * give) << kBodyNames[body] << " " << axis.transpose() << " at "
                                                  << rate << " Hz, " << character.total_mass() << " kg";
      largest = std::max(largest, e.largest);
    }
  return largest;
}

double degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

TEST(JointRange, HoldsAgainstTheFullTorqueOfItsJoint) {
  const double largest = drive_all(make_character(), 240.0, 0.12);
  std::printf("  measured: deepest slam into a range %.1f degrees\n", degrees(largest));
  EXPECT_LT(largest, 0.21);
}

// Torque bounds grow with the mass, the stiffness of ranges does not: a heavy body's joints deflect more, by
// (6).
TEST(JointRange, HoldsForEveryShapeAtEveryRate) {
  const double standard = make_character().total_mass();
  for (const Character& character : shapes())
    for (double rate : {120.0, 240.0, 480.0}) {
      const double largest = drive_all(character, rate, 0.2), strength = character.total_mass() / standard;
      std::printf("  measured: %.0f kg, %.0f Hz: deepest slam %.1f degrees\n", character.total_mass(), rate,
                  degrees(largest));
      EXPECT_LT(largest, 0.21 * std::max(strength, 1.0)) << rate << " Hz";
    }
}

}  // namespace
}  // namespace mimicx::physics
