#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

#include "commands.h"
#include "import/motion_file.h"
#include "motion/keypoint_names.h"
#include "record/json.h"
#include "record/outputs.h"
#include "record/utf8_names.h"
#include "run/preparation.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct InfoArguments {
  std::filesystem::path file;
  std::filesystem::path json;
  import::ReadConfig read;
  bool force = false;
};

/// Number of keypoints that the fit can use.
std::ptrdiff_t usable_among(const std::vector<std::string>& names) {
  return std::count_if(names.begin(), names.end(),
                       [](const std::string& name) { return motion::place_of_keypoint(name).has_value(); });
}

/// The name of a passed-through member in the file.
std::string name_of_member(const std::string& key) {
  if (key == "poses_rest") return "poses[66:]";
  return key == "betas_rest" ? "betas[10:]" : key;
}

void describe_file(std::FILE* out, const motion::Clip& clip) {
  for (const auto& decision : clip.decisions) std::fprintf(out, "decided      %s\n", decision.c_str());
  std::fprintf(out, "frames       %d at %g fps, %.2f s\n", clip.frames(), clip.fps, clip.frames() / clip.fps);
  std::fprintf(out, "body model   %s, gender %s\n", clip.body_model.c_str(), clip.gender.c_str());
  std::fprintf(out, "betas       ");
  for (double b : clip.betas) std::fprintf(out, " %g", b);
  std::fprintf(out, "\n");
  if (clip.keypoints)
    std::fprintf(out, "keypoints    %zu per frame, %td of them with a place on the body, %s camera\n",
                 clip.keypoints->names.size(), usable_among(clip.keypoints->names),
                 clip.keypoints->extrinsics.size() > 1 ? "moving" : "static");
  else
    std::fprintf(out, "keypoints    none\n");
  if (!clip.passthrough.empty()) {
    std::fprintf(out, "passed on   ");
    for (const auto& [key, array] : clip.passthrough) std::fprintf(out, " %s", name_of_member(key).c_str());
    std::fprintf(out, "\n");
  }
}

/// @param told  warnings of the file, which preparation repeats
void describe_preparation(std::FILE* out, const run::PreparedMotion& motion,
                          const std::vector<std::string>& told) {
  const auto value = [&](const char* name) { return value_of(motion.preparation_values, name); };
  std::fprintf(out, "prepared     %d frames at %g fps\n", motion.reference.size(), motion.reference.fps);
  const NamedValues& fit = motion.has_fit ? motion.fit_values : motion.preparation_values;
  const std::string change = motion.has_fit ? "change_" : "pose_fit_";
  std::fprintf(out, "  fit        to %s: joints moved by %.1f mm on average, %.1f mm at most\n",
               motion.has_fit ? "keypoints" : "standing feet and balance", value_of(fit, change + "mean_mm"),
               value_of(fit, change + "max_mm"));
  std::fprintf(out, "  floor      moved by %.1f mm, at most %.1f mm in a frame\n", value("floor_shift_mm"),
               value("max_floor_shift_mm"));
  std::fprintf(out, "  hinges     joints moved by %.2f mm on average, %.2f mm at most\n",
               value("hinge_residual_mean_mm"), value("hinge_residual_max_mm"));
  std::fprintf(out, "  change     %.1f mm on average, %.1f mm at most\n", value("change_mean_mm"),
               value("change_max_mm"));
  std::fprintf(out, "  feet       levelled by %.1f degrees\n", value("foot_level_deg"));
  std::fprintf(out, "  flagged    %.0f frames\n", value("flagged_frames"));
  for (const auto& note : motion.notes)
    if (std::find(told.begin(), told.end(), note) == told.end())
      std::fprintf(out, "  note       %s\n", note.c_str());
}

record::Json preparation_json(const run::PreparedMotion& motion) {
  using record::number;
  const auto value = [&](const char* name) { return number(value_of(motion.preparation_values, name)); };
  return {{"frames", motion.reference.size()},
          {"fps", number(motion.reference.fps)},
          {"floor_shift_mm", value("floor_shift_mm")},
          {"max_floor_shift_mm", value("max_floor_shift_mm")},
          {"hinge_residual_mean_mm", value("hinge_residual_mean_mm")},
          {"hinge_residual_max_mm", value("hinge_residual_max_mm")},
          {"change_mean_mm", value("change_mean_mm")},
          {"change_max_mm", value("change_max_mm")},
          {"foot_level_deg", value("foot_level_deg")},
          {"flagged_frames", static_cast<int>(value_of(motion.preparation_values, "flagged_frames"))},
          {"notes", motion.notes}};
}

record::Json clip_json(const std::string& file, const motion::Clip& clip) {
  using record::Json, record::number;
  Json keypoints(nullptr), passed_on = Json::array();
  if (clip.keypoints)
    keypoints = {{"count", clip.keypoints->names.size()},
                 {"usable", usable_among(clip.keypoints->names)},
                 {"moving_camera", clip.keypoints->extrinsics.size() > 1}};
  for (const auto& [key, array] : clip.passthrough) passed_on.push_back(name_of_member(key));
  return {{"file", record::to_utf8(file)}, {"frames", clip.frames()}, {"fps", number(clip.fps)},
          {"body_model", clip.body_model}, {"gender", clip.gender},   {"betas", clip.betas},
          {"keypoints", keypoints},        {"passed_on", passed_on},  {"decisions", clip.decisions},
          {"warnings", clip.warnings}};
}

int info(const InfoArguments& a) {
  if (!is_standard_output(a.json))
    record::Outputs({a.file.string()}, a.force).claim(a.json, record::kJsonOpening);
  std::FILE* out = table_file(a.json);
  const motion::Clip clip = import::read_motion(a.file, a.read);
  describe_file(out, clip);
  for (const auto& warning : clip.warnings) std::fprintf(out, "warning      %s\n", warning.c_str());
  record::Json json = clip_json(a.file.string(), clip);
  if (clip.frames() < 2) {
    std::cerr << a.file.string() << ": expected at least 2 frames to prepare it, found 1\n";
  } else {
    const run::PreparedMotion prepared = run::prepare_motion(clip, a.file, a.read, {.fit = true});
    describe_preparation(out, prepared, clip.warnings);
    json["prepared"] = preparation_json(prepared);
  }
  if (!a.json.empty()) write_json(a.json, record::document(json));
  return kAllGood;
}

}  // namespace

void declare_info(CommandLine& line) {
  const auto a = std::make_shared<InfoArguments>();
  Command command =
      line.add("info", "Show the contents of a motion file, reading decisions, and its preparation",
               "mimicx info clip.bvh           # axes, unit, frame rate, floor, body\n"
               "mimicx info clip.bvh --up z    # with a known up axis");
  command.file("FILE", a->file, "motion");
  add_json(command, a->json);
  add_read_arguments(command, a->read);
  add_force(command, a->force);
  command.action([a] { return info(*a); });
}

}  // namespace mimicx::tools
