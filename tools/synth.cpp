#include <iostream>

#include "commands.h"
#include "pipeline/progress.h"

namespace mimicx {
namespace {

constexpr double kProgressPeriod = 2.0;  // s

/// @throws UsageError for a set that cannot be
std::vector<SynthOptions> checked_clips(const SynthSetOptions& set) {
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

}  // namespace

int run_synth(const SynthArguments& arguments) {
  if (arguments.out.empty() && arguments.data_set.empty())
    throw UsageError("synth: --out DIR or --data-set DIR says where to write");
  if (!arguments.out.empty()) write_set(arguments, checked_clips(arguments.set).size());
  if (!arguments.data_set.empty()) {
    write_synthetic_data(arguments.data_set);
    std::cout << arguments.data_set.string() << ": test and train, " << synthetic_kinds().size()
              << " motions each, as truth and as a noisy estimate\n";
  }
  return kAllGood;
}

}  // namespace mimicx
