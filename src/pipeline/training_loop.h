/// Training of policies on references: PPO with checkpoints, a log, and an end.
///
/// One policy on one clip (imitation), one on many clips (an option's pre-training), or several options on
/// one clip under its arrangement (joint fine-tuning) are the same loop. `train` runs PPO until the samples
/// are spent, writes checkpoints with the complete state of the training, and continues from an existing
/// checkpoint. With or without interruptions, the bytes of agent and log are the same. It reads and writes
/// only the files that it is given.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/training_config.h"
#include "record/progress.h"
#include "record/sequence_entry.h"
#include "record/table.h"
#include "rl/policy.h"
#include "rl/tracking/tracking_clip.h"
#include "rl/trainer.h"

namespace mimicx::pipeline {

struct TrainingFiles {
  std::filesystem::path checkpoint;  ///< complete state
  std::filesystem::path log;         ///< a row per iteration
  std::filesystem::path falls;       ///< of one clip: share of the visits that end in a fall, over its frames
  /// Identifies the input; a checkpoint of another input is not continued.
  std::string input_checksum;
};

struct TrainingControl {
  int threads = 1;
  double limit_seconds = 0.0;         ///< time limit; 0: none
  double checkpoint_seconds = 20.0;   ///< between checkpoints
  std::function<bool()> should_stop;  ///< asked after every iteration
  /// Called before the first iteration, with the samples of the checkpoint, and after every one.
  std::function<void(std::int64_t samples, const std::string& detail)> progress;
};

struct TrainingResult {
  std::vector<rl::Agent> agents;  ///< the best of those that were rolled out during the training
  std::int64_t samples = 0;
  std::int64_t begun_samples = 0;  ///< budget that the training began with
  record::SequenceEnding ending = record::SequenceEnding::kBudget;
  bool interrupted = false;  ///< `should_stop` was true: the state is in the checkpoint
  double seconds = 0.0;      ///< of this call
};

/// @param clips   all of one state size; in each, its arrangement decides which option acts
/// @param agents  initial agents, one per option of the arrangements
TrainingResult train(const std::vector<std::shared_ptr<const rl::tracking::TrackingClip>>& clips,
                     std::vector<rl::Agent> agents, const TrainingConfig& config, const TrainingFiles& files,
                     const TrainingControl& control);

/// A callback for TrainingControl::progress that shows the training under this label.
std::function<void(std::int64_t, const std::string&)> progress_of_training(record::Progress& progress,
                                                                           const std::string& label,
                                                                           std::int64_t samples);

/// The number of consecutive roll-outs that followed the motion to its end without a marked improvement. A
/// roll-out that falls resets the count: learning has not settled.
/// @param age, best_score  the number and the best score before the roll-out
/// @param score  of the roll-out, m; over 0.5 if it did not follow the motion
int stall_age(int age, double score, double best_score);

/// The seed, and the share of the budget during which σ falls, as the learner takes them.
rl::Course course_of(const TrainingConfig& config);

/// An agent before its first sample.
rl::Agent untrained_agent(const TrainingConfig& config, int state_size = rl::tracking::kStateSize);

}  // namespace mimicx::pipeline
