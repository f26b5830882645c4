#include "physics/mjcf.h"

#include <algorithm>
#include <iostream>

#include "commands.h"
#include "motion/clip.h"

namespace mimicx {

int run_export_mjcf(const std::vector<double>& betas, const std::filesystem::path& motion,
                    const std::filesystem::path& out) {
  std::array<double, kBetas> shape{};
  if (!motion.empty()) {
    const Clip clip = read_clip(motion);
    for (const auto& warning : clip.warnings) std::cerr << motion.string() << ": " << warning << '\n';
    shape = clip.usable_betas();
  } else if (betas.size() <= shape.size()) {
    std::copy(betas.begin(), betas.end(), shape.begin());
  } else {
    throw UsageError("--betas: expected at most 10 numbers, found " + std::to_string(betas.size()));
  }
  if (out.has_parent_path()) std::filesystem::create_directories(out.parent_path());
  write_file_atomically(out, to_mjcf(make_character(shape), SimulationOptions{}));
  return kAllGood;
}

}  // namespace mimicx
