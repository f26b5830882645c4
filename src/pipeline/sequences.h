/// `mimicx imitate` and `mimicx adapt`: noisy motions in, simulated motions, scores and a report out.
///
/// For each input: read → keypoint fit → prepare → policies → roll their mean actions out over the whole clip
/// → metrics → write. Without options one policy is trained from scratch. With options (METHOD §8, §9) they
/// run side by side, the selector arranges them over the clip, and those it chose are fine-tuned jointly.
/// One input after the other; an input that fails is recorded with its reason and the others go on. The
/// manifest is written after every input, so the same command continues a run that was interrupted: finished
/// inputs are kept, a begun training is taken up again, and the files end up the same bytes as if nothing
/// had happened. Every success is also written in its input's own format (clean_copy.h).
///
/// What it never does: open any ground truth.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "motion/import/motion_file.h"
#include "pipeline/options/option_set.h"
#include "pipeline/record/manifest.h"
#include "pipeline/record/progress.h"
#include "pipeline/record/run_folder.h"
#include "pipeline/training.h"

namespace mimicx {

struct RunOptions {
  std::vector<std::string> inputs;  ///< as given; recorded as such
  std::filesystem::path out;
  TrainingConfig training;
  ReadOptions read;
  bool input_rate = false;  ///< clean copies at the input's frame rate instead of 30 fps
  bool beside = false;      ///< clean copies beside their inputs, as NAME.clean.EXT, instead of in the folder
  bool substeps = false;    ///< also write every physics step of the result; finished motions get theirs too
  bool fit = false;         ///< move inputs onto their keypoints first, where they have any
  bool keypoints = true;    ///< false: Eq. 3 does not see them either
  std::shared_ptr<const OptionSet> options;  ///< to start from; null: train from scratch
  double switch_penalty = -1.0;              ///< w_p of Eq. 4, in rewards; ≤ 0
  double rescue_reward = 0.1;                ///< σ of the side-by-side roll-out
  int threads = 1;
  double limit_seconds = 0.0;  ///< safety stop per sequence; 0: none
};

/// The world around a run.
struct RunContext {
  Progress& progress;
  std::ostream& messages;             ///< one line per input, warnings
  std::function<bool()> should_stop;  ///< true: write a checkpoint and return
};

enum class RunOutcome { kAllGood, kSomeFailed, kInterrupted };

/// @throws std::invalid_argument when an input is given twice, or the folder holds a run of other settings
RunOutcome run_sequences(const RunOptions& options, const RunContext& context);

/// What fine-tuning changes in the defaults: it starts from options, so it explores less, spends less, and
/// ends where the motion is good enough or nothing improves any more.    docs/method.md §9
TrainingConfig fine_tuning_defaults();

}  // namespace mimicx
