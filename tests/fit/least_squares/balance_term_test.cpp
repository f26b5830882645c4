#include "fit/least_squares/balance_term.h"

#include <gtest/gtest.h>

#include "fit/least_squares/random_problems.h"
#include "motion/synthetic_clip.h"

namespace mimicx::fit {
namespace {

constexpr int kFrames = 7, kMiddle = 3;  // the only frame with a tenth of a second to either side

/// Somebody who stands still, off balance, and both feet stand.
struct Standing {
  FitProblem problem;
  FitState state;
  Contacts contacts;

  Standing() : problem(make_problem(still(), {})), state(initial_state(problem)), contacts(kFrames) {
    const FrameVector one = test::random_state(problem, 4, 0.03).c[0];
    for (FrameVector& c : state.c) c = one;
    for (auto& frame : contacts) frame.fill(true);
  }

  static motion::Clip still() {
    motion::Clip clip = test::synthetic_clip("stand", 5, kFrames);
    for (int t = 1; t < kFrames; ++t) {
      clip.rotations[t] = clip.rotations[0];
      clip.trans[t] = clip.trans[0];
    }
    return clip;
  }

  BorderedBand term() const {
    const test::Moved m = test::move(problem, state);
    BorderedBand system(kFrames, kFrameUnknowns, problem.globals());
    add_balance(problem, character_of(problem, state), m.motion, m.feet, contacts, system);
    return system;
  }
};

/// Centre of mass from the middle of the feet, over the floor; of a body at rest that is where its
/// zero-moment point is.
VectorXd off_balance(const Standing& s, const FitState& state) {
  const test::Moved m = test::move(s.problem, state);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Vector3d& p : m.feet[kMiddle]) middle += p.head<2>() / kFootPoints;
  const Character character = character_of(s.problem, state);
  return center_of_mass(character, m.motion[kMiddle].poses).head<2>() - middle;
}

TEST(FitBalance, NormalEquationsMatchTheFormula) {
  const Standing s;
  const BorderedBand system = s.term();
  const test::Moved m = test::move(s.problem, s.state);
  const VectorXd r = off_balance(s, s.state);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Vector3d& p : m.feet[kMiddle]) middle += p.head<2>() / kFootPoints;
  Eigen::Matrix2d S = 0.02 * 0.02 * Eigen::Matrix2d::Identity();
  for (const Vector3d& p : m.feet[kMiddle]) {
    const Eigen::Vector2d d = p.head<2>() - middle;
    S += d * d.transpose() / (3.0 * kFootPoints);
  }
  const Eigen::Matrix2d P =
      S.inverse() / (1.0 + r.dot(S.inverse() * r) / 4.0) / s.problem.config.balance_frames;
  Eigen::MatrixXd J(2, kFrameUnknowns);
  for (int i = 0; i < kFrameUnknowns; ++i) {
    FitState up = s.state, down = s.state;
    up.c[kMiddle][i] += 1e-5;
    down.c[kMiddle][i] -= 1e-5;
    J.col(i) = (off_balance(s, up) - off_balance(s, down)) / 2e-5;
  }
  const Eigen::MatrixXd expected = J.transpose() * P * J;
  EXPECT_GT(r.norm(), 0.01);
  EXPECT_LT((system.diagonal[kMiddle] - expected).norm(), 1e-5 * expected.norm());
  EXPECT_LT((system.rhs[kMiddle] + J.transpose() * P * r).norm(), 1e-5 * system.rhs[kMiddle].norm());
  for (int t = 0; t < kFrames; ++t)
    if (t != kMiddle) {
      EXPECT_EQ(system.rhs[t].norm(), 0.0) << "no acceleration is known there";
    }
}

TEST(FitBalance, AddsNothingInFlightOnHandsOrWhenOff) {
  Standing flying;
  for (auto& frame : flying.contacts) frame.fill(false);
  EXPECT_EQ(flying.term().diagonal[kMiddle].norm(), 0.0);

  Standing kneeling;
  for (FrameVector& c : kneeling.state.c) c[2] -= 0.5;  // the knees are in the floor
  EXPECT_EQ(kneeling.term().diagonal[kMiddle].norm(), 0.0);

  Standing unasked;
  unasked.problem.config.balance_frames = 0.0;
  EXPECT_EQ(unasked.term().diagonal[kMiddle].norm(), 0.0);
  EXPECT_GT(Standing().term().diagonal[kMiddle].norm(), 0.0);
}

}  // namespace
}  // namespace mimicx::fit
