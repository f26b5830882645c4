/// Trains policies to follow one motion, and rolls their mean actions out over the whole motion.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/training_loop.h"
#include "run/sequence_run.h"

namespace mimicx::pipeline {

/// The result is interrupted if the training was. Its `before` is empty: callers that need it fill it.
/// @param agents  to start from, one per option of the clip's arrangement
run::SimulatedSequence train_sequence(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                      const std::vector<rl::Agent>& agents, const TrainingConfig& config,
                                      const run::SequenceJob& job);

}  // namespace mimicx::pipeline
