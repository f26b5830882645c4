#include "judge/scores.h"

#include "core/units.h"
#include "judge/force_metrics.h"
#include "motion/resample.h"

namespace mimicx::judge {

motion::MotionSamples samples_at(const motion::Clip& clip, double rate) {
  return motion::sample_motion(motion::character_of(clip), motion::poses_of(motion::resampled(clip, rate)),
                               rate, clip.scene);
}

PerFrame<BodyPoses> poses_of(const Character& character, const rl::tracking::TrackingRollout& rollout) {
  PerFrame<BodyPoses> poses;
  for (const auto& pose : rollout.poses)
    poses.push_back(forward_kinematics(character, pose.frame.p_root, pose.frame.q));
  return poses;
}

audit::FloorWrenches ground_of(const rl::tracking::TrackingRollout& rollout) {
  audit::FloorWrenches ground;
  for (const rl::tracking::ActingForces& forces : rollout.forces) ground.push_back(forces.ground);
  return ground;
}

NamedValues named_values(const motion::Metrics& metrics) {
  NamedValues values;
  for (const auto& definition : motion::metric_definitions())
    values.emplace_back(definition.name, (metrics.*definition.value).value);
  return values;
}

Scores score_simulated(const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout) {
  const Character& character = reference.character;
  const PerFrame<BodyPoses> poses = poses_of(character, rollout);
  const motion::MotionSamples simulated =
      motion::sample_motion(character, poses, reference.fps, reference.scene);
  const motion::MotionSamples asked =
      motion::sample_motion(character, reference.poses, reference.fps, reference.scene);
  const motion::MotionSamples same_length = head_of(asked, simulated.frames());
  Scores scores;
  motion::Metrics metrics = motion::evaluate_motion(simulated, &same_length);
  judge_forces({character, poses, ground_of(rollout), reference.fps, reference.scene, rollout.gravity},
               metrics);
  scores.values = named_values(metrics);
  const motion::Success success = motion::success_of(simulated, asked);
  scores.values.emplace_back("max_distance_mm", kMm * success.max_distance_m);
  scores.success = success.success;
  scores.reason = success.reason;
  return scores;
}

InputScores score_input(const motion::Clip& input, const motion::Reference& reference, double gravity) {
  const Character character = motion::character_of(input);
  const PerFrame<BodyPoses> poses = motion::poses_of(motion::resampled(input, reference.fps));
  const motion::MotionSamples raw = motion::sample_motion(character, poses, reference.fps, input.scene);
  const bool same_length = raw.frames() == reference.size();
  const motion::MotionSamples prepared =
      same_length ? motion::sample_motion(character, reference.poses, reference.fps, reference.scene)
                  : motion::MotionSamples{};
  motion::Metrics metrics = motion::evaluate_motion(raw, same_length ? &prepared : nullptr);
  audit::Slip slip = judge_poses(character, poses, reference.fps, input.scene, gravity, metrics);
  return {named_values(metrics), std::move(slip)};
}

}  // namespace mimicx::judge
