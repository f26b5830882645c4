// The accuracy that exporting a policy loses: policies of a run, and the same after `mimicx export-policy`,
// rolled out in the simulator and pushed.
//   bench_export RUN     a folder of `mimicx adapt`
// A line per policy: frames, and of each kind (as it is, float, int8) MPJPE and mean distance of the bodies
// from the motion that was taught, mm, and how many pushed trials are followed to the end; the bytes of the
// data in the header. Exit status: 0 done, 1 a file could not be read, 2 usage.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "files/policy_file.h"
#include "judge/scores.h"
#include "policy_export/exported_policy.h"
#include "record/run_folder.h"
#include "rl/tracking/tracking_rollout.h"
#include "teaching/lessons.h"

namespace mimicx::tools {
namespace {

using files::StoredPolicy;

struct Kept {
  double mpjpe = 0.0, distance = 0.0;  ///< mm
  int followed = 0;                    ///< of the pushed trials
  bool success = false;
};

/// @param taught  what distances are measured against
Kept try_out(const motion::Reference& taught, const StoredPolicy& policy, const control::PushTest& pushes) {
  const rl::tracking::TrackingConfig task = policy.task();
  const auto clip = rl::tracking::make_tracking_clip(policy.motion, task);
  const auto rollout = rl::tracking::roll_out(clip, task, rl::tracking::mean_action({policy.agent}));
  const judge::Scores scores = judge::score_simulated(taught, rollout);
  return {value_of(scores.values, "MPJPE"), value_of(scores.values, "gMPJPE"),
          teaching::test_pushes(clip, task, policy.agent, pushes).followed, scores.success};
}

/// Of what a header holds of motion and network.
std::size_t data_bytes(const policy_export::ExportedPolicy& exported) {
  std::size_t bytes = 0;
  policy_export::with_policy(exported, [&]<class Weight>(const policy_export::Policy<Weight>& policy) {
    using namespace policy_export;
    bytes += exported.motion.knots.size() * 2 + exported.motion.speeds.size() + (2 * kChannels + kSpeeds) * 4;
    bytes += exported.inputs.size() * (2 + 4 + 4 + (policy.power != nullptr ? 1 : 0));
    for (int l = 0; l < policy.layers; ++l) {
      const Layer<Weight>& layer = policy.layer[l];
      const auto inputs = static_cast<std::size_t>(layer.inputs),
                 outputs = static_cast<std::size_t>(layer.outputs);
      bytes += inputs * outputs * sizeof(Weight) + outputs * 4 * (layer.scales != nullptr ? 2 : 1);
    }
    bytes += kBodyCount * 3 * 8 + kShapeCount * 4;
  });
  return bytes;
}

void print_all(const record::RunFolder& run) {
  const std::vector<std::string> names = record::archive_names(run.root / "policies");
  const control::PushTest pushes{.speed = 0.1, .every = 15};
  std::printf("%-18s %6s | %21s | %21s %8s | %21s %8s\n", "", "", "as it is", "float", "bytes", "int8",
              "bytes");
  std::printf("%-18s %6s |%7s%8s%7s |%7s%8s%7s %8s |%7s%8s%7s %8s\n", "", "frames", "MPJPE", "gMPJPE",
              "pushes", "MPJPE", "gMPJPE", "pushes", "", "MPJPE", "gMPJPE", "pushes", "");
  Kept sums[3];
  int success[3] = {};
  for (const std::string& name : names) {
    const StoredPolicy policy = files::read_policy(run.policy(name));
    std::printf("%-18s %6d |", policy.motion.name.c_str(), policy.motion.size());
    for (int kind = 0; kind < 3; ++kind) {
      const auto exported = policy_export::export_policy(policy, kind == 2);
      const Kept kept = try_out(policy.motion, kind == 0 ? policy : exported.meant, pushes);
      std::printf("%7.2f%8.2f%7d ", kept.mpjpe, kept.distance, kept.followed);
      if (kind > 0) std::printf("%8zu ", data_bytes(exported));
      if (kind < 2) std::printf("|");
      sums[kind].mpjpe += kept.mpjpe;
      sums[kind].distance += kept.distance;
      sums[kind].followed += kept.followed;
      success[kind] += kept.success;
    }
    std::printf("\n");
  }
  const auto n = static_cast<double>(names.size());
  std::printf("%-18s %6s |", "mean, all pushes", "");
  for (int kind = 0; kind < 3; ++kind)
    std::printf("%7.2f%8.2f%7d %s%s", sums[kind].mpjpe / n, sums[kind].distance / n, sums[kind].followed,
                kind > 0 ? "         " : "", kind < 2 ? "|" : "\n");
  std::printf(
      "successes of %zu: %d as they are, %d in float, %d in int8; %d trials of pushes of %g m/s each\n",
      names.size(), success[0], success[1], success[2], pushes.trials, pushes.speed);
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: bench_export RUN\n");
    return 2;
  }
  try {
    mimicx::tools::print_all(mimicx::record::RunFolder{argv[1]});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_export: %s\n", error.what());
    return 1;
  }
  return 0;
}
