/// `mimicx imitate`: noisy motions in, simulated motions, scores and a report out.
///
/// For each input: read → prepare → train one policy from scratch → roll its mean action out over the whole
/// clip → metrics → write. One input after the other, each with its own training; an input that fails is
/// recorded with its reason and the others go on. The manifest is written after every input, so the same
/// command continues a run that was interrupted: finished inputs are kept, a begun training is taken up
/// again, and the files end up the same bytes as if nothing had happened.
///
/// What it never does: open any ground truth.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "pipeline/manifest.h"
#include "pipeline/progress.h"
#include "pipeline/run_folder.h"
#include "pipeline/training.h"

namespace mimicx {

struct ImitateOptions {
  std::vector<std::string> inputs;  ///< as given; recorded as such
  std::filesystem::path out;
  TrainingConfig training;
  int threads = 1;
  double limit_seconds = 0.0;  ///< safety stop per sequence; 0: none
};

/// The world around a run.
struct ImitateContext {
  Progress& progress;
  std::ostream& messages;             ///< one line per input, warnings
  std::function<bool()> should_stop;  ///< true: write a checkpoint and return
};

enum class ImitateOutcome { kAllGood, kSomeFailed, kInterrupted };

/// @throws std::invalid_argument when an input is given twice, or the folder holds a run of other settings
ImitateOutcome imitate(const ImitateOptions& options, const ImitateContext& context);

}  // namespace mimicx
