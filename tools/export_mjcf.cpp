#include "physics/mjcf.h"

#include <algorithm>
#include <iostream>

#include "commands.h"
#include "motion/import/motion_file.h"
#include "pipeline/preparation.h"

namespace mimicx {
namespace {

Character character_of_shape(const std::vector<double>& betas) {
  std::array<double, kBetas> shape{};
  if (betas.size() > shape.size())
    throw UsageError("--betas: expected at most 10 numbers, found " + std::to_string(betas.size()));
  std::copy(betas.begin(), betas.end(), shape.begin());
  return make_character(shape);
}

/// The very body that `convert` writes qpos for and `adapt` simulates: read in the same way.
Character character_of_motion(const std::filesystem::path& motion, const ReadConfig& read) {
  const Clip clip = read_motion(motion, read);
  tell_decisions(motion.string(), clip, std::cerr);
  return character_of(clip);
}

}  // namespace

int run_export_mjcf(const std::vector<double>& betas, const std::filesystem::path& motion,
                    const ReadConfig& read, const std::filesystem::path& out) {
  if (motion.empty() && !read.text().empty())
    throw UsageError("export-mjcf: " + read.text() +
                     " says how to read a motion, and there is none: --motion FILE");
  const Character character = motion.empty() ? character_of_shape(betas) : character_of_motion(motion, read);
  if (out.has_parent_path()) std::filesystem::create_directories(out.parent_path());
  write_file_atomically(out, to_mjcf(character, SimulationConfig{}));
  return kAllGood;
}

}  // namespace mimicx
