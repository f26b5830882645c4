#include "physics/mjcf.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include "commands.h"
#include "core/file.h"
#include "import/motion_file.h"
#include "record/outputs.h"
#include "run/preparation.h"
#include "shared_arguments.h"

namespace mimicx::tools {
namespace {

struct ExportMjcfArguments {
  std::vector<double> betas;          ///< at most 10, missing ones are 0
  std::filesystem::path motion, out;  ///< motion: use its body instead; empty: none
  import::ReadConfig read;
  bool force = false;
};

Character character_of_shape(const std::vector<double>& betas) {
  std::array<double, kBetas> shape{};
  if (betas.size() > shape.size())
    throw UsageError("--betas: expected at most 10 numbers, found " + std::to_string(betas.size()));
  std::copy(betas.begin(), betas.end(), shape.begin());
  return make_character(shape);
}

motion::Clip told_motion(const std::filesystem::path& motion, const import::ReadConfig& read) {
  const motion::Clip clip = import::read_motion(motion, read);
  run::tell_decisions(motion.string(), clip, std::cerr);
  return clip;
}

int export_mjcf(const ExportMjcfArguments& a) {
  if (a.motion.empty() && !a.read.text().empty())
    throw UsageError("export-mjcf: " + a.read.text() +
                     " says how to read a motion, but no --motion FILE is given");
  record::Outputs({a.motion.string()}, a.force).claim(a.out, physics::kMjcfOpening);
  const motion::Clip clip = a.motion.empty() ? motion::Clip() : told_motion(a.motion, a.read);
  // The same body for which `convert` writes qpos and which `adapt` simulates.
  const Character character = a.motion.empty() ? character_of_shape(a.betas) : motion::character_of(clip);
  make_folder(a.out.parent_path());
  write_file_atomically(a.out, physics::to_mjcf(character, physics::SimulationConfig{}, {}, clip.scene));
  return kAllGood;
}

}  // namespace

void declare_export_mjcf(CommandLine& line) {
  const auto a = std::make_shared<ExportMjcfArguments>();
  Command command = line.add("export-mjcf", "Write the character as a MuJoCo model",
                             "mimicx export-mjcf body.xml --motion clip.npz   # the body of a motion\n"
                             "mimicx export-mjcf tall.xml --betas 2,-1        # a shape");
  command.file("OUT", a->out, "where to write it: .xml");
  const Option betas =
      command.numbers("--betas", a->betas, {-5.0, 5.0},
                      "shape: up to 10 numbers of -5 to 5, separated by commas; default: all 0");
  command
      .path("--motion", a->motion,
            "use the body and the scene of this motion, as `convert` does for its qpos")
      .excludes(betas);
  add_read_arguments(command, a->read);
  add_force(command, a->force);
  command.action([a] { return export_mjcf(*a); });
}

}  // namespace mimicx::tools
