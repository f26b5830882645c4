#include "pipeline/preparation.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <system_error>

#include "motion/fit/poses.h"
#include "motion/prepare.h"

namespace mimicx::pipeline {
namespace {

NamedValues values_of(const motion::PreparationReport& r) {
  return {{"floor_shift_mm", r.floor_shift_mm},
          {"max_floor_shift_mm", r.max_floor_shift_mm},
          {"hinge_residual_mean_mm", r.hinge_residual_mean_mm},
          {"hinge_residual_max_mm", r.hinge_residual_max_mm},
          {"change_mean_mm", r.change_mean_mm},
          {"change_max_mm", r.change_max_mm},
          {"arms_moved_mm", r.arms_moved_mm},
          {"foot_level_deg", r.foot_level_deg},
          {"flagged_frames", static_cast<double>(r.flagged_frames)},
          {"limb_frames", static_cast<double>(r.limb_frames)}};
}

NamedValues values_of(const motion::fit::FitReport& r) {
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

motion::PreparationConfig preparing(Correction correction) {
  motion::PreparationConfig config;
  if (correction == Correction::kNone)
    config.separate = config.level_feet = config.ground = config.bridge_flagged = false;
  return config;
}

/// "in: left out: notes.txt, walk.clean.npz (no motions, or made by an earlier run)"
void tell_skipped(const std::string& folder, std::vector<std::string> names, std::ostream& out) {
  if (names.empty()) return;
  std::sort(names.begin(), names.end());
  out << folder << ": left out: ";
  for (std::size_t i = 0; i < names.size(); ++i) out << (i > 0 ? ", " : "") << names[i];
  out << " (no motions, or made by an earlier run)\n";
}

/// Every file once, as it was spelled first.
std::vector<std::string> each_once(const std::vector<std::string>& files) {
  std::vector<std::string> once;
  std::set<std::filesystem::path> seen;
  for (const std::string& file : files) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
    if (seen.insert(error ? std::filesystem::path(file) : path).second) once.push_back(file);
  }
  return once;
}

}  // namespace

PreparedMotion prepare_motion(const std::filesystem::path& path, const motion::import::ReadConfig& read,
                              Correction correction, int threads) {
  PreparedMotion motion;
  motion::fit::FitConfig config;
  config.threads = threads;
  motion.input = motion::import::read_motion(path, read);
  motion.has_fit = correction == Correction::kKeypoints && motion.input.keypoints.has_value();
  const int fewest = motion.has_fit ? 3 : 2;
  if (motion.input.frames() < fewest)
    throw DataError(path.string(), "", "at least " + std::to_string(fewest) + " frames",
                    std::to_string(motion.input.frames()));
  motion::fit::FitReport fitting, planting;
  if (motion.has_fit) {
    motion.fitted = motion::fit::fit_keypoints(motion.input, config, &fitting);
    motion.fit_values = values_of(fitting);
  } else if (correction == Correction::kNone) {
    motion.fitted = motion.input;
  } else {
    motion.fitted = motion::fit::fit_poses(motion.input, config, &planting);
  }
  for (const motion::fit::FitReport* report : {&fitting, &planting})
    motion.notes.insert(motion.notes.end(), report->notes.begin(), report->notes.end());
  motion::PreparationReport report;
  motion.reference = motion::prepare_reference(motion.fitted, preparing(correction), &report);
  if (!motion.has_fit) motion.reference.keypoints.reset();
  motion.preparation_values = values_of(report);
  motion.preparation_values.emplace_back("pose_fit_mean_mm", planting.change_mean_mm);
  motion.preparation_values.emplace_back("pose_fit_max_mm", planting.change_max_mm);
  motion.notes.insert(motion.notes.end(), report.notes.begin(), report.notes.end());
  return motion;
}

void tell_decisions(const std::string& file, const motion::Clip& clip, std::ostream& out) {
  for (const auto* lines : {&clip.decisions, &clip.warnings})
    for (const std::string& line : *lines) out << file << ": " << line << '\n';
}

std::vector<std::string> expand_inputs(const std::vector<std::string>& inputs, std::ostream* messages) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    std::error_code error;
    const bool folder = std::filesystem::is_directory(input, error);
    const auto entries =
        folder ? std::filesystem::directory_iterator(input, error) : std::filesystem::directory_iterator();
    if (!folder || error) {  // what cannot be looked into stands for itself: reading it says why
      files.push_back(input);
      continue;
    }
    const std::size_t before = files.size();
    std::vector<std::string> skipped;
    for (auto at = entries; !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
      const bool taken =
          motion::import::is_motion_file(at->path()) && at->path().stem().extension() != ".clean";
      (taken ? files : skipped).push_back(taken ? at->path().string() : at->path().filename().string());
    }
    if (messages != nullptr) tell_skipped(input, skipped, *messages);
    if (files.size() == before && inputs.size() == 1)
      throw DataError(input, "", "motion files in this folder", "none");
    if (error || files.size() == before) files.push_back(input);
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end());
  }
  return each_once(files);
}

}  // namespace mimicx::pipeline
