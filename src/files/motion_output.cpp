#include "files/motion_output.h"

#include <algorithm>

#include "files/archive_members.h"
#include "files/recorded_forces.h"
#include "motion/clip_file.h"
#include "motion/passthrough.h"
#include "motion/resample.h"

namespace mimicx::files {
namespace {

constexpr Precision kPrecision = Precision::kFloat64;  // as all members of a motion

NpyArray positions_member(const std::vector<PerBody<Vector3d>>& frames) {
  std::vector<double> values;
  for (const auto& frame : frames)
    for (const auto& p : frame) values.insert(values.end(), p.data(), p.data() + 3);
  return NpyArray::from_double({frames.size(), kBodies, 3}, values.data());
}

NpyArray rewards_member(const std::vector<rl::tracking::Reward>& rewards) {
  std::vector<double> values;
  for (const auto& r : rewards) values.push_back(r.total);
  return NpyArray::from_double({values.size()}, values.data());
}

/// (T, 6): a column per factor, in the order of kRewardTermNames.
NpyArray reward_factors_member(const std::vector<rl::tracking::Reward>& rewards) {
  std::vector<double> values;
  for (const auto& r : rewards) values.insert(values.end(), r.term.begin(), r.term.end());
  return NpyArray::from_double({rewards.size(), rl::tracking::kRewardTerms}, values.data());
}

/// Members of the input at the simulated frames.
motion::Passthrough members_for(const motion::Clip& input, double fps, std::size_t frames) {
  const motion::Clip resampled = motion::resampled(input, fps);
  return motion::first_frames(resampled.passthrough, resampled.rotations.size(),
                              std::min(frames, resampled.rotations.size()));
}

}  // namespace

void write_simulated(const std::filesystem::path& path, const motion::Clip& input,
                     const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout,
                     const Members& more) {
  PerFrame<motion::ReferenceFrame> states;
  VectorRows joints, torques, ranges;
  WrenchRows ground, self;
  for (const auto& pose : rollout.poses) {
    joints.push_back(pose.p_WB);
    states.push_back(pose.frame);
  }
  for (const auto& forces : rollout.forces) {
    torques.push_back(forces.joint_torque);
    ranges.push_back(forces.range_torque);
    ground.push_back(forces.ground);
    self.push_back(forces.self_contact);
  }
  motion::Clip clip = motion::clip_on_body_of(input, reference, states);
  clip.gender = input.gender;
  if (rollout.poses.size() == reference.frames.size()) clip.keypoints = reference.keypoints;
  clip.passthrough = members_for(input, reference.fps, rollout.poses.size());
  remove_recorded(clip);
  Members extra = {{"joints", positions_member(joints)},
                   {"velocities", velocities_member(states, kPrecision)},
                   {"joint_torques", joints_member(torques, kPrecision)},
                   {"range_torques", joints_member(ranges, kPrecision)},
                   {"ground_wrenches", wrenches_member(ground, kPrecision)},
                   {"self_contact_wrenches", wrenches_member(self, kPrecision)},
                   {"reward", rewards_member(rollout.rewards)},
                   {"reward_factors", reward_factors_member(rollout.rewards)}};
  extra.insert(extra.end(), more.begin(), more.end());
  motion::write_clip(path, clip, extra);
}

void write_input(const std::filesystem::path& path, const motion::Clip& input) {
  motion::Clip used = input;
  used.passthrough.clear();
  motion::write_clip(path, used, motion::world_members(used));
}

void write_reference(const std::filesystem::path& path, const motion::Clip& input,
                     const motion::Reference& reference) {
  std::vector<PerBody<Vector3d>> joints;
  for (const BodyPoses& pose : reference.poses) joints.push_back(pose.p_WB);
  motion::Clip clip = motion::clip_on_body_of(input, reference, reference.frames);
  clip.keypoints = reference.keypoints;
  motion::write_clip(path, clip, {{"joints", positions_member(joints)}});
}

}  // namespace mimicx::files
