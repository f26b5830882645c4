/// From a motion file to a reference: keypoint fit (or, without keypoints, the fit of poses alone), then
/// preparation. Every method begins with it.
///
/// Eq. 3 rewards agreement with the keypoints, Eq. 2 with the reference. If the reference was not fitted onto
/// the keypoints, the two contradict each other; such a reference has no keypoints, unless they are requested
/// (the paper's method, which has no fit). docs/method.md §5
///
/// Where the scene is asked from the motion (`ReadConfig::scene_from_motion`), it is found in the motion as
/// it is read, and once more in the fitted one (docs/scenes.md, "Finding the scene").
///
/// It never opens any ground truth.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "audit/scene_search.h"
#include "core/named_values.h"
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

/// How much of a motion is corrected before it becomes the reference. By default, its poses are fitted to
/// their own standing feet and balance, and prepared.
struct CorrectionConfig {
  bool fit = false;                 ///< fit it to its keypoints instead, if it has any
  bool as_is = false;               ///< only resample, and make hinges of knees and elbows, whatever `fit` is
  bool unfitted_keypoints = false;  ///< Eq. 3 also rewards keypoints that the motion was not fitted to

  bool fits_keypoints() const { return fit && !as_is; }
};

/// As manifests list it, 0 or 1: `fit`, whether motions are moved onto their keypoints; `as_is`; `keypoints`,
/// whether Eq. 3 sees keypoints.
NamedValues settings_of(const CorrectionConfig& correction);

/// @param threads  do not influence the result
/// @throws DataError as reading, fitting and preparing do
PreparedMotion prepare_motion(const std::filesystem::path& path, const import::ReadConfig& read,
                              const CorrectionConfig& correction, int threads = 1);

/// The same of a motion that was read already, with these settings.
PreparedMotion prepare_motion(motion::Clip input, const std::filesystem::path& path,
                              const import::ReadConfig& read, const CorrectionConfig& correction,
                              int threads = 1);

/// All that decides how files are read, as manifests record it: `ReadConfig::text`, and the checksums of the
/// files that it names.
std::string reading_of(const import::ReadConfig& read);

/// `audit::find_scene` in the world of the file, from which reading may have moved the motion.
audit::FoundScene find_scene_of_file(motion::Clip clip);

/// Prints `import::told_decisions`.
void tell_decisions(const std::string& file, const motion::Clip& clip, std::ostream& out);

}  // namespace mimicx::run
