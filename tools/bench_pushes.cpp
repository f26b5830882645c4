// How well the stored feedback gains hold their plans: pushes of the pelvis, once a second, in random
// directions. Reads a folder of `mimicx plan --gains`.
//   bench_pushes RUN [SPEED]     SPEED: change of the pelvis' velocity by one push, m/s; default 0.1
// Exit status: 0 done, 1 a file could not be read, 2 usage.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "motion/clip_file.h"
#include "pipeline/output/plan_file.h"
#include "pipeline/record/run_folder.h"

namespace mimicx::tools {
namespace {

control::PushResult pushed(const pipeline::record::RunFolder& run, const std::string& name,
                           const control::PushTest& test) {
  const pipeline::output::StoredPlan stored = pipeline::output::read_plan(run.plan(name));
  const Character character = motion::character_of(motion::read_clip(run.reference(name)));
  const control::System system =
      control::make_system(character, stored.simulation, stored.reference, stored.fps);
  return control::test_pushes(system, control::make_cost(system, {}), control::trajectory_of(stored.plan),
                              pipeline::output::read_gains(run.gains(name)), test);
}

void print_all(const pipeline::record::RunFolder& run, const control::PushTest& test) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(run.root / "gains"))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  std::printf("%-40s followed of %d   frames kept   (pushes of %g m/s)\n", "motion", test.trials, test.speed);
  int held = 0;
  for (const std::string& name : names) {
    const control::PushResult result = pushed(run, name, test);
    held += 8 * result.followed >= 7 * test.trials;
    std::printf("%-40s %14d %13.0f\n", name.c_str(), result.followed, result.frames_kept);
  }
  std::printf("at least 7 of 8 trials are followed in %d of %zu motions\n", held, names.size());
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  const double speed = argc == 3 ? std::strtod(argv[2], nullptr) : 0.1;
  if (argc < 2 || argc > 3 || argv[1][0] == '-' || !(speed > 0.0)) {
    std::fprintf(stderr, "usage: bench_pushes RUN [SPEED]\n");
    return 2;
  }
  try {
    mimicx::tools::print_all(mimicx::pipeline::record::RunFolder{argv[1]}, {.speed = speed});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_pushes: %s\n", error.what());
    return 1;
  }
}
