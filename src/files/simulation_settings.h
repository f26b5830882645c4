/// The settings of the simulation, by their names in manifests and files.
#pragma once

#include "core/named_values.h"
#include "physics/model.h"

namespace mimicx::files {

/// core/setting.h. `physics::make_model` refuses what is out of these ranges, too, and has the last word. It
/// also simulates without gravity, but slip and audits compare forces with the weight.
void visit_settings(physics::SimulationConfig& s, const auto& visit) {
  visit("physics_rate", s.rate, 30, 10000, "physics steps per second");
  visit("physics_passes", s.passes, 1, 20, "linearisations of contacts and torque bounds per step");
  visit("gravity", s.gravity, 1e-3, 1e9, "gravity, downwards, m/s²");
  visit("ground_stiffness", s.ground_stiffness, 1e-9, 1e9, "stiffness of a contact point on the floor, N/m");
  visit("ground_damping", s.ground_damping, 1e-9, 1e9, "damping of a contact point on the floor, N·s/m");
  visit("friction", s.friction, 0, 1e9, "coefficient of friction");
  visit("slip_speed", s.slip_speed, 1e-9, 1e9, "speed below which friction is viscous, m/s");
  visit("skin", s.skin, 0, 1e9, "height above z = 0 at which the floor acts, m");
  visit("self_contact", s.self_contact, 0, 1, "1: body parts collide with each other");
  visit("self_stiffness", s.self_stiffness, 0, 1e9, "stiffness of a contact between body parts, N/m");
  visit("self_damping", s.self_damping, 0, 1e9, "damping of a contact between body parts, N·s/m");
  visit("limit_stiffness", s.limit_stiffness, 0, 1e9, "stiffness of joint ranges, N·m/rad");
  visit("limit_damping", s.limit_damping, 0, 1e9, "damping of joint ranges, N·m·s/rad");
  visit("max_speed", s.max_speed, 1e-9, 1e9, "speed of the pelvis at which the simulation has failed, m/s");
  visit("max_joint_speed", s.max_joint_speed, 1e-9, 1e9,
        "speed of a joint at which the simulation has failed, rad/s");
}

/// All of them by name, as the files of plans and policies have them.
inline NamedValues simulation_numbers(physics::SimulationConfig simulation) {
  NamedValues numbers;
  visit_settings(simulation, [&](const std::string& name, const auto& field, auto...) {
    numbers.emplace_back(name, static_cast<double>(field));
  });
  return numbers;
}

}  // namespace mimicx::files
