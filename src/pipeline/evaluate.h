/// `mimicx evaluate`: motions against their truth, file by file.
///
/// Pairs are files of the same name in two folders. Both sides go through forward kinematics with their own
/// shape and free joints: nothing is prepared, moved or resampled, so that every row of a table has been
/// treated alike. The mean of a metric is taken over the files that have a value of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "motion/metrics.h"

namespace mimicx::pipeline {

/// A motion and its truth, as the metrics look at them.
struct PairedMotion {
  motion::MotionSamples evaluated, truth;
};
/// @throws DataError for a file that is not there or cannot be read
PairedMotion read_pair(const std::filesystem::path& truth, const std::filesystem::path& motion);

/// The names of a folder's .npz files without suffix, sorted. @throws DataError for a path that is no folder
std::vector<std::string> npz_names(const std::filesystem::path& folder);
/// The same of a folder that must hold some. @throws DataError where there is none
std::vector<std::string> motion_names(const std::filesystem::path& folder);

struct EvaluatedMotion {
  std::string name;  ///< file name without suffix
  bool ok = false;
  std::string reason;  ///< why it could not be evaluated
  int frames = 0;
  motion::Metrics metrics;
};

struct Evaluation {
  std::vector<EvaluatedMotion> motions;  ///< by name
  std::vector<std::string> unmatched;    ///< truths without a motion of their name
};

/// @throws DataError for a path that is no folder, and where `motions` holds no .npz
Evaluation evaluate_folders(const std::filesystem::path& truth, const std::filesystem::path& motions);

/// Mean over the evaluated motions; NaN where none has a value.
double mean_of(const Evaluation& evaluation, const motion::MetricDefinition& metric);

/// Several folders of the same motions (input, fit, cleaned …), reduced to those that all of them hold.
struct Comparison {
  std::vector<std::string> labels;      ///< [folder]
  std::vector<Evaluation> evaluations;  ///< [folder], all of the same motions
  int left_out = 0;                     ///< motions that some folder lacks or that could not be evaluated
  std::vector<std::string> failures;    ///< of those that could not be evaluated: "folder/name: why"
};
/// @throws DataError as `evaluate_folders`
Comparison compare_folders(const std::filesystem::path& truth, const std::vector<std::string>& folders);
/// A line of means per folder.
std::string format_comparison(const Comparison& comparison);
/// {"rows": [{folder, mean}], "motions": [names], "left_out", "definitions"}
std::string comparison_json(const Comparison& comparison);

/// A line per motion and one of means, columns aligned.
std::string format_evaluation(const Evaluation& evaluation);
/// {"motions": [{name, status, reason, frames, metrics}], "mean": {...}, "definitions": {...}, "unmatched":
/// [...]}
std::string evaluation_json(const Evaluation& evaluation);

}  // namespace mimicx::pipeline
