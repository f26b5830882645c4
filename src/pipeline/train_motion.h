/// Trains policies to follow one motion, and rolls their mean actions out over the whole motion.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/training.h"
#include "run/sequence_run.h"

namespace mimicx::pipeline {

/// The result is interrupted if the training was. It has no roll-out from before: callers that need one have
/// it.
/// @param agents  to start from, one per option of the clip's arrangement
run::SimulatedSequence train_sequence(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                      const std::vector<rl::Agent>& agents, const TrainingConfig& config,
                                      const run::SequenceJob& job);

}  // namespace mimicx::pipeline
