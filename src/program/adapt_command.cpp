#include "program/adapt_command.h"

#include <algorithm>
#include <stdexcept>

#include "core/setting.h"
#include "judge/choice.h"
#include "pipeline/cluster_map.h"
#include "pipeline/set_choice.h"
#include "pipeline/train_motion.h"
#include "plan/job_watch.h"
#include "plan/plan_command.h"
#include "plan/plan_motion.h"
#include "teaching/teach_motion.h"

namespace mimicx::program {
namespace {

/// Calls add(name, field) for every number of the arrangement.
template <class Config, class Add>
void for_each_arrangement_setting(Config& config, const Add& add) {
  add("switch_penalty", config.switch_penalty);
  add("rescue_reward", config.rescue_reward);
  add("rescue_frames", config.rescue_frames);
  add("beam_width", config.beam_width);
  add("beam_stretch", config.beam_stretch);
  add("beam_retries", config.beam_retries);
  add("selector", config.selector);
}

bool change_arrangement(pipeline::options::ArrangementConfig& config, const std::string& name, double value) {
  return change_one([&](const auto& add) { for_each_arrangement_setting(config, add); }, name, value);
}

plan::PlanningConfig planning_of(const AdaptConfig& config) {
  return {config.plan, config.training.tracking.simulation};
}

/// The job with what is left of its seconds after so many.
run::SequenceJob after_seconds(const run::SequenceJob& job, double seconds) {
  run::SequenceJob rest = job;
  if (job.limit_seconds > 0.0) rest.limit_seconds = std::max(job.limit_seconds - seconds, 1e-9);
  return rest;
}

/// What a training goes on from: no checkpoint of another input, and none of other options or of another
/// arrangement of them, which a search that was told to stop may have left.
std::string start_of_training(const run::SequenceJob& job, const pipeline::options::OptionSet& set,
                              const List<int>& arrangement) {
  std::string text = set.checksum;
  for (const int option : arrangement) text += ' ' + std::to_string(option);
  return job.input_checksum + ' ' + record::checksum(text);
}

/// How the options were found, for the manifest.
std::vector<std::string> notes_of(const pipeline::ChosenSet& chosen, int frames, int sets, bool timed_out) {
  std::vector<std::string> notes;
  const auto one_set = [&](int set) {
    return "set " + std::to_string(set + 1) + " of " + std::to_string(sets);
  };
  if (timed_out)
    notes.push_back("the search for options ended early, at frame " + std::to_string(chosen.last_searched) +
                    " of " + std::to_string(frames) + (sets > 1 ? " with " + one_set(chosen.tried - 1) : "") +
                    ": --limit-seconds");
  if (chosen.success && chosen.set > 0)
    notes.push_back("options of " + one_set(chosen.set) + ": the first that follows the motion");
  if (sets > 1 && !chosen.success && chosen.tried == sets && !timed_out)
    notes.push_back("options of " + one_set(chosen.set) + ": none follows the motion, this is the best");
  const List<int>& breaks = chosen.arranged.breaks;
  if (!breaks.empty())
    notes.push_back("nothing that was tried could follow at " + std::to_string(breaks.size()) +
                    " frames, first at frame " + std::to_string(breaks.front()));
  return notes;
}

run::SimulatedSequence fine_tune(const AdaptConfig& config, const motion::Reference& reference,
                                 const run::SequenceJob& job) {
  const rl::tracking::TrackingConfig& tracking = config.training.tracking;
  const auto clip = rl::tracking::make_tracking_clip(reference, tracking);
  plan::JobWatch watch{job};
  const pipeline::ChosenSet chosen = pipeline::choose_set(reference, clip, tracking, config.options,
                                                          config.arrangement, watch.control().should_stop);
  const pipeline::options::ArrangedClip& arranged = chosen.arranged;
  if (watch.interrupted) {
    run::SimulatedSequence none;
    none.interrupted = true;
    return none;
  }
  run::SequenceJob rest = after_seconds(job, record::steady_seconds() - watch.started);
  rest.input_checksum = start_of_training(job, *config.options[chosen.set], arranged.options);
  run::SimulatedSequence made =
      pipeline::train_sequence(arranged.clip, arranged.agents, config.training, rest);
  if (watch.timed_out) made.ending = record::Ending::kLimitSeconds;
  made.method = "paper";
  made.arrangement = pipeline::options::stretches_of(arranged.options);
  for (auto& [frame, option] : made.arrangement)
    option += pipeline::options::first_option(config.options, chosen.set);
  for (std::string& note : notes_of(chosen, clip->size(), config.options.count(), watch.timed_out))
    made.notes.push_back(std::move(note));
  return made;
}

/// A plan that was followed teaches a policy; the better of the two roll-outs stays.
run::SimulatedSequence teach_after(const AdaptConfig& config, const motion::Reference& reference,
                                   const control::Plan& plan, const judge::Candidate& planned,
                                   run::SimulatedSequence made, const run::SequenceJob& job) {
  teaching::TaughtPolicy taught =
      teaching::teach_sequence(reference, plan, config.teaching, config.plan.weights, config.training, job);
  made.interrupted = taught.interrupted;
  made.training_seconds = taught.seconds;
  if (taught.interrupted) return made;
  if (taught.timed_out) made.ending = record::Ending::kLimitSeconds;
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

run::SimulatedSequence plan_or_fine_tune(const AdaptConfig& config, const motion::Reference& reference,
                                         const run::SequenceJob& job) {
  control::Plan found;
  run::SimulatedSequence plan = plan::plan_sequence(reference, planning_of(config), job, &found);
  if (plan.interrupted) return plan;
  const judge::Candidate planned = judge::candidate_of(reference, plan.after);
  const run::SequenceJob rest = after_seconds(job, plan.planning_seconds);
  if (planned.success && found.ending == control::Ending::kFollowed && config.teaching.teach)
    return teach_after(config, reference, found, planned, std::move(plan), rest);
  if (planned.success) return plan;
  run::SimulatedSequence trained = fine_tune(config, reference, rest);
  trained.planning_seconds = plan.planning_seconds;
  if (trained.interrupted) return trained;
  const judge::Candidate learned = judge::candidate_of(reference, trained.after);
  const bool keep_plan = judge::better(planned, learned);
  run::SimulatedSequence& kept = keep_plan ? plan : trained;
  kept.planning_seconds = plan.planning_seconds;
  kept.training_seconds = trained.training_seconds;
  kept.samples = trained.samples;
  kept.plan = plan.plan;
  kept.help = plan.help;
  for (const record::Ending ending : {plan.ending, trained.ending})
    if (ending == record::Ending::kLimitSeconds) kept.ending = ending;
  if (!keep_plan && !plan.reason.empty()) kept.notes.push_back(plan.reason);
  kept.notes.push_back("plan: " + judge::in_words(planned) + "; policies: " + judge::in_words(learned) +
                       "; written: " + (keep_plan ? "the plan" : "the policies"));
  return kept;
}

/// Files of the sets' clusters; none where one is missing, since the others' numbers would mean nothing.
std::vector<std::filesystem::path> clusters_of(const pipeline::options::OptionSets& sets) {
  std::vector<std::filesystem::path> files;
  for (const auto& set : sets) files.push_back(set->clusters);
  if (std::find(files.begin(), files.end(), std::filesystem::path()) != files.end()) return {};
  return files;
}

run::Method adaptation_of(const AdaptConfig& config) {
  run::Method method;
  method.seed = config.training.seed;
  method.samples = config.training.samples;
  method.settings = settings_of(config);
  method.options = pipeline::options::checksum_of(config.options);
  method.simulation = config.training.tracking.simulation;
  const bool plan_first = config.method == AdaptMethod::kAuto;
  method.name = plan_first ? "auto" : "paper";
  method.simulate = [&config, plan_first](const motion::Reference& reference, const run::SequenceJob& job) {
    return plan_first ? plan_or_fine_tune(config, reference, job) : fine_tune(config, reference, job);
  };
  return method;
}

}  // namespace

NamedValues settings_of(const AdaptConfig& config) {
  if (config.method == AdaptMethod::kPlan)
    return settings_of(plan::PlanMotionsConfig{config.run, planning_of(config)});
  NamedValues settings = settings_of(config.training);
  append(settings, settings_of(config.run));
  append(settings,
         numbers_in([&](const auto& add) { for_each_arrangement_setting(config.arrangement, add); }));
  if (config.method == AdaptMethod::kAuto) {
    append(settings, plan::plan_settings(config.plan));
    append(settings, teaching::teaching_settings(config.teaching));
  }
  return settings;
}

void apply_setting(AdaptConfig& config, const std::string& name, double value) {
  if (config.method != AdaptMethod::kPaper && change_setting(config.plan, name, value)) return;
  if (config.method == AdaptMethod::kAuto && change_setting(config.teaching, name, value)) return;
  if (config.method != AdaptMethod::kPlan) {
    if (!change_arrangement(config.arrangement, name, value)) apply_setting(config.training, name, value);
    return;
  }
  plan::PlanningConfig planning = planning_of(config);
  apply_setting(planning, name, value);
  config.training.tracking.simulation = planning.simulation;
}

void check(const AdaptConfig& config) {
  if (config.method != AdaptMethod::kPaper) check(planning_of(config));
  if (config.method != AdaptMethod::kPlan) check(config.training);
  if (config.method != AdaptMethod::kPlan) check(config.arrangement);
  if (config.method == AdaptMethod::kAuto) check(config.teaching);
}

record::RunOutcome adapt(const AdaptConfig& config, const record::RunContext& context) {
  if (config.method == AdaptMethod::kPlan)
    return plan::plan_motions({config.run, planning_of(config)}, context);
  if (config.options.empty())
    throw std::invalid_argument("adapt: expected options to start from, found none");
  check(config.arrangement);
  run::RunConfig run = config.run;
  run.map = pipeline::run_map(clusters_of(config.options));
  return run::run_sequences(run, adaptation_of(config), context);
}

}  // namespace mimicx::program
