#include "teaching/teach_motion.h"

#include <algorithm>

#include "judge/scores.h"
#include "pipeline/train_motion.h"
#include "run/method.h"

namespace mimicx::teaching {
namespace {

/// Continues the student's training with PPO. Its first steps are small, because the critic is untrained.
run::SimulatedSequence polish(const Teacher& teacher, const rl::Agent& student, const TeachingConfig& config,
                              pipeline::TrainingConfig training, const run::SequenceJob& job) {
  training.samples = config.polish_samples;
  training.stop_reward = config.polish_reward;
  training.stall_evaluations = 0;
  training.evaluate_iterations = 10;
  training.ppo.step_size = training.ppo.step_min;
  return pipeline::train_sequence(teacher.clip, {student}, training, job);
}

/// Writes into the values how well the agent follows its motion unaided and under pushes.
void try_out(const Teacher& teacher, const TeachingConfig& config, const rl::tracking::TrackingConfig& task,
             const rl::Agent& agent, const judge::Scores& scores, TaughtPolicy& taught) {
  control::PushTest pushes = config.teacher.pushes;
  pushes.speed = 0.1;
  const auto held = test_pushes(teacher.clip, task, agent, pushes);
  taught.values.emplace_back("success", scores.success ? 1.0 : 0.0);
  for (const char* name : {"gMPJPE", "MPJPE", "Jitter"})
    taught.values.emplace_back(name, value_of(scores.values, name));
  taught.values.emplace_back("pushes_survived", held.followed);
  taught.values.emplace_back("pushes_tried", pushes.trials);
  if (!scores.success) taught.note = "the policy alone does not follow the plan: " + scores.reason;
}

}  // namespace

rl::tracking::TrackingRollout seen_from(const motion::Reference& reference,
                                        const rl::tracking::TrackingConfig& task,
                                        rl::tracking::TrackingRollout rollout) {
  const auto clip = rl::tracking::make_tracking_clip(reference, task);
  rollout.worst_distance = rollout.mean_reward = rollout.mean_position_error = 0.0;
  const int frames = static_cast<int>(rollout.poses.size());
  for (int t = 0; t < frames; ++t) {
    const rl::tracking::Pose& pose = rollout.poses[static_cast<std::size_t>(t)];
    const auto* keypoints = clip->keypoints.empty() ? nullptr : &clip->keypoints[t];
    const auto reward = rl::tracking::tracking_reward(task.reward, clip->poses[t], pose, keypoints);
    rollout.rewards[static_cast<std::size_t>(t)] = reward;
    if (t == 0) continue;
    double sum = 0.0;
    for (int body = 0; body < kBodies; ++body) {
      const double distance = (pose.p_WB[body] - clip->poses[t].p_WB[body]).norm();
      rollout.worst_distance = std::max(rollout.worst_distance, distance);
      sum += distance / kBodies;
    }
    rollout.mean_reward += reward.total / (frames - 1);
    rollout.mean_position_error += sum / (frames - 1);
  }
  return rollout;
}

TaughtPolicy teach_sequence(const motion::Reference& reference, const control::Plan& plan,
                            const TeachingConfig& config, const control::CostWeights& weights,
                            const pipeline::TrainingConfig& training, const run::SequenceJob& job) {
  run::JobWatch watch{job};
  TaughtPolicy taught;
  const rl::tracking::TrackingConfig& task = training.tracking;
  control::PlanControl control = watch.control();
  TeacherConfig teaching = config.teacher;
  teaching.weights = weights;
  job.context.progress.start(job.name + ": policy", 0.0, config.student.stages * config.student.rounds,
                             "rounds");
  const auto teacher = make_teacher(reference, plan, teaching, task, control);
  const auto stopped = [&] {
    taught.interrupted = watch.interrupted;
    taught.timed_out = watch.timed_out && !watch.interrupted;
    if (taught.timed_out) taught.note = "no policy: its teaching was stopped by --limit-seconds";
    return taught.interrupted || taught.timed_out;
  };
  if (stopped()) return taught;
  if (!teacher) {
    taught.note = "no policy: the plan cannot be repeated under feedback";
    return taught;
  }
  control.progress = [&](int done, int) { job.context.progress.update(done, ""); };
  int rows = 0, rounds = 0;
  StudentConfig lessons = config.student;
  lessons.seed = training.seed;  // one seed for all training in a run
  auto student =
      teach_student(*teacher, task, lessons, control, [&](const RoundStats& stats, const rl::Agent&) {
        rows = stats.taken;
        rounds = stats.round + 1;
      });
  if (stopped()) return taught;
  taught.values = {{"teacher_survives", teacher->followed},
                   {"lessons", static_cast<double>(rows)},
                   {"rounds", static_cast<double>(rounds)}};
  const auto alone = [&] {
    return rl::tracking::roll_out(teacher->clip, task, rl::tracking::mean_action({*student}), job.substeps);
  };
  taught.alone = alone();
  judge::Scores scores = judge::score_simulated(teacher->clip->reference, taught.alone);
  if (config.polish_samples > 0 && !scores.success) {
    const run::SequenceJob rest = run::after_seconds(job, record::steady_seconds() - watch.started);
    run::SimulatedSequence polished = polish(*teacher, *student, config, training, rest);
    taught.interrupted = polished.interrupted;
    if (taught.interrupted) return taught;
    taught.timed_out = polished.ending == record::SequenceEnding::kLimitSeconds;
    taught.samples = polished.samples;
    taught.values.emplace_back("polish_samples", static_cast<double>(polished.samples));
    student = polished.agents.front();
    taught.alone = alone();
    scores = judge::score_simulated(teacher->clip->reference, taught.alone);
  }
  try_out(*teacher, config, task, *student, scores, taught);
  if (taught.timed_out)
    taught.note += (taught.note.empty() ? "" : "; ") + std::string("--limit-seconds stopped its training");
  taught.alone = seen_from(reference, task, std::move(taught.alone));
  taught.policy =
      files::StoredPolicy{teacher->clip->reference, plan.states, task.simulation, task.actions, *student};
  taught.seconds = record::steady_seconds() - watch.started;
  return taught;
}

}  // namespace mimicx::teaching
