/// Small tasks with known answers (rl/task_environment.h).
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "rl/task_environment.h"

namespace mimicx::rl::toy {

using Outcome = TaskOutcome;

/// Position and velocity under a force: x' = A x + B u, reward −(xᵀQx + R u²).
struct DoubleIntegrator {
  static constexpr int kState = 2, kObservation = 2, kAction = 1, kLimit = 50;
  static constexpr double kDt = 0.2, kPositionCost = 1.0, kVelocityCost = 0.1, kForceCost = 0.1;
  using State = std::array<double, kState>;

  static State reset(Random& random) {
    const double position = random.uniform(-1.0, 1.0);
    return {position, random.uniform(-1.0, 1.0)};
  }
  static void observe(const State& s, float* out) {
    out[0] = static_cast<float>(s[0]);
    out[1] = static_cast<float>(s[1]);
  }
  static Outcome step(State& s, const float* action, Random&) {
    const double u = action[0];
    const double cost = kPositionCost * s[0] * s[0] + kVelocityCost * s[1] * s[1] + kForceCost * u * u;
    s = {s[0] + kDt * s[1], s[1] + kDt * u};
    return {-cost};
  }
};

/// Swing-up of a rod (1 m, 1 kg, pivot at its end) with a torque that cannot lift it at once; angle from
/// upright. An action of ±1 is the largest torque.
struct Pendulum {
  static constexpr int kState = 2, kObservation = 3, kAction = 1, kLimit = 200;
  static constexpr double kDt = 0.05, kGravity = 10.0, kTorque = 2.0, kSpeed = 8.0;
  static constexpr double kPi = 3.14159265358979323846;
  using State = std::array<double, kState>;

  static State reset(Random& random) {
    const double angle = random.uniform(-kPi, kPi);
    return {angle, random.uniform(-1.0, 1.0)};
  }
  static void observe(const State& s, float* out) {
    out[0] = static_cast<float>(std::cos(s[0]));
    out[1] = static_cast<float>(std::sin(s[0]));
    out[2] = static_cast<float>(s[1]);
  }
  static Outcome step(State& s, const float* action, Random&) {
    const double u = kTorque * std::fmin(std::fmax(double{action[0]}, -1.0), 1.0);
    const double angle = std::remainder(s[0], 2.0 * kPi);
    const double cost = angle * angle + 0.1 * s[1] * s[1] + 0.001 * u * u;
    const double speed = s[1] + kDt * (1.5 * kGravity * std::sin(s[0]) + 3.0 * u);
    s[1] = std::fmin(std::fmax(speed, -kSpeed), kSpeed);
    s[0] += kDt * s[1];
    return {-cost};
  }
};

/// Reward 1 forever, with a time limit of 10 steps that the observation does not show.
struct ConstantReward {
  static constexpr int kState = 2, kObservation = 2, kAction = 1, kLimit = 10;
  using State = std::array<double, kState>;
  static State reset(Random& random) {
    const double first = random.normal();
    return {first, random.normal()};
  }
  static void observe(const State& s, float* out) {
    out[0] = static_cast<float>(s[0]);
    out[1] = static_cast<float>(s[1]);
  }
  static Outcome step(State& s, const float*, Random& random) {
    s = reset(random);
    return {1.0};
  }
};

/// Reward 1 per step; the episode terminates with probability 1/5 at every step.
struct MortalReward : ConstantReward {
  static constexpr int kLimit = 1 << 20;
  static constexpr double kDeath = 0.2;
  static Outcome step(State& s, const float*, Random& random) {
    s = reset(random);
    return {1.0, random.uniform() < kDeath};
  }
};

template <class Task>
using ToyEnvironment = TaskEnvironment<Task>;

static_assert(Environment<ToyEnvironment<Pendulum>>);

}  // namespace mimicx::rl::toy
