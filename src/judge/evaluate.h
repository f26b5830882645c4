/// `mimicx evaluate`: motions against their truth, file by file.
///
/// Pairs are files of the same name in two folders, of any format that is read, or two files. Both sides go
/// through forward kinematics with their own shape and free joints: nothing is prepared, moved or resampled,
/// so that every row of a table has been treated alike. The mean of a metric is taken over the files that
/// have a value of it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "import/motion_file.h"
#include "motion/metrics.h"

namespace mimicx::judge {

/// A motion and its truth, as the metrics look at them.
struct PairedMotion {
  motion::MotionSamples evaluated, truth;
};
/// A motion and the file of its truth, which is empty where there is none.
struct Pair {
  std::filesystem::path truth, motion;
};
/// @throws DataError for a truth that is not there, and a file that cannot be read
PairedMotion read_pair(const Pair& pair, const import::ReadConfig& read);

/// The files of a folder, or a file by itself, by their names: places in the folder without suffix
/// (files/inputs.h); "walk" also for walk.clean.bvh.
std::map<std::string, std::filesystem::path> named_motions(const std::filesystem::path& path);

/// Truths and motions by their names; a truth and a motion that are files themselves go together, whatever
/// they are called. Entries may lack either. @throws DataError where there is no motion
std::map<std::string, Pair> paired(const std::filesystem::path& truth, const std::filesystem::path& motions);

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

/// @throws DataError for a path that is not there, and where `motions` holds none
Evaluation evaluate_folders(const std::filesystem::path& truth, const std::filesystem::path& motions,
                            const import::ReadConfig& read = {});

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
Comparison compare_folders(const std::filesystem::path& truth, const std::vector<std::string>& folders,
                           const import::ReadConfig& read = {});
/// A line of means per folder.
std::string format_comparison(const Comparison& comparison);
/// {"rows": [{folder, mean}], "motions": [names], "left_out", "definitions"}
std::string comparison_json(const Comparison& comparison);

/// A line per motion and one of means, columns aligned.
std::string format_evaluation(const Evaluation& evaluation);
/// {"motions": [{name, status, reason, frames, metrics}], "mean": {...}, "definitions": {...}, "unmatched":
/// [...]}
std::string evaluation_json(const Evaluation& evaluation);

}  // namespace mimicx::judge
