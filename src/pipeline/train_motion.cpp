#include "pipeline/train_motion.h"

#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline {

run::SimulatedSequence train_sequence(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                      const std::vector<rl::Agent>& agents, const TrainingConfig& config,
                                      const run::SequenceJob& job) {
  const TrainingFiles files = {job.folder.checkpoint(job.name), job.folder.log(job.name),
                               job.folder.falls(job.name), job.input_checksum};
  TrainingControl control;
  control.threads = job.threads;
  control.limit_seconds = job.limit_seconds;
  control.should_stop = job.context.should_stop;
  control.progress = progress_of_training(job.context.progress, job.name, config.samples);
  const TrainingResult training = train({clip}, agents, config, files, control);
  run::SimulatedSequence made;
  made.interrupted = training.interrupted;
  made.training_seconds = training.seconds;
  if (made.interrupted) return made;
  made.ending = training.ending;
  made.samples = training.samples;
  if (training.begun_samples < config.samples) made.begun_samples = training.begun_samples;
  made.agents = training.agents;
  made.after =
      rl::tracking::roll_out(clip, config.tracking, rl::tracking::mean_action(training.agents), job.substeps);
  return made;
}

}  // namespace mimicx::pipeline
