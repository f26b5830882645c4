#include "core/file.h"
#include "fit/keypoint_fit.h"
#include "fit/pose_fit.h"
#include "motion/clip_file.h"

#include <cstdio>
#include <iostream>
#include <memory>

#include "commands.h"
#include "core/error.h"
#include "files/inputs.h"
#include "record/folder_lock.h"
#include "record/json.h"
#include "record/outputs.h"
#include "record/utf8_names.h"
#include "run/preparation.h"
#include "shared_arguments.h"
#include "simulation_commands.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct FitArguments {
  std::vector<std::string> inputs;
  std::filesystem::path out, json;
  bool poses = false;
  fit::FitConfig config;
  import::ReadConfig read;
  std::vector<std::string> settings;
  bool force = false;
};

void print(std::FILE* out, const std::string& name, const fit::FitReport& r) {
  std::fprintf(out, "%-24s %7.2f %7.2f %8.4f %7.2f %7.2f %7.2f %7.2f %6d %6d %8.0f %8.0f\n", name.c_str(),
               r.residual_before, r.residual_after, r.focal_scale, r.tilt_deg, r.shape_change,
               r.keypoint_sigma, r.lead_frames, r.swapped_frames, r.dropped_points, r.change_mean_mm,
               r.change_max_mm);
}

record::Json fit_json(const std::string& name, const fit::FitReport& r) {
  using record::number;
  return {{"motion", record::to_utf8(name)},
          {"residual_before_percent", number(r.residual_before)},
          {"residual_after_percent", number(r.residual_after)},
          {"focal_scale", number(r.focal_scale)},
          {"tilt_deg", number(r.tilt_deg)},
          {"shape_change", number(r.shape_change)},
          {"keypoint_sigma_percent", number(r.keypoint_sigma)},
          {"lead_frames", number(r.lead_frames)},
          {"swapped_frames", r.swapped_frames},
          {"dropped_points", r.dropped_points},
          {"change_mean_mm", number(r.change_mean_mm)},
          {"change_max_mm", number(r.change_max_mm)},
          {"notes", r.notes}};
}

/// The output of every input, claimed before any work.
std::vector<std::filesystem::path> claimed_outputs(const std::vector<files::MotionInput>& inputs,
                                                   const FitArguments& a) {
  record::Outputs outputs(files::paths_of(inputs), a.force);
  std::vector<std::filesystem::path> paths;
  for (const std::string& name : files::unique_names(inputs)) {
    paths.push_back(a.out / (name + ".npz"));
    outputs.claim(paths.back());
  }
  if (!is_standard_output(a.json)) outputs.claim(a.json, record::kJsonOpening);
  files::require_results_apart(a.inputs, a.out, paths);
  return paths;
}

int fit(const FitArguments& a) {
  const std::vector<files::MotionInput> inputs = files::find_motions(a.inputs, a.out, &std::cerr);
  const std::vector<std::filesystem::path> outputs = claimed_outputs(inputs, a);
  const record::FolderLock lock(a.out);
  record::Json rows = record::Json::array();
  std::fprintf(table_file(a.json),
               "%-24s %7s %7s %8s %7s %7s %7s %7s %6s %6s %8s %8s\n"
               "%-24s %7s %7s %8s %7s %7s %7s %7s %6s %6s %8s %8s\n",
               "motion", "before", "after", "focal", "tilt", "shape", "sigma", "lead", "swaps", "drops",
               "change", "largest", "", "% box", "% box", "scale", "deg", "beta", "% box", "frames", "frames",
               "points", "mm", "mm");
  bool all_good = true;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::string& file = inputs[i].path;
    try {
      fit::FitReport report;
      const motion::Clip clip = import::read_motion(file, a.read);
      run::tell_decisions(file, clip, std::cerr);
      make_folder(outputs[i].parent_path());
      const motion::Clip fitted = (a.poses ? fit::fit_poses : fit::fit_keypoints)(clip, a.config, &report);
      motion::write_clip(outputs[i], fitted, motion::world_members(fitted));
      const std::string name = outputs[i].lexically_relative(a.out).replace_extension().generic_string();
      print(table_file(a.json), name, report);
      rows.push_back(fit_json(name, report));
      for (const std::string& note : report.notes) std::cerr << file << ": " << note << '\n';
    } catch (const std::exception& error) {
      std::cerr << file << ": left out: " << reason_of(error) << '\n';
      all_good = false;
    }
  }
  if (!a.json.empty()) write_json(a.json, record::document({{"motions", rows}}));
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace

void declare_fit(CommandLine& line) {
  const auto a = std::make_shared<FitArguments>();
  Command command =
      line.add("fit", "Fit motions to their 2D keypoints, if they have any",
               "mimicx fit DIR --out fitted             # the fit alone, no simulation\n"
               "mimicx fit DIR --out planted --poses    # without keypoints: feet, floor, balance");
  command.files("FILE", a->inputs, "motions and folders of them");
  command.folder("--out", a->out, "folder for the fitted motions").required();
  add_json(command, a->json);
  add_read_arguments(command, a->read);
  command.flag("--poses", a->poses,
               "ignore keypoints: plant the feet and balance the motion, as plan --no-fit does");
  const auto add_sigma = [&](const std::string& name, double& sigma, const std::string& what) {
    command.number(name, sigma, kFromZero, "standard error of " + what + "; 0: it is exact");
  };
  add_sigma("--focal-sigma", a->config.focal_sigma, "the focal length in the file, relative");
  add_sigma("--tilt-sigma", a->config.tilt_sigma, "the camera's tilt in the file, degrees");
  add_sigma("--beta-sigma", a->config.beta_sigma, "each entry of the shape in the file");
  add_settings(command, a->settings);
  add_force(command, a->force);
  command.action([a] {
    apply_settings(a->settings, a->config);
    return fit(*a);
  });
}

}  // namespace mimicx::tools
