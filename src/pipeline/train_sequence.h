/// The middle of a run by training: policies learn to follow one motion, and their mean actions are rolled
/// out over the whole of it.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/sequence_run.h"
#include "pipeline/training.h"

namespace mimicx::pipeline {

/// The result is interrupted where the training was.
/// @param agents  to start from, one per option of the clip's arrangement
SimulatedSequence train_sequence(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                 const std::vector<rl::Agent>& agents, const TrainingConfig& config,
                                 const SequenceJob& job);

}  // namespace mimicx::pipeline
