/// `mimicx evaluate`: motions against their truth, file by file.
///
/// Pairs are files of the same name in two folders, of any format that is read, or two files. Both sides go
/// through forward kinematics with their own shape and free joints. Both are resampled to the rate of the
/// metrics (motion::kMetricRate); nothing is prepared, or moved but by multiples of 100 m
/// (import/motion_file.h), so all rows of a table are comparable. The mean of a metric is over the files that
/// have a value.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "import/motion_file.h"
#include "motion/metrics.h"

namespace mimicx::judge {

/// A motion and its truth, sampled for the metrics.
struct PairedMotion {
  motion::MotionSamples evaluated, truth;
};
/// A motion and its truth; either is empty if it is missing.
struct Pair {
  std::filesystem::path truth, motion;
};
/// At their own rates.
/// @throws DataError for a missing truth, and a file that cannot be read
PairedMotion read_pair(const Pair& pair, const import::ReadConfig& read);

/// The files of a folder, or a single file, by name: the path in the folder without suffix (files/inputs.h);
/// "walk" also for walk.clean.bvh. Equal names are told apart as those of a run's outputs ("walk", "walk-2").
std::map<std::string, std::filesystem::path> named_motions(const std::filesystem::path& path);

/// Truths and motions by name; of several with one name, those of one suffix are a pair. A truth and a motion
/// that are both given as files are a pair, whatever their names. Parts of a motion that failed as a whole
/// (record/run_folder.h) are left out if they have no truth of their own. Other entries may lack either.
/// @throws DataError if there is no motion
std::map<std::string, Pair> paired(const std::filesystem::path& truth, const std::filesystem::path& motions);

struct EvaluatedMotion {
  std::string name;  ///< file name without suffix
  bool ok = false;
  std::string reason;             ///< why it was not evaluated
  std::vector<std::string> told;  ///< decisions and warnings of the reader, both files, a line each
  int frames = 0;
  motion::Metrics metrics;
};

struct Evaluation {
  std::vector<EvaluatedMotion> motions;  ///< by name
  std::vector<std::string> unmatched;    ///< names of truths without a motion
};

/// @throws DataError for a missing path, and if `motions` holds no motion
Evaluation evaluate_folders(const std::filesystem::path& truth, const std::filesystem::path& motions,
                            const import::ReadConfig& read = {});

/// Mean over the evaluated motions; NaN if none has a value.
double mean_of(const Evaluation& evaluation, const motion::MetricDefinition& metric);

/// Several folders of the same motions (input, fit, cleaned …), reduced to the motions that all of them have.
struct Comparison {
  std::vector<std::string> labels;      ///< [folder]
  std::vector<Evaluation> evaluations;  ///< [folder], each of the same motions
  int left_out = 0;                     ///< motions that are missing or failed in some folder, or in all
  std::vector<std::string> failures;    ///< of the failed motions: "folder/name: reason"
  std::vector<std::string> unmatched;   ///< names of truths without a motion in any folder
};
/// @throws DataError as `evaluate_folders`
Comparison compare_folders(const std::filesystem::path& truth, const std::vector<std::string>& folders,
                           const import::ReadConfig& read = {});
/// A line of means per folder.
std::string format_comparison(const Comparison& comparison);
/// {"rows": [{folder, mean}], "motions": [names], "left_out", "unmatched": [...], "definitions"}
std::string comparison_json(const Comparison& comparison);

/// A line per motion and one of means, columns aligned.
std::string format_evaluation(const Evaluation& evaluation);
/// {"motions": [{name, status, reason, frames, metrics}], "mean": {...}, "definitions": {...}, "unmatched":
/// [...]}
std::string evaluation_json(const Evaluation& evaluation);

}  // namespace mimicx::judge
