// Errors of the contact model, as tables: adhesion, friction beyond the cone, penetration and energy gain in
// violent contact; penetration, creep and jitter of bodies at rest. At 240 and 480 Hz with one to three
// linearisations of the contacts in a step (docs/physics.md §4). The tests of tests/physics bound them.
// bench_contact
#include <cstdio>

#include "physics/contact_scenes.h"
#include "physics/rest_poses.h"

namespace mimicx::tools {
namespace {

constexpr double kRates[] = {240.0, 480.0};

void print_scenes() {
  std::printf("\nviolent contact, %d characters, 3 s: impulses as shares of the normal impulse\n",
              physics::kLanes);
  std::printf("%-10s %5s %6s  %12s %10s %11s %13s\n", "scene", "Hz", "passes", "beyond cone", "adhesion",
              "deepest mm", "energy gained");
  for (physics::ContactScene scene :
       {physics::ContactScene::kFall, physics::ContactScene::kDrop, physics::ContactScene::kThrow})
    for (double rate : kRates)
      for (int passes : {1, 2, 3}) {
        const physics::SceneReport r = physics::run_scene(scene, rate, passes);
        std::printf("%-10s %5.0f %6d  %10.2f %% %8.3f %% %11.1f %11.2f %%\n",
                    physics::kSceneNames[static_cast<int>(scene)], rate, passes, 100 * r.outside_cone,
                    100 * r.adhesion, kMm * r.deepest, 100 * (r.energy_ratio - 1));
      }
}

void print_rest() {
  std::printf("\nat rest, after settling: depths under z = 0, forces as shares of the weight\n");
  std::printf("%-10s %5s %6s  %9s %10s %11s %11s %11s\n", "pose", "Hz", "passes", "mean mm", "deepest mm",
              "creep mm/s", "jitter", "force error");
  for (physics::RestPose pose : physics::kRestPoses)
    for (double rate : kRates)
      for (int passes : {1, 2, 3}) {
        const physics::RestReport r = physics::rest(pose, rate, passes);
        std::printf("%-10s %5.0f %6d  %9.2f %10.2f %11.3f %11.1e %11.1e\n",
                    physics::kRestPoseNames[static_cast<int>(pose)], rate, passes, kMm * r.mean_depth,
                    kMm * r.deepest, kMm * r.creep, r.jitter, r.force_error);
      }
}

void print_shares() {
  std::printf("\nwho carries the weight, 240 Hz, two passes, percent\n");
  for (physics::RestPose pose : physics::kRestPoses) {
    const physics::RestReport r = physics::rest(pose, kRates[0], 2);
    std::printf("%-10s", physics::kRestPoseNames[static_cast<int>(pose)]);
    for (int i = 0; i < kBodies; ++i)
      if (r.share[i] > 0.001) std::printf("  %s %.1f", kBodyNames[i].data(), 100 * r.share[i]);
    if (r.heel_share > 0.001) std::printf("  (heels %.1f)", 100 * r.heel_share);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace mimicx::tools

int main() {
  mimicx::tools::print_scenes();
  mimicx::tools::print_rest();
  mimicx::tools::print_shares();
  return 0;
}
