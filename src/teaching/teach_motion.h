/// The policy of a motion that was planned: taught by the plan (teaching/student.h), polished by PPO where it
/// does not follow the motion alone, and tried out.
///
/// What the policy follows is the planned motion, which a body can do. It is left in policies/NAME.npz
/// (policy_file.h), whether or not its roll-out is what the run writes.
#pragma once

#include <optional>

#include "control/plan.h"
#include "files/policy_file.h"
#include "pipeline/training_config.h"
#include "run/sequence_run.h"
#include "teaching/teaching_settings.h"

namespace mimicx::teaching {

struct TaughtPolicy {
  bool interrupted = false;  ///< the job's context asked to stop: nothing below is filled
  bool timed_out = false;    ///< the job's seconds were over: there is a note, and nothing else
  std::optional<files::StoredPolicy> policy;  ///< none where the plan could not teach
  NamedValues values;                         ///< for the manifest: what it took, and how well it does alone
  rl::tracking::TrackingRollout alone;        ///< its roll-out, with rewards against the prepared reference
  std::int64_t samples = 0;                   ///< of PPO
  double seconds = 0.0;
  std::string note;  ///< why there is none, or why it is no success
};

/// @param reference  what was planned for  @param plan  followed to the end
/// @param training  of the polish; its task is that of the policy
TaughtPolicy teach_sequence(const motion::Reference& reference, const control::Plan& plan,
                            const TeachingConfig& config, const control::CostWeights& weights,
                            const pipeline::TrainingConfig& training, const run::SequenceJob& job);

/// A roll-out as seen from another reference of as many frames: rewards and distances are taken anew.
rl::tracking::TrackingRollout seen_from(const motion::Reference& reference,
                                        const rl::tracking::TrackingConfig& task,
                                        rl::tracking::TrackingRollout rollout);

}  // namespace mimicx::teaching
