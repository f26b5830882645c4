#include "policy_export/numpy_arrays.h"

#include <algorithm>

#include "files/archive_members.h"
#include "files/simulation_settings.h"

namespace mimicx::policy_export {
namespace {

NpyArray npy_of(const nn::Matrix<float>& matrix) {
  return NpyArray::from_float(
      {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())}, matrix.data());
}

void add_body(const Character& character, double max_action, Npz& npz) {
  std::vector<std::string> names;
  std::vector<std::int32_t> parents;
  std::vector<double> offsets, kp, kd, torque, centre, half;
  for (int body = 0; body < kBodies; ++body) {
    const JointParameters& joint = character.joint[body];
    names.emplace_back(kBodyNames[body]);
    parents.push_back(kParents[body]);
    kp.push_back(joint.kp);
    kd.push_back(joint.kd);
    torque.push_back(joint.torque_limit);
    for (int k = 0; k < 3; ++k) {
      offsets.push_back(character.joint_offset[body][k]);
      centre.push_back(joint.centre[k]);
      half.push_back(joint.half_range[k]);
    }
  }
  npz.set("joint_names", NpyArray::from_text(names));
  npz.set("parents", NpyArray::from_int32({kBodies}, parents.data()));
  npz.set("joint_offset", NpyArray::from_double({kBodies, 3}, offsets.data()));
  npz.set("betas", NpyArray::from_double({character.betas.size()}, character.betas.data()));
  npz.set("stiffness", NpyArray::from_double({kBodies}, kp.data()));
  npz.set("damping", NpyArray::from_double({kBodies}, kd.data()));
  npz.set("torque_limit", NpyArray::from_double({kBodies}, torque.data()));
  npz.set("range_centre", NpyArray::from_double({kBodies, 3}, centre.data()));
  npz.set("range_half_axes", NpyArray::from_double({kBodies, 3}, half.data()));
  npz.set("max_action", NpyArray::scalar(max_action));
}

/// Actions are within ± max_action, as those of the documentation's code.
void add_records(const std::vector<Record>& records, float max_action, Npz& npz) {
  std::vector<std::int32_t> frames;
  List<physics::State<double>> states;
  std::vector<float> observations, actions, targets;
  for (const Record& record : records) {
    frames.push_back(record.frame);
    states.push_back(to_physics(record.now));
    observations.insert(observations.end(), record.observation.begin(), record.observation.end());
    for (const float angle : record.action) actions.push_back(std::clamp(angle, -max_action, max_action));
    for (const auto& q : record.targets.q) targets.insert(targets.end(), q, q + 4);
  }
  npz.set("test_frames", NpyArray::from_int32({frames.size()}, frames.data()));
  files::add_states("test_", states, files::Precision::kFloat32, npz);
  npz.set("test_observations", NpyArray::from_float({records.size(), kStateCount}, observations.data()));
  npz.set("test_actions", NpyArray::from_float({records.size(), kActionCount}, actions.data()));
  npz.set("test_targets", NpyArray::from_float({records.size(), kBodies, 4}, targets.data()));
}

}  // namespace

Npz to_arrays(const ExportedPolicy& exported) {
  const rl::Agent& agent = exported.meant.agent;
  Npz npz;
  npz.set("name", NpyArray::scalar_text(exported.meant.motion.name));
  npz.set("fps", NpyArray::scalar(exported.meant.motion.fps));
  npz.set("layers", NpyArray::scalar_int(agent.actor.layers()));
  npz.set("mean", npy_of(agent.observations.shift));
  npz.set("factor", npy_of(agent.observations.factor));
  npz.set("limit", NpyArray::scalar(static_cast<double>(agent.observations.limit)));
  for (std::size_t l = 0; l < agent.actor.weights.size(); ++l) {
    npz.set("weight" + std::to_string(l), npy_of(agent.actor.weights[l]));
    npz.set("bias" + std::to_string(l), npy_of(agent.actor.biases[l]));
  }
  files::add_states("state_", exported.meant.states, files::Precision::kFloat32, npz);
  add_body(exported.meant.motion.character, static_cast<double>(exported.max_action), npz);
  for (const auto& [name, number] : files::simulation_numbers(exported.meant.simulation))
    npz.set(name, NpyArray::scalar(number));
  add_records(exported.records, exported.max_action, npz);
  return npz;
}

}  // namespace mimicx::policy_export
