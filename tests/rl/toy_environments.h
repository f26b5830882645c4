/// Small tasks with known answers, behind the Environment concept.
///
/// A Task is a plain struct: sizes, a reset, an observation and a step of one character. `ToyEnvironment`
/// turns it into groups of characters with time limits, automatic resets and a saved state.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "rl/environment.h"

namespace mimicx::rl::toy {

struct Outcome {
  double reward;
  bool terminated = false;
};

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
class ToyEnvironment {
 public:
  ToyEnvironment(int groups, int group_size, std::uint64_t seed) : group_size_(group_size) {
    for (int g = 0; g < groups; ++g) {
      Group group{Random(seed, {static_cast<std::uint64_t>(g)}), {}, {}};
      for (int i = 0; i < group_size; ++i) group.states.push_back(Task::reset(group.random));
      // Different ages, so that the time limits fall on different steps.
      for (int i = 0; i < group_size; ++i)
        group.ages.push_back(static_cast<int>(group.random.below(static_cast<std::uint32_t>(Task::kLimit))));
      groups_.push_back(std::move(group));
    }
  }

  int groups() const { return static_cast<int>(groups_.size()); }
  int group_size() const { return group_size_; }
  int observation_dim() const { return Task::kObservation; }
  int action_dim() const { return Task::kAction; }
  int agents() const { return 1; }
  int actor(int, int) const { return 0; }

  void observe(int group, Eigen::Ref<nn::Matrix<float>> observations) const {
    const Group& g = groups_[group];
    for (int i = 0; i < group_size_; ++i) Task::observe(g.states[i], observations.row(i).data());
  }

  void step(int group, const Eigen::Ref<const nn::Matrix<float>>& actions, StepResult& result) {
    Group& g = groups_[group];
    for (int i = 0; i < group_size_; ++i) {
      auto& state = g.states[i];
      int& age = g.ages[i];
      const Outcome outcome = Task::step(state, actions.row(i).data(), g.random);
      result.reward[i] = static_cast<float>(outcome.reward);
      result.terminated[i] = outcome.terminated;
      result.truncated[i] = !outcome.terminated && ++age >= Task::kLimit;
      if (result.truncated[i]) Task::observe(state, result.final_observations.row(i).data());
      if (!outcome.terminated && !result.truncated[i]) continue;
      state = Task::reset(g.random);
      age = 0;
    }
  }

  std::vector<CharacterPlace> end_iteration() {
    ++iterations_;
    return {};
  }

  void save(Npz& archive, const std::string& prefix) const {
    std::vector<double> numbers = {static_cast<double>(iterations_)};
    for (const Group& g : groups_) {
      numbers.push_back(static_cast<double>(g.random.position()));
      for (const auto& state : g.states) numbers.insert(numbers.end(), state.begin(), state.end());
      numbers.insert(numbers.end(), g.ages.begin(), g.ages.end());
    }
    archive.set(prefix + "toy", NpyArray::from_double({numbers.size()}, numbers.data()));
  }

  void load(const Npz& archive, const std::string& prefix) {
    const std::vector<double> numbers = archive.at(prefix + "toy").to_double();
    const std::size_t expected =
        1 + groups_.size() * static_cast<std::size_t>(1 + group_size_ * (Task::kState + 1));
    if (numbers.size() != expected)
      throw DataError(archive.path, prefix + "toy", std::to_string(expected) + " numbers",
                      std::to_string(numbers.size()));
    auto next = numbers.begin();
    iterations_ = static_cast<int>(*next++);
    for (Group& g : groups_) {
      g.random.seek(static_cast<std::uint64_t>(*next++));
      for (auto& state : g.states)
        for (double& x : state) x = *next++;
      for (int& age : g.ages) age = static_cast<int>(*next++);
    }
  }

 private:
  struct Group {
    Random random;
    List<typename Task::State> states;
    List<int> ages;
  };
  int group_size_;
  int iterations_ = 0;
  List<Group> groups_;
};

static_assert(Environment<ToyEnvironment<Pendulum>>);

}  // namespace mimicx::rl::toy
