#include <cstdio>
#include <iostream>

#include "commands.h"
#include "pipeline/audit/feasibility.h"
#include "pipeline/record/progress.h"

namespace mimicx {
namespace {

constexpr double kProgressPeriod = 2.0;  // s

/// @throws UsageError for a set that cannot be
std::vector<SynthConfig> checked_clips(const SynthSetConfig& set) {
  try {
    return clips_of_set(set);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("synth: ") + error.what());
  }
}

void write_set(const SynthArguments& arguments, std::size_t total) {
  double next = steady_seconds() + kProgressPeriod;
  write_synth_set(arguments.out, arguments.set, [&](std::size_t index, const Clip&) {
    if (steady_seconds() < next) return;
    std::cerr << index + 1 << " of " << total << " motions\n";
    next += kProgressPeriod;
  });
  std::cout << arguments.out.string() << ": " << total << " motions, each as truth and as a noisy estimate\n";
}

/// Residuals in parts of the weight W, torques in parts of their limits.
void print_report(const std::vector<SynthConfig>& clips) {
  std::printf("%-20s %7s %18s %20s %26s %12s\n", "motion", "seconds", "root force, % W", "root moment, mm W",
              "worst torque, % of limit", "frames over");
  std::printf("%-20s %7s %9s %8s %11s %8s\n", "", "", "mean", "max", "mean", "max");
  for (const SynthConfig& config : clips) {
    const Clip clip = synthesize(config);
    const Feasibility f = feasibility(clip);
    const std::string worst(kBodyNames[static_cast<std::size_t>(f.worst_joint)]);
    std::printf("%-20s %7.1f %9.2f %8.2f %11.2f %8.1f %19.0f %-12s %6d\n", clip.name.c_str(),
                (clip.frames() - 1) / clip.fps, 100.0 * f.mean_force, 100.0 * f.max_force,
                1e3 * f.mean_moment, 1e3 * f.max_moment, 100.0 * f.worst_torque, worst.c_str(),
                f.frames_over_limit);
  }
}

}  // namespace

int run_synth(const SynthArguments& arguments) {
  if (arguments.out.empty() && arguments.data_set.empty() && !arguments.report)
    throw UsageError("synth: --out DIR or --data-set DIR says where to write");
  const std::vector<SynthConfig> clips = checked_clips(arguments.set);
  if (!arguments.out.empty()) write_set(arguments, clips.size());
  if (!arguments.data_set.empty()) {
    write_synthetic_data(arguments.data_set);
    std::cout << arguments.data_set.string() << ": test and train, " << synthetic_kinds().size()
              << " motions each, as truth and as a noisy estimate\n";
  }
  if (arguments.report) print_report(clips);
  return kAllGood;
}

}  // namespace mimicx
