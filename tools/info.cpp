#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "import/motion_file.h"
#include "motion/keypoint_names.h"
#include "motion/prepare/prepare.h"
#include "shared_arguments.h"

namespace mimicx::tools {
namespace {

struct InfoArguments {
  std::filesystem::path file;
  import::ReadConfig read;
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

void describe_file(const motion::Clip& clip) {
  for (const auto& decision : clip.decisions) std::printf("decided      %s\n", decision.c_str());
  std::printf("frames       %d at %g fps, %.2f s\n", clip.frames(), clip.fps, clip.frames() / clip.fps);
  std::printf("body model   %s, gender %s\n", clip.body_model.c_str(), clip.gender.c_str());
  std::printf("betas       ");
  for (double b : clip.betas) std::printf(" %g", b);
  std::printf("\n");
  if (clip.keypoints)
    std::printf("keypoints    %zu per frame, %td of them with a place on the body, %s camera\n",
                clip.keypoints->names.size(), usable_among(clip.keypoints->names),
                clip.keypoints->extrinsics.size() > 1 ? "moving" : "static");
  else
    std::printf("keypoints    none\n");
  if (!clip.passthrough.empty()) {
    std::printf("passed on   ");
    for (const auto& [key, array] : clip.passthrough) std::printf(" %s", name_of_member(key).c_str());
    std::printf("\n");
  }
}

/// @param told  warnings of the file, which preparation repeats
void describe_preparation(const motion::Reference& reference, const motion::PreparationReport& report,
                          const std::vector<std::string>& told) {
  std::printf("prepared     %d frames at %g fps\n", reference.size(), reference.fps);
  std::printf("  floor      moved by %.1f mm, at most %.1f mm in a frame\n", report.floor_shift_mm,
              report.max_floor_shift_mm);
  std::printf("  hinges     joints moved by %.2f mm on average, %.2f mm at most\n",
              report.hinge_residual_mean_mm, report.hinge_residual_max_mm);
  std::printf("  change     %.1f mm on average, %.1f mm at most\n", report.change_mean_mm,
              report.change_max_mm);
  std::printf("  feet       levelled by %.1f degrees\n", report.foot_level_deg);
  std::printf("  flagged    %d frames\n", report.flagged_frames);
  for (const auto& note : report.notes)
    if (std::find(told.begin(), told.end(), note) == told.end())
      std::printf("  note       %s\n", note.c_str());
}

int info(const InfoArguments& a) {
  const motion::Clip clip = import::read_motion(a.file, a.read);
  describe_file(clip);
  for (const auto& warning : clip.warnings) std::printf("warning      %s\n", warning.c_str());
  if (clip.frames() < 2) throw DataError(a.file.string(), "", "at least 2 frames to prepare it", "1");
  motion::PreparationReport report;
  const motion::Reference reference = motion::prepare_reference(clip, {}, &report);
  describe_preparation(reference, report, clip.warnings);
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
  add_read_arguments(command, a->read);
  command.action([a] { return info(*a); });
}

}  // namespace mimicx::tools
