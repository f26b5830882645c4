/// `mimicx teach`: options taught by plans.                                          docs/teaching.md §5
///
/// Read → fit → prepare → plan, with feedback (a run of `mimicx plan --gains` in DIR/plans) → features →
/// clusters; then, cluster by cluster, one policy is taught by all plans of the cluster (teaching/school.h).
/// Motions without a complete plan are named and skipped.
///
///     DIR/options.npz              the set, as `mimicx pretrain` leaves it
///     DIR/clusters.json            which motion is in which cluster
///     DIR/plans/                   the run that planned them; absent if all were planned before
///     DIR/training/optionK.csv     a row per round
///     DIR/checkpoints/optionK.npz  the complete state of the teaching
///     DIR/manifest.json            inputs, settings, lessons
///
/// The same command continues an interrupted run; its files end up the same bytes as those of an
/// uninterrupted run, for any number of threads. It never opens any ground truth.
#pragma once

#include "core/setting.h"
#include "pipeline/options/clusters.h"
#include "plan/plan_command.h"
#include "teaching/school.h"

namespace mimicx::teaching {

struct TeachConfig {
  std::vector<std::string> plans;  ///< folders of runs of `mimicx plan --gains`
  /// Motions to plan here; `run.out` is set to DIR/plans. Its threads and jobs also apply to teaching.
  plan::PlanMotionsConfig planning;
  std::filesystem::path out;
  int visits = 16;  ///< visits of every motion in total; they determine the rounds of each option
  SchoolConfig school;
  pipeline::options::ClusterConfig clusters{.clusters = 1};  ///< a seed of the school seeds these, too
};

/// core/setting.h.
void visit_settings(TeachConfig& config, const auto& visit) {
  visit("school_visits", config.visits, 1, 1e5, "visits to every motion, in all");
  visit_settings(config.school, with_prefix("school_", visit));
  visit_settings(config.planning.planning, visit);
}

/// The settings, as the manifest lists them.
NamedValues manifest_settings(const TeachConfig& config);

/// @throws std::invalid_argument naming a setting that no teaching can have
void check(const TeachConfig& config);

record::RunOutcome teach_options(const TeachConfig& config, const record::RunContext& context);

}  // namespace mimicx::teaching
