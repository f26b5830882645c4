/// The paper's method for one motion: options are arranged over the motion (Eq. 4), and those that act are
/// fine-tuned jointly on it.                                                     docs/method.md §8, §9
#pragma once

#include "pipeline/options/arrangement.h"
#include "pipeline/training_loop.h"
#include "run/method.h"

namespace mimicx::pipeline {

/// The search for an arrangement and the training share the job's seconds. The result is interrupted where
/// either was; the same job then continues the training from its checkpoint.
/// @param sets      tried in their order (option_set_choice.h)
/// @param training  of the fine-tuning; the networks are the options' own
/// @throws std::invalid_argument as `choose_set`
run::SimulatedSequence fine_tune(const motion::Reference& reference, const options::OptionSets& sets,
                                 const options::ArrangementConfig& arrangement,
                                 const TrainingConfig& training, const run::SequenceJob& job);

}  // namespace mimicx::pipeline
