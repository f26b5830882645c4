#include "pipeline/motion_output.h"

#include <string>
#include <utility>

namespace mimicx {
namespace {

using Members = std::vector<std::pair<std::string, NpyArray>>;

NpyArray joints_member(const std::vector<std::array<Vector3d, kBodies>>& frames) {
  std::vector<double> values;
  for (const auto& frame : frames)
    for (const auto& p : frame) values.insert(values.end(), p.data(), p.data() + 3);
  return NpyArray::from_double({frames.size(), kBodies, 3}, values.data());
}

NpyArray wrenches_member(const std::vector<std::array<Vector6d, kBodies>>& frames) {
  std::vector<double> values;
  for (const auto& frame : frames)
    for (const auto& w : frame) values.insert(values.end(), w.data(), w.data() + 6);
  return NpyArray::from_double({frames.size(), kBodies, 6}, values.data());
}

/// [frames][22] torques → (T, 55): 3 numbers per spherical joint, 1 about the axis of a hinge.
NpyArray torques_member(const std::vector<std::array<Vector3d, kBodies>>& frames) {
  std::vector<double> values;
  for (const auto& frame : frames) {
    for (int body = 1; body < kBodies; ++body) {
      const Vector3d& tau = frame[static_cast<std::size_t>(body)];
      if (is_hinge(body))
        values.push_back(tau.dot(hinge_axis(body)));
      else
        values.insert(values.end(), tau.data(), tau.data() + 3);
    }
  }
  return NpyArray::from_double({frames.size(), kDofs}, values.data());
}

NpyArray rewards_member(const std::vector<rl::Reward>& rewards) {
  std::vector<double> values;
  for (const auto& r : rewards) values.push_back(r.total);
  return NpyArray::from_double({values.size()}, values.data());
}

/// Whether a member of the input still means the same beside `frames` frames.
bool fits(const NpyArray& array, int input_frames, std::size_t frames) {
  const bool per_frame = !array.shape.empty() && array.shape[0] == static_cast<std::size_t>(input_frames);
  return !per_frame || array.shape[0] == frames;
}

}  // namespace

void write_simulated(const std::filesystem::path& path, const Clip& input, const Reference& reference,
                     const rl::TrackingRollout& rollout, std::vector<std::string>& notes) {
  std::vector<Vector3d> p_root;
  std::vector<std::array<Quaterniond, kBodies>> q;
  std::vector<std::array<Vector3d, kBodies>> joints;
  for (const auto& pose : rollout.poses) {
    p_root.push_back(pose.frame.p_root);
    q.push_back(pose.frame.q);
    joints.push_back(pose.p_WB);
  }
  Clip clip = to_clip(reference.name, reference.fps, reference.character, p_root, q);
  if (input.rest_joints) put_on_body_of(input, clip);
  clip.gender = input.gender;
  if (rollout.poses.size() == reference.frames.size()) clip.keypoints = reference.keypoints;
  for (const auto& member : input.passthrough) {
    if (fits(member.second, input.frames(), rollout.poses.size()) && (input.fps == reference.fps))
      clip.passthrough.push_back(member);
    else
      notes.push_back("'" + member.first + "' of the input is not passed on: the frames no longer match");
  }
  const Members extra = {{"joints", joints_member(joints)},
                         {"joint_torques", torques_member(rollout.joint_torques)},
                         {"ground_wrenches", wrenches_member(rollout.ground_wrenches)},
                         {"self_contact_wrenches", wrenches_member(rollout.self_contact_wrenches)},
                         {"reward", rewards_member(rollout.rewards)}};
  write_clip(path, clip, extra);
}

void write_reference(const std::filesystem::path& path, const Clip& input, const Reference& reference) {
  std::vector<Vector3d> p_root;
  std::vector<std::array<Quaterniond, kBodies>> q;
  std::vector<std::array<Vector3d, kBodies>> joints;
  for (std::size_t t = 0; t < reference.frames.size(); ++t) {
    p_root.push_back(reference.frames[t].p_root);
    q.push_back(reference.frames[t].q);
    joints.push_back(reference.poses[t].p_WB);
  }
  Clip clip = to_clip(reference.name, reference.fps, reference.character, p_root, q);
  if (input.rest_joints) put_on_body_of(input, clip);
  clip.keypoints = reference.keypoints;
  write_clip(path, clip, {{"joints", joints_member(joints)}});
}

}  // namespace mimicx
