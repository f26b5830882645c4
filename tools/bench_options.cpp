// How well options follow motions without fine-tuning: every option alone, over the whole of each reference.
// Reads folders of `mimicx plan`.
//   bench_options [--planned] OPTIONS RUN...    OPTIONS: options.npz, or its folder
// --planned: they follow the planned motions instead of the plans' references. A motion is followed if no
// body is ever farther than 0.5 m from the reference (docs/metrics.md). For each folder a line per kind of
// motion (its name up to the last "_"): how many of the motions with a complete plan the best option follows,
// and the median of their gMPJPE, mm. Exit status: 0 done, 1 a file could not be read, 2 usage.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/quantile.h"
#include "core/units.h"
#include "judge/scores.h"
#include "pipeline/options/option_set.h"
#include "rl/tracking/tracking_rollout.h"
#include "teaching/plan_teachers.h"

namespace mimicx::tools {
namespace {

struct Outcome {
  bool yes = false;
  double gmpjpe = 0.0;  ///< mm
};

/// The best of the options alone.
Outcome follow(const motion::Reference& reference, const pipeline::options::OptionSet& set) {
  const rl::tracking::TrackingConfig task;
  const auto clip = rl::tracking::make_tracking_clip(reference, task);
  Outcome best;
  for (const pipeline::options::TrainedOption& option : set.options) {
    const auto alone = rl::tracking::roll_out(pipeline::options::encoded_for(clip, {&option.option}), task,
                                              rl::tracking::mean_action({option.option.agent}));
    const judge::Scores scores = judge::score_simulated(reference, alone);
    const double error = value_of(scores.values, "gMPJPE");
    if (scores.success > best.yes || (scores.success && error < best.gmpjpe)) best = {scores.success, error};
  }
  return best;
}

std::string kind_of(const std::string& name) { return name.substr(0, name.rfind('_')); }

struct Row {
  int motions = 0, followed = 0;
  std::vector<double> errors;
};

void print_row(const std::string& kind, Row row) {
  std::printf("  %-24s %4d of %4d", kind.c_str(), row.followed, row.motions);
  if (!row.errors.empty()) std::printf("   gMPJPE %5.1f", quantile(row.errors, 0.5));
  std::printf("\n");
}

void print_run(const std::string& folder, const pipeline::options::OptionSet& set,
               teaching::Followed followed) {
  std::vector<teaching::PlannedMotion> motions = teaching::planned_motions({folder});
  std::erase_if(motions, [](const teaching::PlannedMotion& motion) { return !motion.followed; });
  std::vector<Outcome> results(motions.size());
  parallel_for(static_cast<int>(motions.size()), available_threads(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    results[k] = follow(teaching::reference_of(motions[k], followed), set);
  });
  std::map<std::string, Row> kinds;
  Row all;
  for (std::size_t k = 0; k < motions.size(); ++k)
    for (Row* row : {&kinds[kind_of(motions[k].name)], &all}) {
      ++row->motions;
      row->followed += results[k].yes;
      if (results[k].yes) row->errors.push_back(results[k].gmpjpe);
    }
  std::printf("%s\n", folder.c_str());
  for (const auto& [kind, row] : kinds) print_row(kind, row);
  print_row("all", all);
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  const bool planned = argc > 1 && std::string(argv[1]) == "--planned";
  if (planned) ++argv, --argc;
  if (argc < 3 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: bench_options [--planned] OPTIONS RUN...\n");
    return 2;
  }
  try {
    const auto set = mimicx::pipeline::options::read_options(argv[1]);
    for (int i = 2; i < argc; ++i)
      mimicx::tools::print_run(
          argv[i], *set,
          planned ? mimicx::teaching::Followed::kPlan : mimicx::teaching::Followed::kReference);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_options: %s\n", error.what());
    return 1;
  }
}
