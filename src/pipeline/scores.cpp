#include "pipeline/scores.h"

#include "core/units.h"

namespace mimicx {
namespace {

std::vector<BodyPoses> simulated_poses(const Character& character, const rl::TrackingRollout& rollout) {
  std::vector<BodyPoses> poses;
  for (const auto& pose : rollout.poses)
    poses.push_back(forward_kinematics(character, pose.frame.p_root, pose.frame.q));
  return poses;
}

/// The first `frames` frames.
MotionSamples head_of(MotionSamples samples, std::size_t frames) {
  samples.joints.resize(frames);
  samples.surface.resize(frames);
  samples.self_depth.resize(frames);
  return samples;
}

}  // namespace

NamedValues named_values(const Metrics& metrics) {
  NamedValues values;
  for (const auto& definition : metric_definitions())
    values.emplace_back(definition.name, (metrics.*definition.value).value);
  return values;
}

Scores score_simulated(const Reference& reference, const rl::TrackingRollout& rollout) {
  const Character& character = reference.character;
  const MotionSamples simulated =
      sample_motion(character, simulated_poses(character, rollout), reference.fps);
  const MotionSamples asked = sample_motion(character, reference.poses, reference.fps);
  const MotionSamples same_length = head_of(asked, simulated.joints.size());
  Scores scores;
  scores.values = named_values(evaluate_motion(simulated, &same_length));
  const Success success = judge_success(simulated, asked);
  scores.values.emplace_back("max_distance_mm", kMm * success.max_distance_m);
  scores.success = success.success;
  scores.reason = success.reason;
  return scores;
}

NamedValues score_input(const Clip& input, const Reference& reference) {
  const Character character = character_of(input);
  const MotionSamples raw = sample_motion(character, poses_of(input), input.fps);
  if (raw.frames() != reference.size() || input.fps != reference.fps)
    return named_values(evaluate_motion(raw, nullptr));
  const MotionSamples prepared = sample_motion(character, reference.poses, reference.fps);
  return named_values(evaluate_motion(raw, &prepared));
}

}  // namespace mimicx
