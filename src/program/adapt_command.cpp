#include "program/adapt_command.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/setting.h"
#include "judge/choice.h"
#include "pipeline/cluster_map.h"
#include "pipeline/fine_tune.h"
#include "plan/plan_command.h"
#include "plan/plan_motion.h"
#include "plan/plan_parts.h"
#include "teaching/teach_motion.h"

namespace mimicx::program {
namespace {

constexpr const char* kPrinted = "printed";

plan::PlanningConfig planning_of(const AdaptConfig& config) {
  return {config.plan, config.training.tracking.simulation};
}

/// A complete plan teaches a policy; the better of the two roll-outs is kept.
run::SimulatedSequence teach_after(const AdaptConfig& config, const motion::Reference& reference,
                                   const control::Plan& plan, const judge::Candidate& planned,
                                   run::SimulatedSequence made, const run::SequenceJob& job) {
  teaching::TaughtPolicy taught =
      teaching::teach_sequence(reference, plan, config.teaching, config.plan.weights, config.training, job);
  made.interrupted = taught.interrupted;
  made.training_seconds = taught.seconds;
  if (taught.interrupted) return made;
  if (taught.timed_out) made.ending = record::SequenceEnding::kLimitSeconds;
  made.policy = taught.values;
  made.samples = taught.samples;
  if (!taught.note.empty()) made.notes.push_back(taught.note);
  if (!taught.policy) return made;
  const judge::Candidate learned = judge::candidate_of(reference, taught.alone);
  const bool keep_plan = !judge::better(learned, planned);
  made.notes.push_back("plan: " + judge::in_words(planned) + "; policy: " + judge::in_words(learned) +
                       "; written: the " + (keep_plan ? "plan" : "policy"));
  if (!keep_plan) {
    made.method = "policy";
    made.after = std::move(taught.alone);
  }
  made.taught = std::move(taught.policy);
  return made;
}

/// Arranges trained options over the motion and fine-tunes them.
run::SimulatedSequence options_method(const AdaptConfig& config, const motion::Reference& reference,
                                      const run::SequenceJob& job) {
  run::SimulatedSequence made =
      pipeline::fine_tune(reference, config.options, config.arrangement, config.training, job);
  if (config.method == AdaptMethod::kPrinted) made.method = kPrinted;
  return made;
}

/// Plans the motion, and fine-tunes where the plan's roll-out is no success; the better roll-out is kept.
run::SimulatedSequence plan_or_fine_tune(const AdaptConfig& config, const motion::Reference& reference,
                                         const run::SequenceJob& job) {
  control::Plan found;
  run::SimulatedSequence plan = plan::plan_sequence(reference, planning_of(config), job, &found);
  if (plan.interrupted) return plan;
  const judge::Candidate planned = judge::candidate_of(reference, plan.after);
  const run::SequenceJob rest = run::after_seconds(job, plan.planning_seconds);
  if (planned.success && config.teaching.teach) {
    if (found.ending == control::Ending::kFollowed)
      return teach_after(config, reference, found, planned, std::move(plan), rest);
    const bool late = plan.ending == record::SequenceEnding::kLimitSeconds;
    plan.notes.push_back(std::string("no policy: its plan was not complete") +
                         (late ? " when --limit-seconds stopped it" : ""));
  }
  if (planned.success) return plan;
  run::SimulatedSequence trained = options_method(config, reference, rest);
  trained.planning_seconds = plan.planning_seconds;
  if (trained.interrupted) return trained;
  const judge::Candidate learned = judge::candidate_of(reference, trained.after);
  const bool keep_plan = judge::better(planned, learned);
  run::SimulatedSequence& kept = keep_plan ? plan : trained;
  kept.planning_seconds = plan.planning_seconds;
  kept.training_seconds = trained.training_seconds;
  kept.samples = trained.samples;
  kept.begun_samples = trained.begun_samples;
  const bool ended_early = trained.ending == record::SequenceEnding::kThreshold ||
                           trained.ending == record::SequenceEnding::kStall;
  if (keep_plan && ended_early && trained.samples > 0) kept.training_ending = trained.ending;
  kept.plan = plan.plan;
  kept.assistance = plan.assistance;
  for (const record::SequenceEnding ending : {plan.ending, trained.ending})
    if (ending == record::SequenceEnding::kLimitSeconds) kept.ending = ending;
  if (!keep_plan && !plan.reason.empty()) kept.notes.push_back(plan.reason);
  kept.notes.push_back("plan: " + judge::in_words(planned) + "; policies: " + judge::in_words(learned) +
                       "; written: " + (keep_plan ? "the plan" : "the policies"));
  return kept;
}

/// Files of the sets' clusters; none if one is missing, because the numbering counts all of them.
std::vector<std::filesystem::path> clusters_of(const pipeline::options::OptionSets& sets) {
  std::vector<std::filesystem::path> files;
  for (const auto& set : sets) files.push_back(set->clusters);
  if (std::find(files.begin(), files.end(), std::filesystem::path()) != files.end()) return {};
  return files;
}

/// @throws std::invalid_argument for options whose policies were trained with other actions, and for actions
/// that no plan teaches
void require_actions(const AdaptConfig& config) {
  const rl::tracking::ActionSettings& actions = config.training.tracking.actions;
  for (const auto& set : config.options)
    if (set->actions != actions)
      throw std::invalid_argument("options: expected policies trained with " +
                                  pipeline::options::actions_in_words(actions) + ", found " +
                                  pipeline::options::actions_in_words(set->actions));
  const rl::tracking::ActionSettings planned;
  if (config.teaching.teach && actions != planned)
    throw std::invalid_argument("--policy: expected the actions of a plan, " +
                                pipeline::options::actions_in_words(planned) + ", found " +
                                pipeline::options::actions_in_words(actions));
}

const char* name_of(AdaptMethod method) {
  if (method == AdaptMethod::kPrinted) return kPrinted;
  return method == AdaptMethod::kAuto ? "auto" : "options";
}

run::Method adaptation_of(const AdaptConfig& config) {
  run::Method method;
  method.seed = config.training.seed;
  method.samples = config.training.samples;
  method.settings = manifest_settings(config);
  method.options = pipeline::options::checksum_of(config.options);
  method.simulation = config.training.tracking.simulation;
  const bool plan_first = config.method == AdaptMethod::kAuto;
  method.name = name_of(config.method);
  method.simulate = [&config, plan_first](const motion::Reference& reference, const run::SequenceJob& job) {
    return plan_first ? plan_or_fine_tune(config, reference, job) : options_method(config, reference, job);
  };
  if (plan_first)
    method.parts = [&config](const motion::Reference& reference, const rl::tracking::TrackingRollout& lost,
                             const run::SequenceJob& job) {
      return plan::followed_parts(reference, planning_of(config), lost, job);
    };
  return method;
}

}  // namespace

NamedValues manifest_settings(const AdaptConfig& config) {
  NamedValues settings = settings_of(config);
  append(settings, manifest_settings(config.run));
  return settings;
}

void check(const AdaptConfig& config) {
  require_ranges(config);
  if (config.method == AdaptMethod::kPlan) return check(planning_of(config));
  check(config.training);
}

record::RunOutcome adapt(const AdaptConfig& config, const record::RunContext& context) {
  if (config.method == AdaptMethod::kPlan)
    return plan::plan_motions({config.run, planning_of(config)}, context);
  if (config.options.empty())
    throw std::invalid_argument("adapt: expected options to start from, found none");
  if (config.method == AdaptMethod::kPrinted && config.options.count() > 1)
    throw std::invalid_argument("--options: expected one set for --method printed, found " +
                                std::to_string(config.options.count()));
  require_actions(config);
  require_ranges(config.arrangement);
  run::RunConfig run = config.run;
  run.map = pipeline::run_map(clusters_of(config.options));
  return run::run_sequences(run, adaptation_of(config), context);
}

}  // namespace mimicx::program
