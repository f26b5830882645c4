// Tests stored feedback gains and taught policies with pushes of the pelvis in random directions. Reads a
// folder of `mimicx plan --gains` or `mimicx adapt`.
//   bench_pushes RUN [SPEED [FRAMES]]     SPEED: change of the pelvis' velocity by one push, m/s; default 0.1
//                                         FRAMES: from push to push; default 30, a second
// Exit status: 0 done, 1 a file could not be read, 2 usage.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "files/plan_file.h"
#include "files/policy_file.h"
#include "motion/clip_file.h"
#include "record/run_folder.h"
#include "teaching/lessons.h"

namespace mimicx::tools {
namespace {

control::PushResult pushed(const record::RunFolder& run, const std::string& name,
                           const control::PushTest& test) {
  const files::StoredPlan stored = files::read_plan(run.plan(name));
  const motion::Clip clip = motion::read_clip(run.reference(name));
  const control::System system = control::make_system(motion::character_of(clip), stored.simulation,
                                                      stored.reference, stored.fps, clip.scene);
  return control::test_pushes(system, control::make_cost(system, {}), control::trajectory_of(stored.plan),
                              files::read_gains(run.gains(name)).gains, test);
}

control::PushResult pushed_policy(const record::RunFolder& run, const std::string& name,
                                  const control::PushTest& test) {
  const files::StoredPolicy policy = files::read_policy(run.policy(name));
  const rl::tracking::TrackingConfig task = policy.task();
  return teaching::test_pushes(rl::tracking::make_tracking_clip(policy.motion, task), task, policy.agent,
                               test);
}

/// A line for every motion that has a file in the folder of that name, and a last one; none without a folder.
template <class Pushed>
void print_all(const record::RunFolder& run, const char* kind, const control::PushTest& test,
               const Pushed& pushed) {
  if (!std::filesystem::exists(run.root / kind)) return;
  const std::vector<std::string> names = record::archive_names(run.root / kind);
  std::printf("%-40s followed of %d   frames kept   (pushes of %g m/s every %d frames)\n", kind, test.trials,
              test.speed, test.every);
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
  const double speed = argc >= 3 ? std::strtod(argv[2], nullptr) : 0.1;
  const int every = argc == 4 ? std::atoi(argv[3]) : 30;
  if (argc < 2 || argc > 4 || argv[1][0] == '-' || !(speed > 0.0) || every < 1) {
    std::fprintf(stderr, "usage: bench_pushes RUN [SPEED [FRAMES]]\n");
    return 2;
  }
  try {
    const mimicx::record::RunFolder run{argv[1]};
    const mimicx::control::PushTest test{.speed = speed, .every = every};
    mimicx::tools::print_all(run, "gains", test, mimicx::tools::pushed);
    mimicx::tools::print_all(run, "policies", test, mimicx::tools::pushed_policy);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_pushes: %s\n", error.what());
    return 1;
  }
}
