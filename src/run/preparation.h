/// From a motion file to a reference: keypoint fit (or, without keypoints, the fit of poses alone), then
/// preparation. Every method begins with it.
///
/// Eq. 3 rewards agreement with the keypoints, Eq. 2 with the reference. If the reference was not fitted onto
/// the keypoints, the two contradict each other; such a reference has no keypoints, unless they are requested
/// (the paper's method, which has no fit). docs/method.md §5
///
/// It never opens any ground truth.
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
  motion::Clip input;              ///< as it was read, with the decisions of the reader
  motion::Clip fitted;             ///< moved onto its keypoints, or by the fit of poses alone
  bool has_fit = false;            ///< onto its keypoints
  motion::Reference reference;     ///< with keypoints, for Eq. 3, if it was fitted onto them or they are kept
  NamedValues fit_values;          ///< of the fit's report; empty without a fit
  NamedValues preparation_values;  ///< of the preparation's report
  std::vector<std::string> notes;  ///< warnings of all steps
};

/// How much of a motion is corrected before it becomes the reference.
enum class Correction {
  kNone,      ///< only resampling, and hinges for knees and elbows
  kPoses,     ///< fit of poses alone and preparation; keypoints are ignored
  kKeypoints  ///< keypoint fit and preparation; without keypoints as kPoses
};

/// @param fit    onto the keypoints, if there are any
/// @param as_is  correct nothing, regardless of `fit`
Correction correction_of(bool fit, bool as_is);

/// How motions are corrected, as manifests list it, 0 or 1: `fit`, whether they are moved onto their
/// keypoints; `as_is`; `keypoints`, whether Eq. 3 sees keypoints.
NamedValues correction_settings(bool fit, bool as_is, bool keep_keypoints);

/// @param threads         do not influence the result
/// @param keep_keypoints  an unfitted reference keeps its keypoints for Eq. 3
/// @throws DataError as reading, fitting and preparing do
PreparedMotion prepare_motion(const std::filesystem::path& path, const import::ReadConfig& read,
                              Correction correction, int threads = 1, bool keep_keypoints = false);

/// Prints the reader's decisions (their summary if there is one) and warnings, a line each after the file's
/// name.
void tell_decisions(const std::string& file, const motion::Clip& clip, std::ostream& out);

}  // namespace mimicx::run
