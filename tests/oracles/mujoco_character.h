/// The character inside MuJoCo: owns the library's model and data, and translates coordinates.
///
/// MuJoCo's velocities: pelvis linear in world axes, then angular in the pelvis frame; ball joints in the
/// child's frame, as ours; joints in depth-first order. Only compiled where MuJoCo is installed.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>

#include "physics/mjcf.h"

namespace mimicx::test {

class MujocoCharacter {
 public:
  /// @throws std::runtime_error with the compiler's message if MuJoCo refuses the model or warns.
  MujocoCharacter(const Character& character, const physics::SimulationConfig& config,
                  const physics::MjcfConfig& what = {});

  mjModel& model() { return *model_; }
  const mjModel& model() const { return *model_; }
  mjData& data() { return *data_; }
  /// First entry of a body's joint in qpos and in qvel.
  int qpos(int body) const { return qpos_[body]; }
  int dof(int body) const { return dof_[body]; }

  void set_root(const Vector3d& p, const Quaterniond& q_WB, const Vector3d& v_W, const Vector3d& w_B);
  /// Rotation and angular velocity of a joint, both as in physics/data.h.
  void set_joint(int body, const Quaterniond& q, const Vector3d& omega);
  /// Pose towards which the joint's stiffness pulls.
  void set_target(int body, const Quaterniond& q);

 private:
  void write_rotation(int body, const Quaterniond& q, mjtNum* out) const;

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data_{nullptr, mj_deleteData};
  PerBody<int> qpos_{}, dof_{};
};

}  // namespace mimicx::test
