/// From a file's motion to a reference: keypoint fit (or, without keypoints, the fit of poses alone), then
/// preparation. The first arrow of every stage.
///
/// Eq. 3 draws the simulated body to the keypoints, Eq. 2 to the reference. Where the reference was not
/// fitted onto the keypoints the two ask for two poses at once: such a reference has no keypoints.
/// docs/method.md §5
///
/// What it never does: open any ground truth.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "core/named_values.h"
#include "fit/keypoint_fit.h"
#include "import/motion_file.h"
#include "motion/reference.h"

namespace mimicx::run {

struct PreparedMotion {
  motion::Clip input;              ///< as it was read, with what reading decided
  motion::Clip fitted;             ///< moved onto its keypoints, or by the fit of poses alone
  bool has_fit = false;            ///< onto its keypoints
  motion::Reference reference;     ///< with keypoints, for Eq. 3, only where it was fitted onto them
  NamedValues fit_values;          ///< of the fit's report; empty without a fit
  NamedValues preparation_values;  ///< of the preparation's report
  std::vector<std::string> notes;  ///< warnings of all steps
};

/// How much of a motion may be corrected before it is asked for.
enum class Correction {
  kNone,      ///< it is only resampled, with hinges for knees and elbows
  kPoses,     ///< fit of poses alone and preparation; keypoints are ignored
  kKeypoints  ///< keypoint fit and preparation; without keypoints as kPoses
};

/// @param threads  no influence on the result
/// @throws DataError as reading, fitting and preparing do
PreparedMotion prepare_motion(const std::filesystem::path& path, const import::ReadConfig& read,
                              Correction correction, int threads = 1);

/// Prints what reading decided, many decisions in their summary, and what it warns of, a line each, behind
/// the file's name.
void tell_decisions(const std::string& file, const motion::Clip& clip, std::ostream& out);

}  // namespace mimicx::run
