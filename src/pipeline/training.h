/// Training of policies on references: the seam between files and the learner.
///
/// One policy on one clip (imitation), one on many clips (an option's pre-training), or several options on
/// one clip under its arrangement (joint fine-tuning) are the same loop. `train` runs PPO until the samples
/// are spent, writes the complete state of the training to a checkpoint now and then, and takes a training up
/// again where its checkpoint left it: interrupted or not, the bytes of the agent and of the log are the
/// same. It reads and writes only the files it is given.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/named_values.h"
#include "pipeline/record/ending.h"
#include "pipeline/record/progress.h"
#include "pipeline/record/table.h"
#include "rl/policy.h"
#include "rl/ppo_config.h"
#include "rl/tracking/pack.h"

namespace mimicx {

/// PPO for tracking: many small iterations with a generous KL, and a discount that looks 0.4 s ahead: what a
/// pose error costs shows at once. Measured in docs/experiments.md.
inline rl::PpoConfig tracking_ppo() {
  return {.horizon = 16,
          .gamma = 0.92,
          .lambda = 0.9,
          .sigma_start = 0.07,
          .sigma_end = 0.04,
          .epochs = 2,
          .minibatch = 1024,
          .clip = 0.2,
          .gradient_norm = 1.0,
          .critic_step_size = 5e-4,
          .return_rate = 0.1,
          .step_size = 1e-4,
          .step_factor = 1.5,
          .step_min = 1e-6,
          .step_max = 2e-3,
          .kl_target = 0.06,
          .kl_stop = 4.0,
          .penalty_weight = 0.0,
          .penalty_fraction = 0.125,
          .bound_weight = 0.0,
          .mean_bound = 3.0,
          .gradient_slots = 4,
          .pass_rows = 256};
}

/// Everything that the result of a training depends on. Defaults: docs/experiments.md.
struct TrainingConfig {
  std::int64_t samples = 4'000'000;      ///< budget: character steps
  std::uint64_t seed = 1;                ///< the one root of every random number
  int characters = 256;                  ///< simulated side by side
  int group_size = 64;                   ///< characters that one worker carries through a roll-out
  std::vector<int> hidden = {128, 128};  ///< of actor and critic
  double sigma_share = 0.75;             ///< share of the budget during which σ falls
  int evaluate_iterations = 20;          ///< between roll-outs of the mean action; the best agents are kept
  double stop_reward = 0.0;              ///< mean reward of a roll-out that is good enough; 0: none is
  int stall_evaluations = 0;  ///< roll-outs in a row that follow the motion to its end, but none better than
                              ///< before, that end the training; 0: none do
  rl::PpoConfig ppo = tracking_ppo();
  rl::TrackingConfig tracking;
};

/// Every number of the configuration but samples and seed, by name: for the manifest.
NamedValues settings_of(const TrainingConfig& config);
/// Changes one of them, for experiments and ablations.
/// @throws std::invalid_argument for an unknown name or a fraction where a whole number is expected
void apply_setting(TrainingConfig& config, const std::string& name, double value);
/// @throws std::invalid_argument naming a setting that no training can have
void check(const TrainingConfig& config);

struct TrainingFiles {
  std::filesystem::path checkpoint;  ///< complete state
  std::filesystem::path log;         ///< a row per iteration
  std::filesystem::path falls;       ///< share of the visits that end in a fall, over the clip's frames
  /// Identifies the input; a checkpoint of another input is not taken up.
  std::string input_checksum;
};

struct TrainingControl {
  int threads = 1;
  double limit_seconds = 0.0;         ///< safety stop; 0: none
  double checkpoint_seconds = 20.0;   ///< between checkpoints
  std::function<bool()> should_stop;  ///< asked after every iteration
  /// Called before the first iteration (with what a checkpoint brought) and after every one.
  std::function<void(std::int64_t samples, const std::string& detail)> progress;
};

struct TrainingResult {
  std::vector<rl::Agent> agents;  ///< the best of those that were rolled out during the training
  std::int64_t samples = 0;
  Ending ending = Ending::kBudget;
  bool interrupted = false;  ///< `should_stop` said so: the state is in the checkpoint
  double seconds = 0.0;      ///< of this call
};

/// @param clips   of one state size; options act in each as its arrangement says
/// @param agents  what to start from, one per option of the arrangements
TrainingResult train(const std::vector<std::shared_ptr<const rl::TrackingClip>>& clips,
                     std::vector<rl::Agent> agents, const TrainingConfig& config, const TrainingFiles& files,
                     const TrainingControl& control);

/// What tells `progress` how far a training of so many samples is, a job of that label.
std::function<void(std::int64_t, const std::string&)> progress_of_training(Progress& progress,
                                                                           const std::string& label,
                                                                           std::int64_t samples);

/// How many roll-outs in a row have followed the motion to its end without being markedly better than before.
/// A roll-out that falls says that learning has not settled, even where an earlier one was lucky.
/// @param age, best_score  before the roll-out of `score` (m; over 0.5 where it was not followed)
int stall_age(int age, double score, double best_score);

/// An agent before its first sample.
rl::Agent untrained_agent(const TrainingConfig& config, int state_size = rl::kStateSize);

}  // namespace mimicx
