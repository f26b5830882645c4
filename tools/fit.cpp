#include "motion/fit/fit.h"

#include <cstdio>
#include <iostream>

#include "commands.h"
#include "motion/clip_file.h"
#include "pipeline/preparation.h"
#include "pipeline/record/run_folder.h"

namespace mimicx {
namespace {

void print(const std::string& name, const FitReport& r) {
  std::printf("%-24s %7.2f %7.2f %8.4f %7.2f %7.2f %6d %6d %8.0f %8.0f\n", name.c_str(), r.residual_before,
              r.residual_after, r.focal_scale, r.tilt_deg, r.shape_change, r.swapped_frames, r.dropped_points,
              r.change_mean_mm, r.change_max_mm);
}

}  // namespace

int run_fit(const std::vector<std::string>& inputs, const std::filesystem::path& out, const FitConfig& config,
            const ReadConfig& read) {
  std::filesystem::create_directories(out);
  std::printf("%-24s %7s %7s %8s %7s %7s %6s %6s %8s %8s\n%-24s %7s %7s %8s %7s %7s %6s %6s %8s %8s\n",
              "motion", "before", "after", "focal", "tilt", "shape", "swaps", "drops", "change", "largest",
              "", "% box", "% box", "scale", "deg", "beta", "frames", "points", "mm", "mm");
  std::vector<std::string> names;
  bool all_good = true;
  for (const std::string& file : expand_inputs(inputs)) {
    names.push_back(unique_name(file, names));
    try {
      FitReport report;
      const Clip clip = read_motion(file, read);
      tell_decisions(file, clip, std::cerr);
      write_clip(out / (names.back() + ".npz"), fit_keypoints(clip, config, &report));
      print(names.back(), report);
      for (const std::string& note : report.notes) std::cerr << file << ": " << note << '\n';
    } catch (const std::exception& error) {
      std::cerr << file << ": left out: " << error.what() << '\n';
      all_good = false;
    }
  }
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace mimicx
