#include "c_interface/simulator_handle.h"

#include <cmath>
#include <stdexcept>

#include "core/setting.h"
#include "files/simulation_settings.h"
#include "physics/standing_state.h"

namespace mimicx::c_interface {
namespace {

using physics::Quat, physics::Vec3, physics::Wrench;

// The caller sees these as rows of numbers.
static_assert(sizeof(Vec3<double>) == 3 * sizeof(double) && sizeof(Quat<double>) == 4 * sizeof(double) &&
              sizeof(Wrench<double>) == 6 * sizeof(double));

NumberView rows(PerBody<Vec3<double>>& v) { return {&v[0].x, {kBodies, 3}}; }
NumberView rows(PerBody<Quat<double>>& q) { return {&q[0].w, {kBodies, 4}}; }
NumberView rows(PerBody<Wrench<double>>& w) { return {&w[0].n.x, {kBodies, 6}}; }

/// @throws std::runtime_error unless it is a rotation
void require_rotation(const Quat<double>& q, const char* name, int body) {
  const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (std::abs(norm - 1.0) > 1e-3)
    throw std::runtime_error(std::string(name) + " of " + std::string(kBodyNames[body]) +
                             ": expected a quaternion of length 1");
}

void divide(Vec3<double>& v, double by) { v = {v.x / by, v.y / by, v.z / by}; }

}  // namespace

Simulator::Simulator(const std::array<double, kBetas>& betas)
    : character_(make_character(betas)), model_(physics::make_model<double>(character_, config_)) {
  stand();
}

void Simulator::set(const std::string& name, double value) {
  physics::SimulationConfig config = config_;
  files::visit_settings(config,
                        [&](const std::string& known, auto& field, double least, double most, const char*) {
                          if (known != name) return;
                          require_range(name, value, least, most);
                          assign_setting(field, value);
                        });
  bool known = false;
  files::visit_settings(config, [&](const std::string& one, auto&&...) { known = known || one == name; });
  if (!known) throw std::invalid_argument("unknown setting '" + name + "': `mimicx config` lists them all");
  model_ = physics::make_model<double>(character_, config);
  config_ = config;
}

void Simulator::stand() {
  state_ = physics::standing_state(character_);
  target_ = physics::target_at(state_);
  push_ = {};
  physics::clear(mean_);
  look();
}

NumberView Simulator::numbers(const std::string& name) {
  if (name == "root_position") return {&state_.p_root.x, {3}};
  if (name == "root_velocity") return {&state_.v_root.x, {3}};
  if (name == "rotations") return rows(state_.q);
  if (name == "spins") return rows(state_.omega);
  if (name == "target_rotations") return rows(target_.q);
  if (name == "target_spins") return rows(target_.omega);
  if (name == "push") return {&push_.n.x, {6}};
  if (name == "body_positions") return rows(data_.p_WB);
  if (name == "body_rotations") return rows(data_.q_WB);
  if (name == "joint_torques") return rows(mean_.joint_torque);
  if (name == "ground_wrenches") return rows(mean_.ground);
  if (name == "self_contact_wrenches") return rows(mean_.self);
  throw std::invalid_argument("the simulator has no array '" + name + "'");
}

void Simulator::step(int steps) {
  if (steps < 1) throw std::invalid_argument("steps: expected 1 or more, found " + std::to_string(steps));
  for (int i = 0; i < kBodies; ++i) {
    require_rotation(state_.q[i], "rotations", i);
    if (i > 0) require_rotation(target_.q[i], "target_rotations", i);
  }
  physics::State<double> next = state_;
  physics::Applied<double> sum{};
  for (int k = 0; k < steps; ++k)
    if (physics::step(model_, target_, next, data_, &sum, &push_)) {
      look();
      throw std::runtime_error("the simulation failed in step " + std::to_string(k + 1) +
                               ": speeds or places that no body has");
    }
  state_ = next;
  mean_ = sum;
  for (int i = 0; i < kBodies; ++i)
    for (Vec3<double>* v :
         {&mean_.joint_torque[i], &mean_.ground[i].n, &mean_.ground[i].f, &mean_.self[i].n, &mean_.self[i].f})
      divide(*v, steps);
  look();
}

void Simulator::look() { physics::update_kinematics(model_, state_, data_); }

}  // namespace mimicx::c_interface
