/// One run over motions: noisy motions in, simulated motions, scores and a report out.
///
/// For each input: read → keypoint fit → prepare → *a method simulates the motion* → score, audit, write,
/// record. The method (method.h) is exchangeable: `imitate` trains a policy from scratch (imitate_command.h),
/// `plan` plans (plan_command.h), `adapt` plans, or arranges trained options and fine-tunes them
/// (adapt_command.h).
///
/// Inputs are done one after the other, or several in parallel with the same results. A failed input is
/// recorded with its reason, and the others continue. Every input is recorded when it is done
/// (record/journal.h), so the same command continues an interrupted run: finished inputs are kept, an
/// unfinished one is passed to the method again, and the files end up the same bytes as without the
/// interruption. Every success is also written in its input's format (clean_copy.h). Several machines may
/// each do a shard (merge.h).
///
/// It never opens any ground truth.
#pragma once

#include "record/manifest.h"
#include "run/method.h"
#include "run/run_config.h"

namespace mimicx::run {

/// The settings of a run on which its results depend, whatever the method.
NamedValues manifest_settings(const RunConfig& config);

/// @throws std::invalid_argument if an input is given twice, the folder holds a run of other settings, or a
/// file of another program would be overwritten
record::RunOutcome run_sequences(const RunConfig& config, const Method& method,
                                 const record::RunContext& context);

}  // namespace mimicx::run
