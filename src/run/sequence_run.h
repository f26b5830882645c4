/// One run over motions: noisy motions in, simulated motions, scores and a report out.
///
/// For each input: read → keypoint fit → prepare → *a method simulates the motion* → score, audit, write,
/// record. The method is the exchangeable middle: `imitate` trains a policy from scratch (imitate.h), `plan`
/// plans (plan.h), `adapt` plans, or arranges trained options and fine-tunes them (adapt.h). Everything
/// around it is here, once for all.
///
/// One input after the other, or several side by side with the same results; an input that fails is recorded
/// with its reason and the others go on. Every input is recorded when it is done (record/journal.h), so the
/// same command continues a run that was interrupted: finished inputs are kept, a begun one is handed to the
/// method again, and the files end up the same bytes as if nothing had happened. Every success is also
/// written in its input's own format (clean_copy.h). Several machines may each do a part (merge.h).
///
/// What it never does: open any ground truth.
#pragma once

#include "record/manifest.h"
#include "run/method.h"
#include "run/run_config.h"

namespace mimicx::run {

/// The settings of a run on which its results depend, whatever the method.
NamedValues settings_of(const RunConfig& config);

/// @throws std::invalid_argument when an input is given twice, the folder holds a run of other settings, or
/// something would be overwritten that no run made
record::RunOutcome run_sequences(const RunConfig& config, const Method& method,
                                 const record::RunContext& context);

}  // namespace mimicx::run
