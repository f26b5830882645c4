#include "audit/substeps.h"

#include <cmath>

#include <memory>

#include "core/number_text.h"
#include "files/archive_members.h"
#include "files/simulation_settings.h"
#include "motion/clip_file.h"
#include "physics/lanes.h"
#include "physics/step.h"

namespace mimicx::audit {
namespace {

constexpr std::size_t kPositions = 3 + 4 * kBodies;
constexpr std::size_t kVelocities = 3 + 3 * kBodies;
constexpr files::Precision kExact = files::Precision::kFloat32;  // the simulator's own

template <class Item>
void append_all(const PerBody<Item>& row, std::vector<double>& values) {
  for (const Item& item : row) files::append(item, values);
}

void take(const double*& at, Vector3d& v) {
  v = Eigen::Map<const Vector3d>(at);
  at += 3;
}
void take(const double*& at, Quaterniond& q) {
  q = Quaterniond(at[0], at[1], at[2], at[3]);
  at += 4;
}
template <class Item>
void take(const double*& at, PerBody<Item>& row) {
  for (Item& item : row) take(at, item);
}

void add_states(const SubstepMotion& motion, Npz& npz) {
  std::vector<double> q, v;
  const auto add = [&](const motion::ReferenceFrame& state) {
    files::append(state.p_root, q);
    append_all(state.q, q);
    files::append(state.v_root, v);
    append_all(state.omega, v);
  };
  for (const rl::tracking::Substep& step : motion.steps) add(step.state);
  add(motion.last);
  npz.set("q", files::numbers_member({motion.steps.size() + 1, kPositions}, q, kExact));
  npz.set("v", files::numbers_member({motion.steps.size() + 1, kVelocities}, v, kExact));
}

void add_targets(const SubstepMotion& motion, Npz& npz) {
  std::vector<double> q, omega;
  for (const rl::tracking::Substep& step : motion.steps) {
    append_all(step.target_q, q);
    append_all(step.target_omega, omega);
  }
  npz.set("target_q", files::numbers_member({motion.steps.size(), kBodies, 4}, q, kExact));
  npz.set("target_omega", files::numbers_member({motion.steps.size(), kBodies, 3}, omega, kExact));
}

void add_forces(const SubstepMotion& motion, Npz& npz) {
  files::VectorRows torques, ranges;
  files::WrenchRows ground, self;
  for (const rl::tracking::Substep& step : motion.steps) {
    torques.push_back(step.forces.joint_torque);
    ranges.push_back(step.forces.range_torque);
    ground.push_back(step.forces.ground);
    self.push_back(step.forces.self_contact);
  }
  npz.set("joint_torques", files::joints_member(torques, kExact));
  npz.set("range_torques", files::joints_member(ranges, kExact));
  npz.set("ground_wrenches", files::wrenches_member(ground, kExact));
  npz.set("self_contact_wrenches", files::wrenches_member(self, kExact));
}

/// All states, the one after the last step included.
std::vector<motion::ReferenceFrame> read_states(const Npz& npz, std::size_t count) {
  const std::vector<double> q = files::read_numbers(npz, "q", count, kPositions);
  const std::vector<double> v = files::read_numbers(npz, "v", count, kVelocities);
  std::vector<motion::ReferenceFrame> states(count);
  const double *q_at = q.data(), *v_at = v.data();
  for (motion::ReferenceFrame& state : states) {
    take(q_at, state.p_root);
    take(q_at, state.q);
    take(v_at, state.v_root);
    take(v_at, state.omega);
  }
  return states;
}

void read_targets(const Npz& npz, std::vector<rl::tracking::Substep>& steps) {
  const std::vector<double> q = files::read_numbers(npz, "target_q", steps.size(), 4 * kBodies);
  const std::vector<double> omega = files::read_numbers(npz, "target_omega", steps.size(), 3 * kBodies);
  const double *q_at = q.data(), *omega_at = omega.data();
  for (rl::tracking::Substep& step : steps) {
    take(q_at, step.target_q);
    take(omega_at, step.target_omega);
  }
}

physics::Quat<double> to_simulator(const Quaterniond& q) { return physics::from_eigen(q.normalized()); }
Vector6d to_eigen(const physics::Wrench<double>& w) {
  Vector6d out;
  out.head<3>() = physics::to_eigen(w.n);
  out.tail<3>() = physics::to_eigen(w.f);
  return out;
}

rl::tracking::ActingForces to_eigen(const physics::Applied<double>& applied) {
  rl::tracking::ActingForces forces;
  for (std::size_t i = 0; i < kBodies; ++i) {
    forces.joint_torque[i] = physics::to_eigen(applied.joint_torque[i]);
    forces.range_torque[i] = physics::to_eigen(applied.range_torque[i]);
    forces.ground[i] = to_eigen(applied.ground[i]);
    forces.self_contact[i] = to_eigen(applied.self[i]);
  }
  return forces;
}

}  // namespace

void write_substeps(const std::filesystem::path& path, const SubstepMotion& motion) {
  Npz npz;
  add_states(motion, npz);
  add_targets(motion, npz);
  add_forces(motion, npz);
  npz.set("betas", NpyArray::from_double({kBetas}, motion.character.betas.data()));
  npz.set("body_model", NpyArray::scalar_text("mimicx"));
  motion::add_rest_joints(motion.rest_joints, npz);
  motion::add_scene(motion.scene, npz);
  npz.set("joint_names", NpyArray::from_text({kBodyNames.begin(), kBodyNames.end()}));
  for (const auto& [name, number] : files::simulation_numbers(motion.simulation))
    npz.set(name, NpyArray::from_double({1}, &number));
  write_npz(path, npz);
}

bool holds_substeps(const Npz& npz) { return npz.has("target_q") && npz.has("physics_rate"); }

SubstepMotion read_substeps(const Npz& npz) {
  SubstepMotion motion;
  const std::vector<double> betas = files::read_numbers(npz, "betas", kBetas, 1);
  std::array<double, kBetas> shape{};
  std::copy(betas.begin(), betas.end(), shape.begin());
  for (const double beta : shape)
    if (std::abs(beta) > kMaxBeta)
      throw DataError(npz.path, "betas", "shape parameters within ±5", text_of(beta));
  motion.rest_joints = motion::rest_joints_of(npz);
  motion.character =
      motion.rest_joints ? make_character_of_joints(*motion.rest_joints) : make_character(shape);
  motion.simulation = files::read_simulation(npz);
  motion.scene = motion::scene_of(npz);
  const NpyArray& q = npz.at("q");
  if (q.shape.empty() || q.shape[0] < 2) throw DataError(npz.path, "q", "at least two states", "fewer");
  std::vector<motion::ReferenceFrame> states = read_states(npz, q.shape[0]);
  motion.last = states.back();
  states.pop_back();
  motion.steps.resize(states.size());
  read_targets(npz, motion.steps);
  const files::VectorRows torques = files::read_joints(npz, "joint_torques", states.size()),
                          ranges = files::read_joints(npz, "range_torques", states.size());
  const files::WrenchRows ground = files::read_wrenches(npz, "ground_wrenches", states.size()),
                          self = files::read_wrenches(npz, "self_contact_wrenches", states.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    motion.steps[k].state = states[k];
    motion.steps[k].forces = {torques[k], ranges[k], ground[k], self[k]};
  }
  return motion;
}

Replay replay_in_double(const SubstepMotion& motion) {
  const physics::Model<double> model =
      physics::make_model<double>(motion.character, motion.simulation, motion.scene);
  const auto data = std::make_unique<physics::Data<double>>();
  physics::State<double> state;
  physics::Target<double> target;
  physics::Applied<double> applied;
  Replay replay;
  for (const rl::tracking::Substep& recorded : motion.steps) {
    state.p_root = physics::from_eigen(recorded.state.p_root);
    state.v_root = physics::from_eigen(recorded.state.v_root);
    for (std::size_t i = 0; i < kBodies; ++i) {
      state.q[i] = to_simulator(recorded.state.q[i]);
      state.omega[i] = physics::from_eigen(recorded.state.omega[i]);
      target.q[i] = to_simulator(recorded.target_q[i]);
      target.omega[i] = physics::from_eigen(recorded.target_omega[i]);
    }
    rl::tracking::Substep step = recorded;
    step.state = rl::tracking::frame_of_state(state);
    physics::clear(applied);
    physics::step(model, target, state, *data, &applied);
    step.forces = to_eigen(applied);
    replay.steps.push_back(step);
    replay.next.push_back(rl::tracking::frame_of_state(state));
  }
  return replay;
}

}  // namespace mimicx::audit
