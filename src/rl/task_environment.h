/// An environment of a small task of one's own.
///
/// A Task is a plain struct that says what one character does. A regulator of one number, say:
///
///     struct Regulator {
///       static constexpr int kState = 1, kObservation = 1, kAction = 1, kLimit = 50;  // steps of an episode
///       using State = std::array<double, kState>;
///       static State reset(Random& random) { return {random.uniform(-1.0, 1.0)}; }
///       static void observe(const State& s, float* out) { out[0] = static_cast<float>(s[0]); }
///       static TaskOutcome step(State& s, const float* action, Random&) {
///         s[0] += 0.1 * action[0];
///         return {-s[0] * s[0]};
///       }
///     };
///
/// `TaskEnvironment` makes groups of such characters with time limits, automatic resets and a saved state of
/// it, which PpoTrainer (trainer.h) trains. Characters start at different ages, so that the time limits fall
/// on different steps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "rl/environment.h"

namespace mimicx::rl {

/// What one step of a task gives. A time limit is no termination: `kLimit` truncates.
struct TaskOutcome {
  double reward;
  bool terminated = false;
};

template <class Task>
class TaskEnvironment {
 public:
  TaskEnvironment(int groups, int group_size, std::uint64_t seed) : group_size_(group_size) {
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
      const TaskOutcome outcome = Task::step(state, actions.row(i).data(), g.random);
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
    archive.set(prefix + "task", NpyArray::from_double({numbers.size()}, numbers.data()));
  }

  void load(const Npz& archive, const std::string& prefix) {
    const std::vector<double> numbers = archive.at(prefix + "task").to_double();
    const std::size_t expected =
        1 + groups_.size() * static_cast<std::size_t>(1 + group_size_ * (Task::kState + 1));
    if (numbers.size() != expected)
      throw DataError(archive.path, prefix + "task", std::to_string(expected) + " numbers",
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

}  // namespace mimicx::rl
