/// Teaches a policy by the plan of a motion (teaching/student.h), continues with PPO if it does not follow
/// the motion unaided, and evaluates it.
///
/// The policy follows the planned motion, which is physically feasible. It is written to policies/NAME.npz
/// (policy_file.h), also if the run writes the plan's roll-out.
#pragma once

#include <optional>

#include "control/plan.h"
#include "files/policy_file.h"
#include "pipeline/training_config.h"
#include "run/sequence_run.h"
#include "teaching/teaching_settings.h"

namespace mimicx::teaching {

struct TaughtPolicy {
  bool interrupted = false;  ///< the job's context requested a stop: nothing below is set
  bool timed_out = false;    ///< the job's seconds ran out; only the note is set if the lessons were stopped
  std::optional<files::StoredPolicy> policy;  ///< none if the plan gave no teacher
  NamedValues values;                   ///< for the manifest: how it was taught, and how well it acts unaided
  rl::tracking::TrackingRollout alone;  ///< its roll-out, with rewards against the prepared reference
  std::int64_t samples = 0;             ///< of PPO
  double seconds = 0.0;
  std::string note;  ///< why there is no policy, why it is no success, or what ended its training
};

/// @param reference  of the plan @param plan  complete
/// @param training  of the PPO stage; its task is that of the policy
TaughtPolicy teach_sequence(const motion::Reference& reference, const control::Plan& plan,
                            const TeachingConfig& config, const control::CostWeights& weights,
                            const pipeline::TrainingConfig& training, const run::SequenceJob& job);

/// The roll-out with rewards and distances recomputed against another reference of as many frames.
rl::tracking::TrackingRollout seen_from(const motion::Reference& reference,
                                        const rl::tracking::TrackingConfig& task,
                                        rl::tracking::TrackingRollout rollout);

}  // namespace mimicx::teaching
