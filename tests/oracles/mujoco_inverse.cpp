#include "oracles/mujoco_inverse.h"

namespace mimicx::test {
namespace {

int body_id(const MujocoCharacter& mujoco, int body) {
  return mj_name2id(&mujoco.model(), mjOBJ_BODY, std::string(kBodyNames[body]).c_str());
}

void set_state(MujocoCharacter& mujoco, const physics::MotionState& state) {
  mujoco.model().opt.disableflags |= mjDSBL_CONTACT;
  mujoco.set_root(state.p_root, state.q[0], state.v_root, state.omega[0]);
  for (int i = 1; i < kBodies; ++i) mujoco.set_joint(i, state.q[i], state.omega[i]);
}

}  // namespace

physics::RequiredForces mujoco_inverse_dynamics(MujocoCharacter& mujoco, const physics::MotionState& state,
                                                const physics::BodyWrenches& wrenches) {
  mjModel& m = mujoco.model();
  mjData& d = mujoco.data();
  set_state(mujoco, state);
  Eigen::Map<Eigen::VectorXd> qacc(d.qacc, m.nv);
  qacc.segment<3>(0) = state.a_root;
  qacc.segment<3>(3) = state.omega_d[0];
  for (int i = 1; i < kBodies; ++i) {
    if (is_hinge(i))
      qacc[mujoco.dof(i)] = hinge_axis(i).dot(state.omega_d[i]);
    else
      qacc.segment<3>(mujoco.dof(i)) = state.omega_d[i];
  }
  mj_inverse(&m, &d);
  Eigen::VectorXd forces = Eigen::Map<Eigen::VectorXd>(d.qfrc_inverse, m.nv);
  for (int i = 0; i < kBodies; ++i) {
    const int id = body_id(mujoco, i);
    const Vector3d moment = wrenches[i].head<3>(), force = wrenches[i].tail<3>();
    Eigen::VectorXd generalised = Eigen::VectorXd::Zero(m.nv);
    mj_applyFT(&m, &d, force.data(), moment.data(), d.xpos + 3 * id, id, generalised.data());
    forces -= generalised;
  }
  physics::RequiredForces required;
  const Vector3d moment_B = forces.segment<3>(3);
  required.root.head<3>() = state.q[0] * moment_B;
  required.root.tail<3>() = forces.segment<3>(0);
  required.joint[0].setZero();
  for (int i = 1; i < kBodies; ++i) {
    const int dof = mujoco.dof(i);
    required.joint[i] =
        is_hinge(i) ? Vector3d(forces[dof] * hinge_axis(i)) : Vector3d(forces.segment<3>(dof));
  }
  return required;
}

MujocoMomentum mujoco_momentum(MujocoCharacter& mujoco, const physics::MotionState& state) {
  const mjModel& m = mujoco.model();
  mjData& d = mujoco.data();
  set_state(mujoco, state);
  mj_fwdPosition(&m, &d);
  mj_fwdVelocity(&m, &d);
  mj_subtreeVel(&m, &d);
  const int pelvis = body_id(mujoco, kPelvis);
  MujocoMomentum momentum;
  momentum.center = Eigen::Map<const Vector3d>(d.subtree_com + 3 * pelvis);
  momentum.about_center.head<3>() = Eigen::Map<const Vector3d>(d.subtree_angmom + 3 * pelvis);
  momentum.about_center.tail<3>() =
      m.body_subtreemass[pelvis] * Eigen::Map<const Vector3d>(d.subtree_linvel + 3 * pelvis);
  return momentum;
}

}  // namespace mimicx::test
