#include "oracles/mujoco_character.h"

#include <cstring>
#include <stdexcept>

#include "physics/mjcf.h"

namespace mimicx::test {

MujocoCharacter::MujocoCharacter(const Character& character, const physics::SimulationConfig& config,
                                 const physics::MjcfConfig& what) {
  const std::string text = physics::to_mjcf(character, config, what);
  const auto files = std::make_unique<mjVFS>();  // an in-memory file system: megabytes, not for the stack
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "character.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  char message[1000] = "";
  model_.reset(mj_loadXML("character.xml", files.get(), message, sizeof message));
  mj_deleteVFS(files.get());
  if (!model_ || message[0] != '\0') throw std::runtime_error(std::string("MuJoCo: ") + message);
  data_.reset(mj_makeData(model_.get()));
  for (int i = 0; i < kBodies; ++i) {
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, std::string(kBodyNames[i]).c_str());
    qpos_[i] = model_->jnt_qposadr[joint];
    dof_[i] = model_->jnt_dofadr[joint];
  }
}

void MujocoCharacter::write_rotation(int body, const Quaterniond& q, mjtNum* out) const {
  if (is_hinge(body)) {
    *out = hinge_axis(body).dot(log_map(q));
    return;
  }
  out[0] = q.w();
  for (int k = 0; k < 3; ++k) out[1 + k] = q.vec()(k);
}

void MujocoCharacter::set_root(const Vector3d& p, const Quaterniond& q_WB, const Vector3d& v_W,
                               const Vector3d& w_B) {
  for (int k = 0; k < 3; ++k) {
    data_->qpos[k] = p(k);
    data_->qvel[k] = v_W(k);
    data_->qvel[3 + k] = w_B(k);
  }
  write_rotation(kPelvis, q_WB, data_->qpos + 3);
}

void MujocoCharacter::set_joint(int body, const Quaterniond& q, const Vector3d& omega) {
  write_rotation(body, q, data_->qpos + qpos(body));
  if (is_hinge(body))
    data_->qvel[dof(body)] = hinge_axis(body).dot(omega);
  else
    for (int k = 0; k < 3; ++k) data_->qvel[dof(body) + k] = omega(k);
}

void MujocoCharacter::set_target(int body, const Quaterniond& q) {
  write_rotation(body, q, model_->qpos_spring + qpos(body));
}

}  // namespace mimicx::test
