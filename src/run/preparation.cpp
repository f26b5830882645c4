#include "run/preparation.h"

#include <cmath>
#include <utility>

#include "core/number_text.h"
#include "fit/keypoint_fit.h"
#include "fit/pose_fit.h"
#include "import/world_transform.h"
#include "motion/prepare/prepare.h"
#include "record/run_folder.h"

namespace mimicx::run {
namespace {

NamedValues values_of(const motion::PreparationReport& r) {
  return {{"floor_shift_mm", r.floor_shift_mm},
          {"max_floor_shift_mm", r.max_floor_shift_mm},
          {"hinge_residual_mean_mm", r.hinge_residual_mean_mm},
          {"hinge_residual_max_mm", r.hinge_residual_max_mm},
          {"change_mean_mm", r.change_mean_mm},
          {"change_max_mm", r.change_max_mm},
          {"arms_moved_mm", r.arms_moved_mm},
          {"feet_planted_mm", r.feet_planted_mm},
          {"range_frames", static_cast<double>(r.range_frames)},
          {"range_deg", r.range_deg},
          {"passages", static_cast<double>(r.passages)},
          {"passages_left", static_cast<double>(r.passages_left)},
          {"foot_level_deg", r.foot_level_deg},
          {"flagged_frames", static_cast<double>(r.flagged_frames)},
          {"limb_frames", static_cast<double>(r.limb_frames)}};
}

NamedValues values_of(const fit::FitReport& r) {
  return {{"residual_before_percent", r.residual_before},
          {"residual_after_percent", r.residual_after},
          {"iterations", static_cast<double>(r.iterations)},
          {"focal_scale", r.focal_scale},
          {"tilt_deg", r.tilt_deg},
          {"shape_change", r.shape_change},
          {"keypoint_sigma_percent", r.keypoint_sigma},
          {"keypoint_sigma_max_percent", r.keypoint_sigma_max},
          {"confidence_power", r.confidence_power},
          {"lead_frames", r.lead_frames},
          {"swapped_frames", static_cast<double>(r.swapped_frames)},
          {"dropped_points", static_cast<double>(r.dropped_points)},
          {"change_mean_mm", r.change_mean_mm},
          {"change_max_mm", r.change_max_mm}};
}

motion::PreparationConfig preparing(const CorrectionConfig& correction) {
  motion::PreparationConfig config;
  if (correction.as_is)
    config.ranges = config.separate = config.level_feet = config.ground = config.plant =
        config.bridge_flagged = false;
  return config;
}

/// Finds the scene of a motion that was read on the flat floor, tells it, and reads the motion again on it.
void put_on_found_scene(const std::filesystem::path& path, import::ReadConfig read, motion::Clip& clip) {
  const audit::FoundScene found = find_scene_of_file(clip);
  read.scene = found.scene;
  if (!found.scene.flat()) clip = import::read_motion(path, read);
  std::vector<std::string> words = found.words;
  if (words.empty()) words.emplace_back("no plate found, a flat floor");
  for (const std::string& line : words) clip.decide("scene: " + line);
}

/// A fit moves the feet of an estimate by decimetres, and against each other by more than plates reach beyond
/// the soles that they were found by: they are put where the fitted feet and hips are. Where nothing
/// is found in the fitted motion, the scene stays.
/// @return a note
std::string find_plates_again(motion::Clip& fitted) {
  const audit::FoundScene again = audit::find_scene(fitted);
  if (again.scene.flat()) return "scene: not found again in the fitted motion: it stays where it was";
  fitted.scene = again.scene;
  std::string note = "scene in the fitted motion";
  const char* separator = ": ";
  for (const std::string& line : again.words) {
    note += separator + line;
    separator = "; ";
  }
  return note;
}

/// Mean height of the pelvis, m.
double pelvis_height(const PerFrame<BodyPoses>& poses) {
  double sum = 0.0;
  for (const BodyPoses& pose : poses) sum += pose.p_WB[kPelvis].z();
  return sum / poses.count();
}

/// Where the user gave the height of the floor, frames are still put on it: by much if that height is wrong.
void note_floor(PreparedMotion& motion) {
  constexpr double kFarFromFloor = 0.05;  // m, on average
  const double moved = pelvis_height(motion.reference.poses) - pelvis_height(motion::poses_of(motion.input));
  if (std::abs(moved) > kFarFromFloor)
    motion.notes.push_back(formatted("the feet are not on the floor that --floor gives: moved %s by %.2f m",
                                     moved > 0.0 ? "up" : "down", std::abs(moved)));
}

}  // namespace

std::string reading_of(const import::ReadConfig& read) {
  std::string text = read.text();
  for (const std::filesystem::path& file : {read.smplx, read.joint_map})
    if (!file.empty()) text += ' ' + record::checksum_or_none(file);
  return text;
}

audit::FoundScene find_scene_of_file(motion::Clip clip) {
  if (!clip.place.isZero(0.0)) import::shift_world(-clip.place, clip);
  return audit::find_scene(clip);
}

NamedValues settings_of(const CorrectionConfig& correction) {
  const bool fitted = correction.fits_keypoints();
  return {{"fit", fitted ? 1.0 : 0.0},
          {"as_is", correction.as_is ? 1.0 : 0.0},
          {"keypoints", fitted || correction.unfitted_keypoints ? 1.0 : 0.0}};
}

PreparedMotion prepare_motion(const std::filesystem::path& path, const import::ReadConfig& read,
                              const CorrectionConfig& correction, int threads) {
  return prepare_motion(import::read_motion(path, read), path, read, correction, threads);
}

PreparedMotion prepare_motion(motion::Clip input, const std::filesystem::path& path,
                              const import::ReadConfig& read, const CorrectionConfig& correction,
                              int threads) {
  PreparedMotion motion;
  fit::FitConfig config;
  config.threads = threads;
  motion.input = std::move(input);
  const bool finds_scene = read.scene_from_motion && motion.input.scene.flat() && motion.input.frames() > 2;
  if (finds_scene) put_on_found_scene(path, read, motion.input);
  motion.has_fit = correction.fits_keypoints() && motion.input.keypoints.has_value();
  const int fewest = motion.has_fit ? 3 : 2;
  if (motion.input.frames() < fewest)
    throw DataError(path.string(), "", "at least " + std::to_string(fewest) + " frames",
                    std::to_string(motion.input.frames()));
  fit::FitReport fitting, planting;
  if (motion.has_fit) {
    motion.fitted = fit::fit_keypoints(motion.input, config, &fitting);
    motion.has_fit = fitting.fitted;
    if (motion.has_fit) motion.fit_values = values_of(fitting);
  }
  if (correction.as_is)
    motion.fitted = motion.input;
  else if (!motion.has_fit)
    motion.fitted = fit::fit_poses(motion.input, config, &planting);
  if (finds_scene && motion.has_fit && !motion.input.scene.flat())
    motion.notes.push_back(find_plates_again(motion.fitted));
  for (const fit::FitReport* report : {&fitting, &planting})
    motion.notes.insert(motion.notes.end(), report->notes.begin(), report->notes.end());
  motion::PreparationReport report;
  const fit::FitReport& bridged = motion.has_fit ? fitting : planting;
  motion::PreparationConfig preparation = preparing(correction);
  preparation.sees = motion.has_fit;
  preparation.flagged = bridged.flagged;
  motion.reference = motion::prepare_reference(motion.fitted, preparation, &report);
  report.limb_frames += bridged.limb_frames;
  if (!motion.has_fit && !correction.unfitted_keypoints) motion.reference.keypoints.reset();
  if (motion.input.on_floor) note_floor(motion);
  motion.preparation_values = values_of(report);
  motion.preparation_values.emplace_back("pose_fit_mean_mm", planting.change_mean_mm);
  motion.preparation_values.emplace_back("pose_fit_max_mm", planting.change_max_mm);
  motion.notes.insert(motion.notes.end(), report.notes.begin(), report.notes.end());
  return motion;
}

void tell_decisions(const std::string& file, const motion::Clip& clip, std::ostream& out) {
  for (const std::string& line : import::told_decisions(file, clip)) out << line << '\n';
}

}  // namespace mimicx::run
