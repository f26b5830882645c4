#include "pipeline/plan_sequence.h"

#include <algorithm>
#include <optional>

#include "core/units.h"
#include "pipeline/output/plan_file.h"
#include "pipeline/plan_loss.h"

namespace mimicx {
namespace {

std::vector<State<double>> states_of(const Reference& reference) {
  std::vector<State<double>> states;
  for (const ReferenceFrame& frame : reference.frames) {
    State<double>& x = states.emplace_back();
    x.p_root = from_eigen(frame.p_root);
    x.v_root = from_eigen(frame.v_root);
    for (std::size_t i = 0; i < kBodies; ++i) {
      x.q[i] = from_eigen(frame.q[i]);
      x.omega[i] = from_eigen(frame.omega[i]);
    }
  }
  return states;
}

/// The plan that an earlier run finished for this very input; none where the file is not that.
std::optional<StoredPlan> finished_plan(const SequenceJob& job) {
  const std::filesystem::path file = job.folder.plan(job.name);
  if (!std::filesystem::exists(file)) return {};
  try {
    StoredPlan stored = read_plan(file);
    if (stored.plan.ending != control::Ending::kStopped && stored.input_checksum == job.input_checksum)
      return stored;
  } catch (const DataError&) {  // a damaged one is made anew
  }
  return {};
}

/// Plans. @return whether the context asked to stop
bool make(const Reference& reference, const PlanningConfig& config, const SequenceJob& job,
          StoredPlan& stored) {
  const double started = steady_seconds();
  bool interrupted = false;
  job.context.progress.start(job.name + ": plan", 0.0, reference.size(), "frames");
  control::PlanControl control;
  control.threads = job.threads;
  control.should_stop = [&] {
    interrupted = interrupted || job.context.should_stop();
    return interrupted || (job.limit_seconds > 0.0 && steady_seconds() - started > job.limit_seconds);
  };
  control.progress = [&](int done, int) { job.context.progress.update(done, ""); };
  stored.input_checksum = job.input_checksum;
  stored.fps = reference.fps;
  stored.simulation = config.simulation;
  stored.reference = states_of(reference);
  const control::System system =
      control::make_system(reference.character, config.simulation, stored.reference, reference.fps);
  stored.plan = control::make_plan(system, config.plan, control);
  return interrupted;
}

rl::TrackingRollout replay(const Reference& reference, const StoredPlan& stored, bool substeps) {
  rl::TrackingConfig tracking;
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
  return rl::roll_out(rl::make_tracking_clip(reference, tracking), tracking, planned, substeps);
}

NamedValues values_of(const control::Plan& plan) {
  return {{"frames", static_cast<double>(plan.states.size())},
          {"cost", plan.cost},
          {"worst_distance_mm", kMm * plan.worst_distance},
          {"iterations", static_cast<double>(plan.iterations)},
          {"linearised_frames", static_cast<double>(plan.linearised)},
          {"backtracks", static_cast<double>(plan.backtracks)}};
}

Ending ending_of(const control::Plan& plan) {
  switch (plan.ending) {
    case control::Ending::kFollowed:
      return Ending::kFollowed;
    case control::Ending::kLost:
      return Ending::kLost;
    case control::Ending::kStopped:
      return Ending::kLimitSeconds;
  }
  return Ending::kNone;
}

}  // namespace

SimulatedSequence plan_sequence(const Reference& reference, const PlanningConfig& config,
                                const SequenceJob& job) {
  SimulatedSequence made;
  made.method = "plan";
  const double started = steady_seconds();
  std::optional<StoredPlan> finished = finished_plan(job);
  StoredPlan stored = finished ? std::move(*finished) : StoredPlan{};
  if (!finished) {
    made.interrupted = make(reference, config, job, stored);
    made.planning_seconds = steady_seconds() - started;
    if (made.interrupted) return made;
    std::filesystem::create_directories(job.folder.plan(job.name).parent_path());
    write_plan(job.folder.plan(job.name), stored);
  }
  made.ending = ending_of(stored.plan);
  made.plan = values_of(stored.plan);
  if (stored.plan.loss) made.reason = loss_in_words(reference, *stored.plan.loss);
  if (made.ending == Ending::kLimitSeconds)
    made.reason = "the plan was stopped at frame " + std::to_string(stored.plan.states.size() - 1);
  made.after = replay(reference, stored, job.substeps);
  return made;
}

}  // namespace mimicx
