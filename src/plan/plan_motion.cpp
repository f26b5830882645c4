#include "plan/plan_motion.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "control/gains.h"
#include "core/file.h"
#include "core/npz/npz.h"
#include "core/units.h"
#include "files/archive_members.h"
#include "files/plan_file.h"
#include "files/simulation_settings.h"
#include "plan/plan_failure.h"
#include "plan/reference_factors.h"
#include "run/method.h"

namespace mimicx::plan {
namespace {

/// Whether two references are the same as a plan's file stores them.
bool are_same(const std::vector<physics::State<double>>& one,
              const std::vector<physics::State<double>>& other) {
  const auto stored = [](const std::vector<physics::State<double>>& states) {
    Npz npz;
    files::add_states("", states, files::Precision::kFloat64, npz);
    return format_npz(npz);
  };
  return stored(one) == stored(other);
}

/// The finished plan of an earlier run for the same input, reference and simulation; none if the file is
/// another one. How a plan was sought is not in its file: a run keeps its settings, and one that begins
/// without a manifest removes the plans that it finds (run/sequence_run.cpp).
std::optional<files::StoredPlan> finished_plan(const motion::Reference& reference,
                                               const physics::SimulationConfig& simulation,
                                               const run::SequenceJob& job) {
  const std::filesystem::path file = job.folder.plan(job.name);
  if (!std::filesystem::exists(file)) return {};
  try {
    files::StoredPlan stored = files::read_plan(file);
    if (stored.plan.ending != control::Ending::kStopped && stored.input_checksum == job.input_checksum &&
        stored.fps == reference.fps &&
        are_same(stored.reference, rl::tracking::simulator_states(reference)) &&
        files::simulation_numbers(stored.simulation) == files::simulation_numbers(simulation))
      return stored;
  } catch (const DataError&) {  // a damaged plan is made again
  }
  return {};
}

control::System system_of(const motion::Reference& reference, const files::StoredPlan& stored) {
  return control::make_system(reference.character, stored.simulation, stored.reference, stored.fps,
                              reference.scene);
}

files::StoredPlan make(const motion::Reference& reference, const physics::SimulationConfig& simulation,
                       const control::PlanConfig& plan, run::JobWatch& watch) {
  const run::SequenceJob& job = watch.job;
  job.context.progress.start(job.name + ": plan", 0.0, reference.size(), "frames");
  files::StoredPlan stored;
  stored.input_checksum = job.input_checksum;
  stored.fps = reference.fps;
  stored.simulation = simulation;
  stored.reference = rl::tracking::simulator_states(reference);
  control::PlanControl control = watch.control();
  control.progress = [&](int done, int) { job.context.progress.update(done, ""); };
  stored.plan = control::make_plan(system_of(reference, stored), plan, control);
  return stored;
}

/// Writes the feedback gains of a successful plan, on request, and removes those that are not wanted. Gains
/// of the same plan stay where the work on them is stopped.
void leave_gains(const motion::Reference& reference, const control::PlanConfig& config,
                 const files::StoredPlan& stored, run::JobWatch& watch) {
  const std::filesystem::path file = watch.job.folder.gains(watch.job.name);
  if (!watch.job.gains || stored.plan.ending != control::Ending::kFollowed) {
    std::filesystem::remove(file);
    return;
  }
  const control::System system = system_of(reference, stored);
  const control::Cost cost = control::make_cost(system, config.weights, config.factors);
  List<Eigen::MatrixXf> curvature;
  files::StoredGains feedback;
  feedback.gains = control::feedback_gains(system, cost, control::trajectory_of(stored.plan), {},
                                           watch.control(), &curvature);
  if (feedback.gains.empty()) return;  // stopped
  feedback.curvature = Eigen::MatrixXf::Zero(kDofs, kDofs);
  for (const Eigen::MatrixXf& Q : curvature) feedback.curvature += Q / static_cast<float>(curvature.size());
  make_folder(file.parent_path());
  files::write_gains(file, feedback);
}

rl::tracking::TrackingRollout replay(const motion::Reference& reference, const files::StoredPlan& stored,
                                     bool substeps) {
  rl::tracking::TrackingConfig tracking;
  tracking.simulation = stored.simulation;
  std::size_t t = 0;
  const auto& residuals = stored.plan.residuals;
  const auto planned = [&](int, const float*, float* action) {
    if (t < residuals.size())
      std::copy(residuals[t].begin(), residuals[t].end(), action);
    else
      std::fill(action, action + kDofs, 0.0f);
    ++t;
  };
  return rl::tracking::roll_out(rl::tracking::make_tracking_clip(reference, tracking), tracking, planned,
                                substeps);
}

NamedValues numbers_of_plan(const control::Plan& plan) {
  return {{"frames", static_cast<double>(plan.states.size())},
          {"cost", plan.cost},
          {"worst_distance_mm", kMm * plan.worst_distance},
          {"iterations", static_cast<double>(plan.iterations)},
          {"linearised_frames", static_cast<double>(plan.linearised)},
          {"backtracks", static_cast<double>(plan.backtracks)},
          {"by_way_of_help", plan.by_assisted_stages ? 1.0 : 0.0}};
}

record::SequenceEnding ending_of(const control::Plan& plan) {
  switch (plan.ending) {
    case control::Ending::kFollowed:
      return record::SequenceEnding::kFollowed;
    case control::Ending::kLost:
      return record::SequenceEnding::kLost;
    case control::Ending::kStopped:
      return record::SequenceEnding::kLimitSeconds;
  }
  return record::SequenceEnding::kNone;
}

}  // namespace

rl::tracking::TrackingRollout planned_rollout(const motion::Reference& reference,
                                              const physics::SimulationConfig& simulation,
                                              const control::PlanConfig& settings, run::JobWatch& watch) {
  return replay(reference, make(reference, simulation, settings, watch), false);
}

run::SimulatedSequence plan_sequence(const motion::Reference& reference, const PlanningConfig& config,
                                     const run::SequenceJob& job, control::Plan* planned) {
  run::SimulatedSequence made;
  made.method = "plan";
  run::JobWatch watch{job};
  control::PlanConfig settings = config.plan;
  settings.factors = factors_of(reference, job.needs, config.plan);
  std::optional<files::StoredPlan> stored = finished_plan(reference, config.simulation, job);
  if (!stored) {
    stored = make(reference, config.simulation, settings, watch);
    if (!watch.interrupted) {
      std::filesystem::remove(job.folder.gains(job.name));  // of an older plan
      make_folder(job.folder.plan(job.name).parent_path());
      files::write_plan(job.folder.plan(job.name), *stored);
    }
  }
  if (!watch.interrupted) leave_gains(reference, settings, *stored, watch);
  made.planning_seconds = record::steady_seconds() - watch.started;
  made.interrupted = watch.interrupted;
  if (made.interrupted) return made;
  const control::Plan& plan = stored->plan;
  made.ending = ending_of(plan);
  made.plan = numbers_of_plan(plan);
  made.assistance = control::wrenches_of(plan.stage_assistance, reference.character.total_mass());
  if (made.ending == record::SequenceEnding::kLimitSeconds)
    made.reason = "the plan was stopped at frame " + std::to_string(plan.states.size() - 1);
  made.after = replay(reference, *stored, job.substeps);
  if (plan.failure) {
    auto forces = made.after.forces;  // after the plan's end they are those of a body without controls
    forces.resize(std::min(forces.size(), plan.states.size()));
    made.reason = failure_in_words(*plan.failure, job.needs, made.assistance, forces);
  }
  if (planned) *planned = std::move(stored->plan);
  return made;
}

}  // namespace mimicx::plan
