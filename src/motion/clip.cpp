#include "motion/clip.h"

#include <algorithm>

namespace mimicx::motion {

Vector3d eye_of(const Eigen::Matrix4d& extrinsics) {
  return -extrinsics.topLeftCorner<3, 3>().transpose() * extrinsics.topRightCorner<3, 1>();
}

std::array<double, kBetas> Clip::usable_betas() const {
  return body_model == "mimicx" ? betas : std::array<double, kBetas>{};
}

bool Clip::is_simulated() const {
  return has_simulated_body() && std::any_of(passthrough.begin(), passthrough.end(), [](const auto& member) {
           return member.first == "ground_wrenches";
         });
}

void require_usable(const Clip& clip, int frames) {
  if (clip.frames() < frames)
    throw DataError(clip.name, "", "at least " + std::to_string(frames) + " frames",
                    std::to_string(clip.frames()));
  if (clip.trans.size() != clip.rotations.size())
    throw DataError(clip.name, "trans", std::to_string(clip.rotations.size()) + " frames",
                    std::to_string(clip.trans.size()));
  for (int t = 0; t < clip.frames(); ++t) {
    bool finite = clip.trans[t].allFinite();
    for (const Vector3d& r : clip.rotations[t]) finite = finite && r.allFinite();
    if (!finite)
      throw DataError(clip.name, "frame " + std::to_string(t), "finite numbers", "one that is not");
  }
}

PerFrame<PerBody<Quaterniond>> joint_rotations(const Clip& clip) {
  PerFrame<PerBody<Quaterniond>> q(clip.rotations.size());
  for (int t = 0; t < q.count(); ++t)
    for (int j = 0; j < kBodies; ++j) q[t][j] = exp_map(clip.rotations[t][j]);
  return q;
}

Character character_of(const Clip& clip) {
  return clip.rest_joints ? make_character_of_joints(*clip.rest_joints) : make_character(clip.usable_betas());
}

Vector3d rest_pelvis(const Clip& clip) {
  return clip.rest_joints ? (*clip.rest_joints)[0] : mimicx::rest_pelvis(clip.body_model);
}

void put_on_body_of(const Clip& other, Clip& clip) {
  const Vector3d moved = rest_pelvis(clip) - rest_pelvis(other);
  for (Vector3d& trans : clip.trans) trans += moved;
  clip.body_model = other.body_model;
  clip.betas = other.betas;
  clip.gender = other.gender;
  clip.rest_joints = other.rest_joints;
}

PerFrame<BodyPoses> poses_of(const Clip& clip) {
  const Character character = character_of(clip);
  const Vector3d pelvis = rest_pelvis(clip);
  const auto q = joint_rotations(clip);
  PerFrame<BodyPoses> poses;
  for (int t = 0; t < q.count(); ++t)
    poses.push_back(forward_kinematics(character, clip.trans[t] + pelvis, q[t]));
  return poses;
}

Clip to_clip(const std::string& name, double fps, const Character& character,
             const PerFrame<Vector3d>& p_root, const PerFrame<PerBody<Quaterniond>>& q) {
  Clip clip;
  clip.name = name;
  clip.fps = fps;
  clip.betas = character.betas;
  clip.body_model = "mimicx";
  const Vector3d pelvis = mimicx::rest_pelvis(clip.body_model);
  clip.rotations.resize(q.size());
  for (int t = 0; t < q.count(); ++t) {
    for (int j = 0; j < kBodies; ++j) clip.rotations[t][j] = log_map(q[t][j]);
    clip.trans.push_back(p_root[t] - pelvis);
  }
  return clip;
}

std::string foreign_betas_warning(const std::string& body_model) {
  return "betas of body model '" + body_model +
         "' have no meaning without that model: the standard body is used";
}

}  // namespace mimicx::motion
