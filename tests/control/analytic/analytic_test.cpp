// Analytic derivatives of a control frame: against the chain rule through the simulator's own sources,
// against differences in double, and as predictions of changed motions.
#include "control/analytic/analytic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>

#include "control/analytic/rotation_derivatives.h"
#include "control/frame_oracle.h"
#include "core/random.h"
#include "physics/control_interval.h"
#include "physics/lanes.h"
#include "physics/test_states.h"

namespace mimicx::control {
namespace {

/// A frame that starts at a snapshot and aims at its target, turned by random residuals of about `size` rad.
ControlFrame frame_of(const Snapshot& s, Random& random, double size) {
  ControlFrame frame;
  set_lane(s, 0, frame.start, frame.from);
  frame.to = frame.from;
  for (int k = 0; k < kDofs; ++k) {
    frame.from_residual[k] = size * random.normal();
    frame.to_residual[k] = size * random.normal();
  }
  return frame;
}

/// Upright with the soles in the floor, every joint moving by about `spin` rad/s, the whole by `v` m/s.
ControlFrame on_the_floor(const Character& character, Random& random, double spin, const Vector3d& v) {
  Snapshot s = standing(character);
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d w = spin * random_vector(random);
    s.omega[i] = is_hinge(i) ? Vector3d(w.x() * hinge_axis(i)) : w;
  }
  s.v_root = v;
  s.p_root.z() -= 0.002;
  return frame_of(s, random, 0.05);
}

/// Counts of events over the steps of a frame.
struct Census {
  int pushing_bodies = 0, saturated = 0, outside_range = 0, self_pairs = 0, repeated_solves = 0;
};

/// The derivative in double, with its tables.
struct Derived {
  std::unique_ptr<FrameScratch<double>> scratch = std::make_unique<FrameScratch<double>>();
  FrameDerivative<double> derivative;

  Derived(const Model<double>& model, const ControlFrame& frame) {
    differentiate_frame(model, frame, true, *scratch, derivative);
  }
  Census census(int passes) const {
    Census c;
    for (const SubstepTable<double>& step : scratch->substeps) {
      for (int k = 0; k < step.solve_count; ++k) {
        c.pushing_bodies += static_cast<int>(step.solve(k).floor.size());
        c.saturated += static_cast<int>(step.solve(k).saturated.size());
      }
      for (const LawTable<double>& law : step.law) c.outside_range += law.range_damping > 0.0 ? 1 : 0;
      c.self_pairs += static_cast<int>(step.pairs.size());
      c.repeated_solves += std::max(0, step.solve_count - passes);
    }
    return c;
  }
};

/// Largest relative error of a column of F, positions and velocities separately. Small columns are compared
/// with a hundredth of the usual norm of their kind.
double worst_error(const Eigen::MatrixXd& F, const Eigen::MatrixXd& oracle) {
  double worst = 0.0;
  for (int half = 0; half < 2; ++half)
    for (int k = 0; k < F.cols(); ++k) {
      const double least = k >= kFrameColumns ? 1e-4 : half == 0 ? 1e-2 : 0.3;
      const auto column = F.col(k).segment(kPositions * half, kPositions);
      const auto expected = oracle.col(k).segment(kPositions * half, kPositions);
      worst = std::max(worst, (column - expected).norm() / std::max(expected.norm(), least));
    }
  return worst;
}

/// Expects both oracles to agree with the derivative, and prints the differences.
Census expect_exact(const char* name, const Model<double>& model, const ControlFrame& frame,
                    double h = 2e-6) {
  const Derived d(model, frame);
  EXPECT_FALSE(d.derivative.wrong);
  const Eigen::MatrixXd F = d.derivative.F;
  const double exact = worst_error(F, exact_derivative(model, frame));
  const double differences = worst_error(F, central_differences(model, frame, h));
  std::printf("  %-16s chain rule %.0e, differences %.0e\n", name, exact, differences);
  EXPECT_LT(exact, 1e-9) << name;
  EXPECT_LT(differences, 1e-6) << name;
  return d.census(model.config.passes);
}

TEST(AnalyticDerivative, IsExactInTheAir) {
  Random random(1);
  const Model<double> model = make_model<double>(make_character());
  for (int trial = 0; trial < 3; ++trial) {
    const Snapshot s = random_snapshot(random, 0.5, 1.0, 3.0);
    const Census c = expect_exact("in the air", model, frame_of(s, random, 0.05));
    EXPECT_EQ(c.pushing_bodies, 0);
  }
}

TEST(AnalyticDerivative, IsExactUnderFloorContact) {
  Random random(2);
  const Character character = make_character();
  const Model<double> model = make_model<double>(character);
  for (const double speed : {0.0, 0.3, 1.0}) {  // standing; feet that slide
    const Census c = expect_exact(speed > 0.0 ? "sliding" : "standing", model,
                                  on_the_floor(character, random, 0.5 * speed, {speed, 0.3 * speed, 0.0}));
    EXPECT_GT(c.pushing_bodies, 8);
  }
}

// On a wooden and on a soft plate; sunk so far that the push no longer grows with the depth.
TEST(AnalyticDerivative, IsExactOnPlatesAndBeyondTheirLargestPush) {
  Random random(31);
  const Character character = make_character();
  const Model<double> model = make_model<double>(
      character, {}, {{{{-5.0, 0.0}, 0.0, {5.0, 9.0}, 0.3}, {{5.0, 0.0}, 0.0, {5.0, 9.0}, 0.3, 8e4, 900.0}}});
  for (const double depth : {0.0, 0.025, 0.055}) {  // one foot on each
    ControlFrame frame = on_the_floor(character, random, 0.2, {0.3, 0.1, 0.0});
    frame.start.p_root.z += 0.3 - depth;
    const Census c = expect_exact(depth > 0.0 ? "sunk in plates" : "on plates", model, frame);
    EXPECT_GT(c.pushing_bodies, 8);
    const auto capped = [&](int body) {
      Data<double> d;
      solve_accelerations(model, frame.from, frame.start, d);
      return std::any_of(d.ground.begin(), d.ground.begin() + d.ground_count, [&](const auto& contact) {
        return model.contacts[contact.index].body == body && contact.surface.capped;
      });
    };
    EXPECT_EQ(capped(kRightAnkle), depth > 0.02);  // at x < 0, on wood
    EXPECT_EQ(capped(kLeftAnkle), depth > 0.05);
  }
}

TEST(AnalyticDerivative, IsExactDuringALanding) {
  Random random(3);
  const Character character = make_character();
  const Model<double> model = make_model<double>(character);
  for (int trial = 0; trial < 2; ++trial) {
    ControlFrame frame = on_the_floor(character, random, 1.0, {1.0, 0.1, -0.4});
    frame.start.p_root.z += 0.006;
    const Derived d(model, frame);
    EXPECT_TRUE(d.scratch->substeps.front().solve(0).floor.empty());
    EXPECT_GT(expect_exact("landing", model, frame).pushing_bodies, 0);
  }
}

TEST(AnalyticDerivative, IsExactAtTorqueBounds) {
  Random random(4);
  const Model<double> model = make_model<double>(make_character());
  int repeated = 0;
  for (int trial = 0; trial < 4; ++trial) {
    const Snapshot s = random_snapshot(random, 1.0, 3.0, 3.0);
    const Census c = expect_exact("bounds", model, frame_of(s, random, 0.8));
    EXPECT_GT(c.saturated, 40);
    repeated += c.repeated_solves;
  }
  EXPECT_GT(repeated, 0) << "no joint exceeded its bound after the last pass";
}

TEST(AnalyticDerivative, IsExactOutsideTheRanges) {
  Random random(5);
  const Character character = make_character();
  const Model<double> model = make_model<double>(character);
  Snapshot s = random_snapshot(random, 0.3, 0.5, 3.0);
  s.q[kLeftKnee] = exp_map(-0.3 * hinge_axis(kLeftKnee));  // bent the wrong way
  s.q[kRightHip] = exp_map(Vector3d(1.2, 0.4, 0.2));
  s.q[kHead] = exp_map(Vector3d(0.3, 1.3, 0.1));
  const ControlFrame frame = frame_of(s, random, 0.05);
  Data<double> data;
  State<double> x = frame.start;
  step(model, frame.from, x, data);
  for (int body : {kLeftKnee, kRightHip, kHead}) EXPECT_GT(data.delta_range[body], 0.0) << body;
  expect_exact("out of range", model, frame);
}

TEST(AnalyticDerivative, IsExactInSelfContact) {
  Random random(16);
  const Model<double> model = make_model<double>(make_character());
  int frames = 0;
  for (int trial = 0; trial < 200 && frames < 4; ++trial) {
    const ControlFrame frame = frame_of(random_snapshot(random, 1.6, 1.0, 3.0), random, 0.1);
    if (Derived(model, frame).census(model.config.passes).self_pairs < 8) continue;
    expect_exact("self contact", model, frame);
    ++frames;
  }
  EXPECT_EQ(frames, 4);
}

TEST(AnalyticDerivative, IsExactUnderAssistiveForces) {
  Random random(17);
  const Character character = make_character();
  const Model<double> model = make_model<double>(character);
  ControlFrame frame = on_the_floor(character, random, 0.5, {0.5, 0.0, 0.0});
  frame.assistance = {{20.0, -15.0, 10.0}, {50.0, 80.0, -120.0}};
  expect_exact("help", model, frame);
}

TEST(AnalyticDerivative, IsExactForOtherShapesRatesAndPasses) {
  Random random(8);
  for (const int passes : {1, 3}) {
    const Character character = make_character(random_betas(random));
    SimulationConfig options;
    options.passes = passes;
    options.rate = passes == 1 ? 480.0 : 120.0;
    const Model<double> model = make_model<double>(character, options);
    ControlFrame frame = on_the_floor(character, random, 0.5, {0.4, 0.2, -0.1});
    frame.substeps = passes == 1 ? 16 : 4;
    expect_exact(passes == 1 ? "one pass" : "three passes", model, frame);
    expect_exact("thrown", model, frame_of(random_snapshot(random, 0.5, 3.0, 3.0), random, 0.4));
  }
}

TEST(AnalyticDerivative, NominalMotionMatchesTheSimulator) {
  Random random(9);
  const Model<double> model = make_model<double>(make_character());
  for (int trial = 0; trial < 4; ++trial) {
    ControlFrame frame = frame_of(random_snapshot(random, 1.5, 2.0, 0.9), random, 0.3);
    frame.assistance.f.z = 100.0;
    Target<double> from = frame.from, to = frame.to;
    for (int i = 1; i < kBodies; ++i) {
      const auto turned = [&](const Quat<double>& q, const Array<double, kDofs>& r) {
        return from_eigen(
            residual_target(to_eigen(q), action_rotation(i, 10.0, [&](int k) { return r[k]; })));
      };
      from.q[i] = turned(frame.from.q[i], frame.from_residual);
      to.q[i] = turned(frame.to.q[i], frame.to_residual);
    }
    State<double> x = frame.start;
    Data<double> data;
    advance_interval<double>(model, {from, to, frame.substeps, &frame.assistance}, x, data);
    const Tangent<double> apart = difference(Derived(model, frame).derivative.end, x);
    for (double a : apart) EXPECT_LT(std::abs(a), 1e-9);
  }
}

TEST(AnalyticDerivative, FloatLanesAgreeWithDouble) {
  Random random(10);
  const Character character = make_character();
  const Model<double> model = make_model<double>(character);
  const auto scratch = std::make_unique<FrameScratch<Pack<kLanes>>>();
  FrameDerivative<Pack<kLanes>> lanes;
  for (const double height : {0.0, 0.5}) {
    ControlFrame frame = on_the_floor(character, random, 0.5, {0.3, 0.1, 0.0});
    frame.start.p_root.z += height;
    differentiate_frame(model, frame, false, *scratch, lanes);
    const Eigen::MatrixXd exact = Derived(model, frame).derivative.F.leftCols<kFrameColumns>();
    const double error = worst_error(lanes.F.cast<double>(), exact);
    std::printf("  float, %s: %.0e\n", height > 0.0 ? "in the air" : "on the floor", error);
    EXPECT_LT(error, 2e-4);
  }
}

TEST(AnalyticDerivative, ResultIgnoresTheOldContentOfTheScratch) {
  Random random(11);
  const Character character = make_character();
  const Model<double> model = make_model<double>(character);
  using P = Pack<kLanes>;
  const ControlFrame calm = on_the_floor(character, random, 0.3, {0.2, 0.0, 0.0});
  const ControlFrame wild = frame_of(random_snapshot(random, 2.0, 4.0, 0.5), random, 0.5);
  FrameDerivative<P> fresh, again;
  differentiate_frame(model, calm, true, *std::make_unique<FrameScratch<P>>(), fresh);
  const auto used = std::make_unique<FrameScratch<P>>();
  differentiate_frame(model, wild, true, *used, again);
  differentiate_frame(model, calm, true, *used, again);
  EXPECT_EQ(0, std::memcmp(fresh.F.data(), again.F.data(),
                           sizeof(float) * static_cast<std::size_t>(fresh.F.size())));
  differentiate_frame(model, calm, false, *used, again);
  ASSERT_EQ(again.F.cols(), kFrameColumns);
  EXPECT_TRUE(again.F == fresh.F.leftCols<kFrameColumns>());
}

TEST(AnalyticDerivative, FlagsRunawayMotionsAndRejectsFramesWithoutSteps) {
  Random random(12);
  const Model<double> model = make_model<double>(make_character());
  ControlFrame frame = frame_of(random_snapshot(random, 0.5, 1.0, 3.0), random, 0.0);
  frame.start.v_root.x = 200.0;
  EXPECT_TRUE(Derived(model, frame).derivative.wrong);
  frame.substeps = 0;
  EXPECT_THROW(Derived(model, frame), std::invalid_argument);
}

// Predictions are right to first order: half the change gives a quarter of the error.
TEST(AnalyticDerivative, PredictsChangesToFirstOrder) {
  Random random(13);
  const Character character = make_character();
  const Model<double> model = make_model<double>(character);
  const ControlFrame frame = frame_of(random_snapshot(random, 0.5, 1.0, 3.0), random, 0.05);
  const Derived d(model, frame);
  Eigen::VectorXd direction(kTangent);
  for (double& x : direction) x = random.normal();
  const auto missed = [&](double size) {
    Tangent<double> delta;
    Eigen::Map<Eigen::VectorXd>(delta.data(), kTangent) = size * direction;
    ControlFrame moved = frame;
    retract(moved.start, delta);
    const Tangent<double> change = difference(Derived(model, moved).derivative.end, d.derivative.end);
    const Eigen::VectorXd predicted = d.derivative.F.leftCols(kTangent) * (size * direction);
    return (Eigen::Map<const Eigen::VectorXd>(change.data(), kTangent) - predicted).norm();
  };
  const double one = missed(1e-3), half = missed(5e-4);
  EXPECT_NEAR(one / half, 4.0, 0.2);
}

TEST(RotationDerivatives, AgreeWithDifferencesOfExpAndLog) {
  Random random(14);
  for (const double size : {1e-5, 0.05, 0.2, 1.5, 3.0}) {
    const Vector3d r = size * random_vector(random).normalized();
    const ExpAndJacobian exp = exp_and_jacobian(r);
    EXPECT_LT((exp.rotation - exp_map(r).toRotationMatrix()).norm(), 1e-14) << size;
    const double h = 1e-6;
    Matrix3d J, J_inv;
    for (int k = 0; k < 3; ++k) {
      const Vector3d e = h * Vector3d::Unit(k);
      const Quaterniond q = exp_map(r);
      J.col(k) = (log_map(q.conjugate() * exp_map(Vector3d(r + e))) -
                  log_map(q.conjugate() * exp_map(Vector3d(r - e)))) /
                 (2.0 * h);
      J_inv.col(k) = (log_map(q * exp_map(e)) - log_map(q * exp_map(Vector3d(-e)))) / (2.0 * h);
    }
    EXPECT_LT((exp.jacobian - J).norm(), 1e-8) << size;
    EXPECT_LT((inverse_right_jacobian(r) - J_inv).norm(), 1e-7) << size;
    EXPECT_LT((right_jacobian(r) * inverse_right_jacobian(r) - Matrix3d::Identity()).norm(), 1e-11) << size;
  }
}

}  // namespace
}  // namespace mimicx::control
